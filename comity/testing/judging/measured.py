"""What a case amounts to: for reports, and to compare how profiles are served without another episode."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from comity.parameters.passing import DISTANCE
from comity.testing.amounts.course import actions
from comity.testing.amounts.moments import intrusion
from comity.testing.amounts.standing import Standing, standing
from comity.testing.judging.safety import Danger, dangers
from comity.testing.kinds.order import visited
from comity_executor.memory.meeting import SAY_ACT
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

PHASES = ("way", "coming near", "greeting", "attending")
_OF_NODE = {
    "Navigate_to_user": "way",
    "Dock_to_user": "coming near",
    "Face_user": "coming near",
    "Attend_to": "attending",
}
_SERVED = ("greeted", "skipped")


@dataclass(frozen=True, slots=True)
class Measured:
    """One episode, small enough to keep and to send to another process."""

    scenario: str
    profile: str
    seed: int
    outcome: str
    served: int
    wanted: int
    """Without people who declined."""
    time_s: float
    """Until the last node ended."""
    phases_s: Mapping[str, float]
    """By phase, summed over the visits."""
    intrusion_s: float
    """The longest time in the distance of somebody who was not visited then, passers-by among them."""
    detour_m: float
    """The way beyond the straight lines from stop to stop."""
    distances_m: Mapping[str, tuple[float, float | None]]
    """By person, wanted at last and reached."""
    values: Mapping[str, float | str]
    """The parameters of the person who has the case's profile."""
    settings: tuple[str, ...]
    """Of these parameters, those that the person asked for."""
    order: tuple[str, ...]
    """At whom the robot docked, in this order."""
    dangers: tuple[Danger, ...]

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """For JUnit reports, beside the case's own."""
        yield from (("outcome", self.outcome), ("simulated_s", round(self.time_s, 6)))
        for person, (wanted, reached) in self.distances_m.items():
            yield f"distance_wanted_m.{person}", round(wanted, 4)
            if reached is not None:
                yield f"distance_reached_m.{person}", round(reached, 4)


def measured(trial: Trial) -> Measured:
    """Sum a trial up."""
    stops = {person: standing(trial, person) for person in trial.approached}
    fared = [trial.outcome_of(person) for person in trial.prepared.file.scenario.visited()]
    outcomes = [outcome for outcome in fared if outcome != "declined"]
    person = trial.case.people[0]
    values = {name: trial.values(person, name)[name] for name in trial.prepared.values[person].parameters}
    return Measured(
        scenario=trial.prepared.file.scenario.name,
        profile=trial.case.profile_name,
        seed=trial.case.seed,
        outcome=trial.episode.outcome,
        served=sum(outcome in _SERVED for outcome in outcomes),
        wanted=len(outcomes),
        time_s=trial.episode.history.end_s,
        phases_s=_phases(trial),
        intrusion_s=_intrusion_s(trial),
        detour_m=_detour_m(trial, [stop for stop in stops.values() if stop]),
        distances_m={
            name: (_wanted_m(trial, name), stop.distance_m if stop else None) for name, stop in stops.items()
        },
        values={name: value.value for name, value in values.items()},
        settings=tuple(name for name, value in values.items() if value.origin == "setting"),
        order=visited(trial),
        dangers=tuple(dangers(trial)),
    )


def _wanted_m(trial: Trial, person: str) -> float:
    """The distance that the robot went by last: somebody may have asked for another one by then."""
    visit = trial.visit(person)
    if visit is not None and visit.wanted is not None:
        return visit.wanted.distance_m
    return trial.values(person, DISTANCE)[DISTANCE].number


def _intrusion_s(trial: Trial) -> float:
    stay = intrusion(trial).longest(trial.episode.frames)
    return stay.length_s if stay else 0.0


def _phases(trial: Trial) -> dict[str, float]:
    spans: dict[str, list[tuple[float, float]]] = {phase: [] for phase in PHASES}
    for took, start, node in actions(trial):
        acts = node.action in VERBS or node.action == SAY_ACT
        phase = _OF_NODE.get(node.action) or ("greeting" if acts else None)
        if phase:
            spans[phase].append((start, start + took))
    return {phase: _covered(times) for phase, times in spans.items()}


def _covered(spans: list[tuple[float, float]]) -> float:
    """How long at least one of them lasts: words and gestures go together."""
    total, until = 0.0, -math.inf
    for start, end in sorted(spans):
        total += max(0.0, end - max(start, until))
        until = max(until, end)
    return total


def _detour_m(trial: Trial, stops: list[Standing]) -> float:
    frames = trial.episode.frames
    ordered = sorted(stops, key=lambda stop: stop.t)
    moments = [0, *(int(abs(frames.time_s - stop.t).argmin()) for stop in ordered)]
    places = [frames.poses[moment, 0, :2] for moment in moments]
    straight = sum(math.dist(one, other) for one, other in pairwise(places))
    return max(0.0, trial.episode.metrics.path_length_m - straight)
