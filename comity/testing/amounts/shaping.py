"""The parameters that shaped a figure, a line each, with the rules behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from comity.report.values.inference import in_brief
from comity.testing.amounts.amount import told
from comity.testing.amounts.holding import Held, held
from comity_domain.problem.bound_parameters import DISTANCE
from comity_executor import Limits
from comity_sim2d.metrics import clearances_m
from comity_sim2d.paths.personal_space import FRONT

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.preparation import PlannedEpisode

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
    yield from told_of(
        episode, (*_planned_with(episode.prepared, person), *(() if person else _passed(episode)))
    )
    own_m_s = episode.prepared.scene.robot.max_speed_m_s
    if own_m_s < Limits().cruise_speed_m_s:
        yield f"limit     the robot drives at most {own_m_s:g} m/s everywhere, its `max_speed_m_s`"


def shaping_price(episode: Episode, person: str) -> Iterator[str]:
    """What another choice for a person is priced by: theirs, and where everybody else wants the robot.

    It is a choice of the first plan, and so what they said later is no part of it.
    """
    distances = (pair for pair in _planned_with(episode.prepared, None) if pair[1] == DISTANCE)
    return told_of(episode, (*_planned_with(episode.prepared, person), *distances), later=False)


def told_of(episode: Episode, pairs: Iterable[tuple[str, str]], *, later: bool = True) -> Iterator[str]:
    """A line for each value and what it is made of, by parameter.

    Args:
        episode: What happened.
        pairs: A person and one of their parameters each.
        later: Whether values count, too, that people asked for on the way.
    """
    people: dict[str, dict[str, list[str]]] = {}
    for one, name in dict.fromkeys(pairs):
        for each in held(episode, name, one)[: None if later else 1]:
            people.setdefault(name, {}).setdefault(_in_words(each, name), []).append(one)
    for name, alike in people.items():
        yield from (f"{HEAD}{name} of {', '.join(whose)} {words}" for words, whose in alike.items())


def _in_words(each: Held, name: str) -> str:
    value = each.values[name]
    since = f", from t={each.since_s:.2f} s on" if each.because else ""
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
        if one in values and nearest[one] < max(PASSED_M, *_reaches_m(episode, one)):
            yield one, DISTANCE


def _reaches_m(episode: Episode, person: str) -> Iterator[float]:
    """How far their space reached to the front, by each distance that they liked."""
    return (FRONT * one.values[DISTANCE].number for one in held(episode, DISTANCE, person))
