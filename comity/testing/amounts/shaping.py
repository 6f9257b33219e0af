"""Parameters that influenced a metric, one a line, with the rules behind each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from comity.report.values.inference import in_brief
from comity.testing.amounts.amount import told
from comity.testing.amounts.holding import held
from comity_domain.problem.bound_parameters import DISTANCE
from comity_executor import Limits
from comity_sim2d.metrics import clearances_m
from comity_sim2d.paths.personal_space import FRONT

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.monitoring.parameter_updates import ParameterUpdate
    from comity.preparation import PlannedEpisode
    from comity_fis import Inference

HEAD = "goes by   "
"""Prefix of these lines: each is complete in itself, so a text need not repeat it."""
PASSED_M = 2.0
"""A person whom the robot passes at less than this [m], or within their personal space, may have influenced
its path (our choice)."""


def shaping(episode: Episode, person: str | None = None) -> Iterator[str]:
    """Parameters behind the plan's steps, distances of people passed by, and low speeds of the robot.

    Args:
        episode: What happened.
        person: Only their visit; None for the whole run.
    """
    prepared = episode.prepared
    pairs = (*_planned_with(prepared, person), *(() if person else _passed(episode)))
    yield from told_of(prepared.values, episode.told, pairs)
    own_m_s = prepared.scene.robot.max_speed_m_s
    if own_m_s < Limits().cruise_speed_m_s:
        yield f"limit     the robot drives at most {own_m_s:g} m/s everywhere, its `max_speed_m_s`"


def shaping_price(prepared: PlannedEpisode, person: str) -> Iterator[str]:
    """What determines the cost of an alternative: the person's parameters, and the places of all others.

    The alternative concerns the first plan, so later statements of people do not count.
    """
    distances = (pair for pair in _planned_with(prepared, None) if pair[1] == DISTANCE)
    return told_of(prepared.values, (), (*_planned_with(prepared, person), *distances))


def told_of(
    start: Mapping[str, Inference], updates: Sequence[ParameterUpdate], pairs: Iterable[tuple[str, str]]
) -> Iterator[str]:
    """One line per value with its contributions, by parameter.

    Args:
        start: Parameters at the start, by person.
        updates: Parameter changes that people asked for during the episode, in order.
        pairs: Pairs of person and parameter.
    """
    people: dict[str, dict[str, list[str]]] = {}
    for one, name in dict.fromkeys(pairs):
        for each in held(start[one], updates, name, one):
            people.setdefault(name, {}).setdefault(_in_words(each, name), []).append(one)
    for name, alike in people.items():
        yield from (f"{HEAD}{name} of {', '.join(whose)} {words}" for words, whose in alike.items())


def _in_words(each: ParameterUpdate, name: str) -> str:
    value = each.values[name]
    since = f", from t={each.t:.2f} s on" if each.text else ""
    return f"{told(value.value, value.unit)}{since}: {in_brief(value, each.values.inputs)}"


def _planned_with(prepared: PlannedEpisode, person: str | None) -> Iterator[tuple[str, str]]:
    """Pairs of person and parameter, for every step."""
    for step in prepared.plan.steps:
        if person is None or person in step.people:
            for one in step.people:
                known = prepared.values[one].parameters
                yield from ((one, name) for name in step.parameters if name in known)


def _passed(episode: Episode) -> Iterator[tuple[str, str]]:
    """People the robot came near, the nearest first."""
    frames, values = episode.frames, episode.prepared.values
    nearest = dict(zip(frames.entities[1:], clearances_m(frames).min(axis=0), strict=True))
    for one in sorted(nearest, key=lambda name: nearest[name]):
        if one in values:
            liked_m = (
                each.values[DISTANCE].number for each in held(values[one], episode.told, DISTANCE, one)
            )
            if nearest[one] < max(PASSED_M, FRONT * max(liked_m)):
                yield one, DISTANCE
