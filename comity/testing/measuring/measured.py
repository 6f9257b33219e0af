"""Measured results of a case: for reports, and to compare profiles without running the episode again.

These numbers need the events of an episode, or the outcomes of visits. Those computed from frames alone are
in `comity_sim2d.EPISODE` and `VISIT`. `docs/reference/metrics.md` lists all of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

from comity.testing.amounts.course import runs
from comity.testing.amounts.ordering import visited
from comity.testing.amounts.standing import DockedPose, standing
from comity.testing.measuring.safety import Danger, dangers
from comity.testing.trials.visits import approached, outcome_of, values_when_judged, visit_of
from comity_domain.problem.bound_parameters import DISTANCE
from comity_executor.memory.visit_context import SAY_ACT
from comity_sim2d.metrics.metric import Metric, by_name, defined, definitions
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.trials.case import Case
    from comity_executor import TraceEvent
    from comity_sim2d import Frames

_PHASES = ("way_s", "coming_near_s", "greeting_s", "attending_s")
_OF_NODE = {
    "Navigate_to_user": "way_s",
    "Dock_to_user": "coming_near_s",
    "Face_user": "coming_near_s",
    "Attend_to": "attending_s",
}
_SERVED = ("greeted", "skipped")


@dataclass(frozen=True, slots=True)
class Measured:
    """Results of one episode, small enough to store and to send to another process."""

    scenario: str
    profile: str
    seed: int
    outcome: str
    wanted: int
    """Number of people to visit, without those who declined."""
    served: int = field(
        metadata=defined(
            "1",
            "People greeted, and people that the plan skipped at the scenario's price. As a mean: the share "
            "of the people to visit who did not decline.",
        )
    )
    time_s: float = field(metadata=defined("s", "From the start to when the last node of the tree ended."))
    distances_m: Mapping[str, tuple[float, float | None]] = field(
        metadata=defined(
            "m",
            "Size of the difference between the docking distance (surface to surface, as the robot docked "
            "last) and the target at the end of the episode, for each person at whom it docked; `--fairness` "
            "takes the largest of an episode.",
            name="distance_error_m",
        )
    )
    """By person, the last target distance and the actual one [m]."""
    way_s: float = field(
        metadata=defined("s", "Time on the way: navigation to people (`Navigate_to_user`), over all visits.")
    )
    coming_near_s: float = field(
        metadata=defined(
            "s", "Time of coming near: docking and facing (`Dock_to_user`, `Face_user`), over all visits."
        )
    )
    greeting_s: float = field(
        metadata=defined(
            "s",
            "Time of the greeting: words and gestures, over all visits; those at the same time count once.",
        )
    )
    attending_s: float = field(
        metadata=defined("s", "Time of attending to people (`Attend_to`), over all visits.")
    )
    intrusion_s: float = field(metadata=defined("s", "The episode's `longest_intrusion_s`."))
    detour_m: float = field(
        metadata=defined(
            "m",
            "Path length of the robot's centre beyond the straight lines from its start through the places "
            "where it docked.",
        )
    )
    values: Mapping[str, float | str]
    """The parameters of the person who has the case's profile."""
    settings: tuple[str, ...]
    """Those of these parameters that the person set."""
    order: tuple[str, ...]
    """People at whom the robot docked, in order."""
    dangers: tuple[Danger, ...]

    @property
    def distance_error_m(self) -> float:
        """The largest error among the people reached [m]."""
        reached = [(target, actual) for target, actual in self.distances_m.values() if actual is not None]
        return max((abs(actual - target) for target, actual in reached), default=0.0)

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """Properties for JUnit reports, besides the case's own."""
        yield from (("outcome", self.outcome), ("simulated_s", round(self.time_s, 6)))
        for person, (target, actual) in self.distances_m.items():
            yield f"distance_target_m.{person}", round(target, 4)
            yield f"distance_wanted_m.{person}", round(target, 4)  # the older name, for one release
            if actual is not None:
                yield f"distance_actual_m.{person}", round(actual, 4)
                yield f"distance_reached_m.{person}", round(actual, 4)


TESTED: Mapping[str, Metric] = by_name(*definitions(Measured))
"""Metrics that `comity test` compares between profiles, by name."""


def measured(case: Case, episode: Episode) -> Measured:
    """Summarise the episode of a case."""
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
        **_phases(episode.events),
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
    """The last target distance [m]: the person may have asked for another one during the episode."""
    visit = visit_of(episode.visits, person)
    if visit is not None and visit.wanted is not None:
        return visit.wanted.distance_m
    return values_when_judged(episode, person, DISTANCE)[DISTANCE].number


def _phases(events: Iterable[TraceEvent]) -> dict[str, float]:
    spans: dict[str, list[tuple[float, float]]] = {phase: [] for phase in _PHASES}
    for took, start, node in runs(event for event in events if event.of.kind == "action"):
        acts = node.action in VERBS or node.action == SAY_ACT
        phase = _OF_NODE.get(node.action) or ("greeting_s" if acts else None)
        if phase:
            spans[phase].append((start, start + took))
    return {phase: _covered(times) for phase, times in spans.items()}


def _covered(spans: list[tuple[float, float]]) -> float:
    """Total time covered by at least one span [s]: words and gestures may overlap."""
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
