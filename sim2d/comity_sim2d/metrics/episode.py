"""All figures of one episode, from its frames and what only the world and the tree know."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from comity_fis.errors import InputError, unknown_word
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import MOST_EXACT, TRUTH, require_kinds, require_numbers, require_pairs
from comity_sim2d.metrics import motion, proximity
from comity_sim2d.metrics.disturbed_walks import DisturbedWalk, disturbed_walk
from comity_sim2d.metrics.group_intrusion import group_intrusions
from comity_sim2d.metrics.intrusion import Intrusion, Since
from comity_sim2d.metrics.motion import Numbers, Span, Spread
from comity_sim2d.metrics.near_people import NearPeople, near_people, speed_near_m_s
from comity_sim2d.metrics.stopping import Stopping, TargetStop, stopping
from comity_sim2d.scene_error import is_number, require_tuple, require_whole, shown


@dataclass(frozen=True, slots=True)
class Contacts:
    """How many contacts of the robot began, by what it touched; the world knows them."""

    people: int = 0
    walls: int = 0
    furniture: int = 0

    def __post_init__(self) -> None:
        for what in ("people", "walls", "furniture"):
            require_whole("contacts", what, getattr(self, what), 0, MOST_EXACT)


@dataclass(frozen=True, slots=True)
class Known:
    """What frames do not tell."""

    contacts: Contacts | None = None
    """None: those with people are counted from the frames, and of things nothing is known."""
    own_m: Mapping[str, float] = field(default_factory=dict)
    """The distance that each person likes, by name; of whom it is not known, it is `route_map.COMFORT_M`."""
    later_m: Mapping[str, Since] = field(default_factory=dict)
    """Since when [s] a person likes another distance [m], by name and in order of time."""
    visits: tuple[TargetStop, ...] = ()
    """In the order of the visits."""
    engaged: Mapping[str, tuple[Span, ...]] | None = None
    """When the robot was on its way to each person or with them, by name; None: as the visits say."""
    shortest_m: float | None = None
    """The length of the shortest way that would have done."""
    groups: tuple[tuple[str, ...], ...] = ()
    """The members of each group that stands together at the start."""
    success: bool = True
    plan_cost_m: float | None = None
    """What the first plan costs, in metres of path."""
    plan_gap: float | None = None
    """The share of it that a better plan could at most save, in [0, 1]."""
    undisturbed: Mapping[str, Numbers] = field(default_factory=dict)
    """Walks without the robot, by person or passer-by: ascending times [s], x and y [m], shape (m, 3)."""

    def __post_init__(self) -> None:
        contacts, success = (self.contacts, Contacts | None), (self.success, TRUTH)
        require_kinds("what is known", contacts=contacts, own_m=(self.own_m, Mapping), success=success)
        require_kinds(
            "what is known", later_m=(self.later_m, Mapping), engaged=(self.engaged, Mapping | None)
        )
        require_kinds("what is known", undisturbed=(self.undisturbed, Mapping))
        for pairs in self.later_m.values():
            require_pairs("what is known", "later_m", pairs, "(since_s, distance_m)")
        require_tuple("what is known", "visits", self.visits, TargetStop, "visits, each a Wanted")
        require_tuple("what is known", "groups", self.groups, tuple, "groups, each a tuple of names")
        require_numbers("what is known", shortest_m=self.shortest_m)
        require_numbers("what is known", plan_cost_m=self.plan_cost_m, plan_gap=self.plan_gap)


@dataclass(frozen=True, slots=True)
class Metrics:
    """Figures of an episode; `registry` says what each means and where it comes from."""

    duration_s: float
    path_length_m: float
    path_length_ratio: float | None
    path_irregularity_rad_m: float
    success_weighted_by_path_length: float | None
    speed_m_s: Spread
    acceleration_m_s2: Spread
    jerk_m_s3: Spread
    heading_change_rad: float
    stalled_s: float
    failures_to_progress: int
    person_contacts: int
    wall_contacts: int | None
    furniture_contacts: int | None
    touches: int | None
    min_clearance_m: float
    min_centre_distance_m: float
    intimate_space_surface_s: float
    personal_space_surface_s: float
    social_space_surface_s: float
    near_people: NearPeople
    min_time_to_collision_s: float
    space_compliance_share: float
    longest_intrusion_s: float
    group_intrusions: int
    walked_m: float
    mean_walker_delay_s: float | None
    mean_walker_deviation_m: float | None
    plan_cost_m: float | None
    plan_gap: float | None
    compliance_share: Mapping[str, float]
    """By person whose own distance is known."""
    longest_intrusion_by_person_s: Mapping[str, float]
    """Likewise."""
    walked_by_person_m: Mapping[str, float]
    """Likewise."""
    p95_speed_near_by_person_m_s: Mapping[str, float]
    """Likewise, where the robot was ever within 1.5 m of the person."""
    disturbed_walks: Mapping[str, DisturbedWalk]
    """By person or passer-by whose walk without the robot is known."""
    stopping: Mapping[str, Stopping]
    """By person who was visited."""


def measure(frames: Frames, known: Known | None = None) -> Metrics:
    """Measure an episode.

    Args:
        frames: Where everybody was; the robot is entity 0.
        known: What frames do not tell; without it only what they do.

    Raises:
        InputError: Of no frames at all, where `own_m`, `later_m`, `groups` or `undisturbed` names a person
            who is not in them, and where it holds no distance or no walk.
        ValueError: if a visit names a person who is not in the frames.
    """
    known = _checked(frames, known)
    touched, gaps = known.contacts, proximity.clearances_m(frames)
    under_way = [way for visit in known.visits for way in visit.ways]
    collision_s = proximity.seconds_to_collision(frames)
    intimate, personal, social, _ = proximity.seconds_in_zones(frames, gaps)
    intrusion = intrusion_of(frames, known, gaps)
    longest = intrusion.longest(frames)
    walked = motion.path_lengths_m(frames)
    length = float(walked[0])
    walks = {
        name: disturbed_walk(frames.time_s, frames.of(name)[:, :2], alone)
        for name, alone in known.undisturbed.items()
    }
    return Metrics(
        duration_s=float(frames.time_s[-1] - frames.time_s[0]),
        path_length_m=length,
        path_length_ratio=length / known.shortest_m if known.shortest_m and known.success else None,
        path_irregularity_rad_m=motion.path_irregularity_rad_m(frames),
        success_weighted_by_path_length=_spl(length, known),
        speed_m_s=motion.speed_m_s(frames),
        acceleration_m_s2=motion.acceleration_m_s2(frames),
        jerk_m_s3=motion.jerk_m_s3(frames),
        heading_change_rad=motion.heading_change_rad(frames),
        stalled_s=motion.stalled_s(frames, under_way),
        failures_to_progress=motion.failures_to_progress(frames, under_way),
        person_contacts=touched.people if touched else proximity.contacts(gaps),
        wall_contacts=touched.walls if touched else None,
        furniture_contacts=touched.furniture if touched else None,
        touches=touched.people + touched.walls + touched.furniture if touched else None,
        min_clearance_m=float(gaps.min(initial=math.inf)),
        min_centre_distance_m=float((gaps + _reach_m(frames)).min(initial=math.inf)),
        intimate_space_surface_s=intimate,
        personal_space_surface_s=personal,
        social_space_surface_s=social,
        near_people=near_people(frames, gaps, collision_s),
        min_time_to_collision_s=float(collision_s.min(initial=math.inf)),
        space_compliance_share=intrusion.compliance_share(frames),
        longest_intrusion_s=longest.length_s if longest else 0.0,
        group_intrusions=group_intrusions(frames, known.groups, intrusion),
        walked_m=float(walked[1:].sum()),
        mean_walker_delay_s=_mean(walk.delay_s for walk in walks.values()),
        mean_walker_deviation_m=_mean(walk.deviation_m for walk in walks.values()),
        plan_cost_m=known.plan_cost_m,
        plan_gap=known.plan_gap,
        compliance_share=intrusion.compliance_by_person(frames),
        longest_intrusion_by_person_s=intrusion.longest_by_person_s(frames),
        walked_by_person_m={
            name: float(walked[i]) for i, name in enumerate(frames.entities) if name in intrusion.own
        },
        p95_speed_near_by_person_m_s=_speeds_near_m_s(frames, gaps, intrusion.own),
        disturbed_walks=walks,
        stopping={visit.person: stopping(frames, visit) for visit in known.visits},
    )


def _mean(values: Iterable[float]) -> float | None:
    known = tuple(values)
    return sum(known) / len(known) if known else None


def _checked(frames: Frames, known: Known | None) -> Known:
    """What is known, if all of it is of people in the frames."""
    require_kinds("figures", frames=(frames, Frames), known=(known, Known | None))
    if len(frames) == 0:
        raise InputError(expected="at least one frame", got="none", remedy="Let the world run first.")
    known = known or Known()
    for member in chain.from_iterable(known.groups):
        _require_person("groups", member, frames.entities[1:])
    for name, walk in known.undisturbed.items():
        _require_person("undisturbed", name, frames.entities[1:])
        if not (np.ndim(walk) == 2 and len(walk) > 0 and np.shape(walk)[1] == 3):
            expected = "undisturbed walks of the shape (m, 3): time, x and y"
            got = f"{np.shape(walk)} of {name}"
            raise InputError(expected=expected, got=got, remedy="Take those of `undisturbed_walks`.")
    _check_own("own_m", known.own_m.items(), frames.entities[1:])
    later = ((name, distance_m) for name, pairs in known.later_m.items() for _, distance_m in pairs)
    _check_own("later_m", later, frames.entities[1:])
    return known


def _speeds_near_m_s(frames: Frames, gaps: Numbers, people: Container[str]) -> dict[str, float]:
    """95th percentile of the robot's speed near each of some people; without those it never came near."""
    speeds = {
        name: speed_near_m_s(frames, gaps[:, i : i + 1])
        for i, name in enumerate(frames.entities[1:])
        if name in people
    }
    return {name: speed for name, speed in speeds.items() if speed is not None}


