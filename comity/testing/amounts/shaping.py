"""The parameters that shaped a figure, a line each, with the rules behind it."""

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
"""How these lines begin: each says all of one parameter, so that a text need not say it twice."""
PASSED_M = 2.0
"""Whoever the robot passes nearer than this, or within their space, may have moved its way (our choice)."""


def shaping(episode: Episode, person: str | None = None) -> Iterator[str]:
    """What the plan's steps go by, the distances of those who were passed by, and a robot that is slow.

    Args:
        episode: What happened.
        person: Of one visit alone; None for the whole run.
    """
    prepared = episode.prepared
    pairs = (*_planned_with(prepared, person), *(() if person else _passed(episode)))
    yield from told_of(prepared.values, episode.told, pairs)
    own_m_s = prepared.scene.robot.max_speed_m_s
    if own_m_s < Limits().cruise_speed_m_s:
        yield f"limit     the robot drives at most {own_m_s:g} m/s everywhere, its `max_speed_m_s`"


def shaping_price(prepared: PlannedEpisode, person: str) -> Iterator[str]:
    """What another choice for a person is priced by: theirs, and where everybody else wants the robot.

    It is a choice of the first plan, and so what they said later is no part of it.
    """
    distances = (pair for pair in _planned_with(prepared, None) if pair[1] == DISTANCE)
    return told_of(prepared.values, (), (*_planned_with(prepared, person), *distances))


def told_of(
    start: Mapping[str, Inference], updates: Sequence[ParameterUpdate], pairs: Iterable[tuple[str, str]]
) -> Iterator[str]:
    """A line for each value and what it is made of, by parameter.

    Args:
        start: By person, the parameters at the start.
        updates: What people asked for on the way, in order.
        pairs: A person and one of their parameters each.
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
    """A person and one of their parameters, for every step."""
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
