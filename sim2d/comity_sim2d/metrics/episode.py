"""All metrics of one episode, from its frames and from what only the world and the behaviour tree know."""

from __future__ import annotations

import math
from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from comity_sim2d.frames import Frames
from comity_sim2d.metrics import motion, proximity
from comity_sim2d.metrics.disturbed_walks import DisturbedWalk, disturbed_walk
from comity_sim2d.metrics.group_intrusion import group_intrusions
from comity_sim2d.metrics.intrusion import Intrusion
from comity_sim2d.metrics.known import Known, checked
from comity_sim2d.metrics.metric import ANDERSON, FRANCIS, HUNAVSIM, defined
from comity_sim2d.metrics.motion import Numbers, Span
from comity_sim2d.metrics.near_people import NearPeople, near_people, speed_near_m_s
from comity_sim2d.metrics.stopping import Stopping, TargetStop, stopping


@dataclass(frozen=True, slots=True)
class Metrics:
    """Metrics of an episode, each with its unit, definition and source."""

    duration_s: float = field(metadata=defined("s", "From the first frame to the last.", FRANCIS))
    path_length_m: float = field(metadata=defined("m", "Path length of the robot's centre.", FRANCIS))
    path_length_ratio: float | None = field(
        metadata=defined(
            "1",
            "Path length by that of the shortest path through the places where it docked, around people at "
            "the safety margin; of episodes that served all.",
        )
    )
    path_irregularity_rad_m: float = field(
        metadata=defined(
            "rad/m",
            "Turning of the direction of travel for each metre of path, in stretches of 0.1 m; turns that "
            "walls and people demand are included.",
        )
    )
    success_weighted_by_path_length: float | None = field(
        metadata=defined(
            "1",
            "Success times l / max(p, l): p the path length, l the shortest path through the places where "
            "it docked, around people at the safety margin.",
            ANDERSON,
            most=1.0,
        )
    )
    mean_speed_m_s: float = field(
        metadata=defined("m/s", "Mean speed over the episode, standing included.", FRANCIS)
    )
    max_speed_m_s: float = field(metadata=defined("m/s", "Largest speed between two frames.", FRANCIS))
    mean_acceleration_m_s2: float = field(
        metadata=defined("m/s^2", "Mean size of the change of velocity.", FRANCIS)
    )
    max_acceleration_m_s2: float = field(
        metadata=defined("m/s^2", "Largest size of the change of velocity.", FRANCIS)
    )
    mean_jerk_m_s3: float = field(
        metadata=defined("m/s^3", "Mean size of the change of acceleration.", FRANCIS)
    )
    max_jerk_m_s3: float = field(
        metadata=defined("m/s^3", "Largest size of the change of acceleration.", FRANCIS)
    )
    heading_change_rad: float = field(
        metadata=defined("rad", "All turning of the robot, both ways added up.", HUNAVSIM)
    )
    stalled_s: float = field(
        metadata=defined("s", "Slower than 0.02 m/s before the robot first docked, visit by visit.", FRANCIS)
    )
    failures_to_progress: int = field(
        metadata=defined(
            "1", "How often it came no farther than 0.1 m in 3 s before it first docked.", FRANCIS
        )
    )
    person_contacts: int = field(
        metadata=defined(
            "1", "Contacts with people that began; from frames alone, overlaps of bodies.", FRANCIS
        )
    )
    wall_contacts: int | None = field(
        metadata=defined("1", "Contacts with walls and closed doors that began.", FRANCIS)
    )
    furniture_contacts: int | None = field(
        metadata=defined("1", "Contacts with furniture that began.", FRANCIS)
    )
    touches: int | None = field(metadata=defined("1", "Contacts of every kind that began."))
    min_clearance_m: float = field(
        metadata=defined("m", "Smallest gap to any person, between surfaces.", FRANCIS, least=None)
    )
    min_centre_distance_m: float = field(
        metadata=defined("m", "Smallest distance to any person, between centres.", FRANCIS)
    )
    intimate_space_surface_s: float = field(
        metadata=defined("s", "Nearest person closer than 0.45 m, between surfaces.", HUNAVSIM)
    )
    personal_space_surface_s: float = field(
        metadata=defined("s", "Nearest person at 0.45 to 1.2 m, between surfaces.", HUNAVSIM)
    )
    social_space_surface_s: float = field(
        metadata=defined("s", "Nearest person at 1.2 to 3.6 m, between surfaces.", HUNAVSIM)
    )
    near_people: NearPeople
    min_time_to_collision_s: float = field(
        metadata=defined(
            "s", "Least time until robot and a person would touch if both went on as they go.", FRANCIS
        )
    )
    space_compliance_share: float = field(
        metadata=defined(
            "1",
            "Share of time in which the robot was outside the distance of all people it was neither "
            "visiting nor leaving, to 1 cm, between surfaces.",
            FRANCIS,
            most=1.0,
        )
    )
    longest_intrusion_s: float = field(
        metadata=defined(
            "s",
            "Longest time within a person's distance while it was neither visiting nor leaving them; per "
            "run, of all people.",
        )
    )
    group_intrusions: int = field(
        metadata=defined(
            "1",
            "How often the robot's body entered the space between people who stand together, while it "
            "neither visited nor left any of them, and all of them stood where they began.",
        )
    )
    walked_m: float = field(
        metadata=defined(
            "m", "Path length of a person's centre; per run, of all people together, passers-by included."
        )
    )
    mean_walker_delay_s: float | None = field(
        metadata=defined(
            "s",
            "Mean over those who walk, passers-by included, of their largest delay: how much later a person "
            "came to a place of the path taken without the robot, with the same seed.",
        )
    )
    mean_walker_deviation_m: float | None = field(
        metadata=defined(
            "m", "Mean over the same people of their largest distance from the path taken without the robot."
        )
    )
    plan_cost_m: float | None = field(metadata=defined("m", "What the first plan costs, in metres of path."))
    plan_gap: float | None = field(
        metadata=defined(
            "1", "Share of that cost which a better plan could at most save; 0: none costs less.", most=1.0
        )
    )
    stopping: Mapping[str, Stopping]
    """By visited person."""
    compliance_share: Mapping[str, float] = field(
        metadata=defined(
            "1",
            "Share of time, visits to them left out, in which the robot was outside this person's distance, "
            "to 1 cm, between surfaces.",
            per="person",
            most=1.0,
        )
    )
    """By person whose own distance is known."""
    longest_intrusion_by_person_s: Mapping[str, float] = field(
        metadata=defined(
            "s",
            "Longest time within a person's distance while it was neither visiting nor leaving them; per "
            "run, of all people.",
            per="person",
            name="longest_intrusion_s",
        )
    )
    """Likewise."""
    p95_speed_near_by_person_m_s: Mapping[str, float] = field(
        metadata=defined(
            "m/s",
            "95th percentile of the robot's speed within 1.5 m of this person, between surfaces.",
            per="person",
            name="p95_speed_within_1_5_m_m_s",
        )
    )
    """Likewise, if the robot was ever within 1.5 m of the person."""
    walked_by_person_m: Mapping[str, float] = field(
        metadata=defined(
            "m",
            "Path length of a person's centre; per run, of all people together, passers-by included.",
            per="person",
            name="walked_m",
        )
    )
    """Likewise."""
    disturbed_walks: Mapping[str, DisturbedWalk]
    """By person or passer-by whose walk without the robot is known."""


