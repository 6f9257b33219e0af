"""What a case amounts to: for reports, and to compare how profiles are served without another episode."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from comity.testing.amounts.course import runs
from comity.testing.amounts.ordering import visited
from comity.testing.amounts.standing import DockedPose, standing
from comity.testing.measuring.safety import Danger, dangers
from comity.testing.trials.visits import approached, outcome_of, values_when_judged, visit_of
from comity_domain.problem.bound_parameters import DISTANCE
from comity_executor.memory.visit_context import SAY_ACT
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.trials.case import Case
    from comity_executor import TraceEvent
    from comity_sim2d import Frames

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
    """One episode, small enough to keep and to send to another process; `TESTED` defines its numbers."""

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
    """By phase: those of `PHASES`."""
    intrusion_s: float
    """`longest_intrusion_s` of the episode's metrics."""
    detour_m: float
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
        for person, (target, actual) in self.distances_m.items():
            yield f"distance_target_m.{person}", round(target, 4)
            yield f"distance_wanted_m.{person}", round(target, 4)  # the older name, for one release
            if actual is not None:
                yield f"distance_actual_m.{person}", round(actual, 4)
                yield f"distance_reached_m.{person}", round(actual, 4)


def measured(case: Case, episode: Episode) -> Measured:
    """Sum up what came of a case."""
    prepared, frames = episode.prepared, episode.frames
    stops = {person: standing(frames, episode.visits, person) for person in approached(prepared.plan)}
    fared = [outcome_of(episode, person) for person in prepared.file.scenario.visited()]
    outcomes = [outcome for outcome in fared if outcome != "declined"]
    person = case.people[0]
    values = {
        name: values_when_judged(episode, person, name)[name] for name in prepared.values[person].parameters
    }
    return Measured(
        scenario=prepared.file.scenario.name,
        profile=case.profile_name,
        seed=case.seed,
        outcome=episode.outcome,
        served=sum(outcome in _SERVED for outcome in outcomes),
        wanted=len(outcomes),
        time_s=episode.history.end_s,
        phases_s=_phases(episode.events),
        intrusion_s=episode.metrics.longest_intrusion_s,
        detour_m=_detour_m(frames, episode.metrics.path_length_m, [stop for stop in stops.values() if stop]),
        distances_m={
            name: (_target_m(episode, name), stop.distance_m if stop else None)
            for name, stop in stops.items()
        },
        values={name: value.value for name, value in values.items()},
        settings=tuple(name for name, value in values.items() if value.origin == "setting"),
        order=visited(episode.events),
        dangers=tuple(dangers(episode)),
    )


def _target_m(episode: Episode, person: str) -> float:
    """The distance that the robot went by last: the person may have asked for another one by then."""
    visit = visit_of(episode.visits, person)
    if visit is not None and visit.wanted is not None:
        return visit.wanted.distance_m
    return values_when_judged(episode, person, DISTANCE)[DISTANCE].number


def _phases(events: Iterable[TraceEvent]) -> dict[str, float]:
    spans: dict[str, list[tuple[float, float]]] = {phase: [] for phase in PHASES}
    for took, start, node in runs(event for event in events if event.of.kind == "action"):
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


def _detour_m(frames: Frames, path_length_m: float, stops: list[DockedPose]) -> float:
    ordered = sorted(stops, key=lambda stop: stop.t)
    moments = [0, *(int(abs(frames.time_s - stop.t).argmin()) for stop in ordered)]
    places = [frames.poses[moment, 0, :2] for moment in moments]
    straight = sum(math.dist(one, other) for one, other in pairwise(places))
    return max(0.0, path_length_m - straight)