def _check_own(what: str, distances: Iterable[tuple[str, float]], people: tuple[str, ...]) -> None:
    for name, distance_m in distances:
        _require_person(what, name, people)
        if not (is_number(distance_m) and 0.0 <= distance_m < math.inf):
            raise InputError(
                expected=f"distances of 0 m or more in {what}",
                got=f"{shown(distance_m)} of {name}",
                remedy="Leave out whose distance is not known.",
            )


def _require_person(what: str, name: str, people: tuple[str, ...]) -> None:
    if name not in people:
        raise unknown_word(f"{what} of people of the frames", name, people)


def _spl(length_m: float, known: Known) -> float | None:
    """Success weighted by path length, `S l / max(p, l)` (Anderson et al. 2018, arXiv 1807.06757)."""
    if known.shortest_m is None:
        return None
    longest = max(length_m, known.shortest_m)
    return float(known.success) * (known.shortest_m / longest if longest > 0.0 else 1.0)


def intrusion_of(frames: Frames, known: Known, gaps: Numbers | None = None) -> Intrusion:
    """In which frames the robot was within whose distance while it neither visited nor left that person.

    Args:
        frames: Where everybody was.
        known: Each person's distance, and when each was visited.
        gaps: Of `clearances_m`, where they are known.
    """
    gaps = proximity.clearances_m(frames) if gaps is None else gaps
    engaged = _by_person(known.visits) if known.engaged is None else known.engaged
    return Intrusion.of(frames, gaps, known.own_m, engaged, known.later_m)


def _by_person(visits: Iterable[TargetStop]) -> dict[str, list[Span]]:
    spans: dict[str, list[Span]] = {}
    for visit in visits:
        spans.setdefault(visit.person, []).extend(visit.spans)
    return spans


def _reach_m(frames: Frames) -> Numbers:
    """Centre distance minus gap, by person."""
    return np.array(frames.radius_m[1:]) + frames.radius_m[0]