def measure(frames: Frames, known: Known | None = None) -> Metrics:
    """Measure an episode.

    Args:
        frames: Poses of all entities; the robot is entity 0.
        known: What the frames do not contain; None: only the metrics that the frames give.

    Raises:
        InputError: If there are no frames, if `own_m`, `later_m`, `groups` or `undisturbed` names a person
            who is not in them, or holds an invalid distance or walk.
        ValueError: If a visit names a person who is not in the frames.
    """
    known = checked(frames, known)
    touched, gaps = known.contacts, proximity.clearances_m(frames)
    under_way = [way for visit in known.visits for way in visit.ways]
    collision_s = proximity.seconds_to_collision(frames)
    intimate, personal, social, _ = proximity.seconds_in_zones(frames, gaps)
    intrusion = intrusion_of(frames, known, gaps)
    longest = intrusion.longest(frames)
    walked = motion.path_lengths_m(frames)
    length = float(walked[0])
    speeds, jerks = motion.speeds_m_s(frames), motion.jerks_m_s3(frames)
    accelerations = motion.accelerations_m_s2(frames)
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
        mean_speed_m_s=motion.mean(speeds),
        max_speed_m_s=float(speeds.max(initial=0.0)),
        mean_acceleration_m_s2=motion.mean(accelerations),
        max_acceleration_m_s2=float(accelerations.max(initial=0.0)),
        mean_jerk_m_s3=motion.mean(jerks),
        max_jerk_m_s3=float(jerks.max(initial=0.0)),
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
        mean_walker_delay_s=_mean(walk.walk_delay_s for walk in walks.values()),
        mean_walker_deviation_m=_mean(walk.walk_deviation_m for walk in walks.values()),
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


def _speeds_near_m_s(frames: Frames, gaps: Numbers, people: Container[str]) -> dict[str, float]:
    """95th percentile of the robot's speed near each person [m/s]; people it never came near are left out."""
    speeds = {
        name: speed_near_m_s(frames, gaps[:, i : i + 1])
        for i, name in enumerate(frames.entities[1:])
        if name in people
    }
    return {name: speed for name, speed in speeds.items() if speed is not None}


def _spl(length_m: float, known: Known) -> float | None:
    """Success weighted by path length, `S l / max(p, l)` (Anderson et al. 2018, arXiv 1807.06757)."""
    if known.shortest_m is None:
        return None
    longest = max(length_m, known.shortest_m)
    return float(known.success) * (known.shortest_m / longest if longest > 0.0 else 1.0)


def intrusion_of(frames: Frames, known: Known, gaps: Numbers | None = None) -> Intrusion:
    """The frames in which the robot intruded on a person, that is, while neither visiting nor leaving them.

    Args:
        frames: Poses of all entities.
        known: Each person's own distance, and when each was visited.
        gaps: Result of `clearances_m`, if already computed.
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
    """Centre distance minus gap, by person [m]."""
    return np.array(frames.radius_m[1:]) + frames.radius_m[0]
