"""The parameters that shaped a figure, a line each, with the rules behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from comity.report.values.inference import in_brief
from comity.testing.metrics.amount import told
from comity_sim2d.metrics import clearances_m

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

HEAD = "goes by   "
"""How these lines begin: each says all of one parameter, so that a text need not say it twice."""
DISTANCE = "conversational_distance"
PASSED_M = 2.0
"""Whoever the robot passes nearer than this may have moved its way: no rule gives so much (our choice)."""


def shaping(trial: Trial, person: str | None = None) -> Iterator[str]:
    """What the steps of the plan go by, and the distances of those who were passed by; alike ones together.

    Args:
        trial: What happened.
        person: Of one visit alone; None for the whole run.
    """
    return told_of(trial, (*_planned_with(trial, person), *(() if person else _passed(trial))))


def shaping_price(trial: Trial, person: str) -> Iterator[str]:
    """What another choice for somebody is priced by: theirs, and where everybody else wants the robot."""
    distances = (pair for pair in _planned_with(trial, None) if pair[1] == DISTANCE)
    return told_of(trial, (*_planned_with(trial, person), *distances))


def told_of(trial: Trial, pairs: Iterable[tuple[str, str]]) -> Iterator[str]:
    """A line for each value and what it is made of, by parameter."""
    people: dict[str, dict[str, list[str]]] = {}
    for one, name in dict.fromkeys(pairs):
        values = trial.values(one)
        words = f"{told(values[name].value, values[name].unit)}: {in_brief(values[name], values.inputs)}"
        people.setdefault(name, {}).setdefault(words, []).append(one)
    for name, alike in people.items():
        yield from (f"{HEAD}{name} of {', '.join(whose)} {words}" for words, whose in alike.items())


def _planned_with(trial: Trial, person: str | None) -> Iterator[tuple[str, str]]:
    """Somebody and one of their parameters, for every step."""
    for step in trial.prepared.plan.steps:
        if person is None or person in step.people:
            for one in step.people:
                known = trial.values(one).parameters
                yield from ((one, name) for name in step.parameters if name in known)


def _passed(trial: Trial) -> Iterator[tuple[str, str]]:
    """Whoever the robot came near, the nearest first."""
    frames, values = trial.episode.frames, trial.prepared.values
    nearest = dict(zip(frames.entities[1:], clearances_m(frames).min(axis=0), strict=True))
    for one in sorted(nearest, key=lambda name: nearest[name]):
        if nearest[one] < PASSED_M and one in values and DISTANCE in values[one].parameters:
            yield one, DISTANCE
