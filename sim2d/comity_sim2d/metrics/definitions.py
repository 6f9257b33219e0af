"""What each figure means, its unit, and where its definition comes from, by the name that JSON has."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType

from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics.episode import Metrics
from comity_sim2d.metrics.motion import Spread
from comity_sim2d.metrics.stopping import Stopping

FRANCIS = "Francis et al. 2023, arXiv 2306.16740"
HUNAVSIM = "Pérez-Higueras et al. 2023, HuNavSim, arXiv 2305.01303"
ANDERSON = "Anderson et al. 2018, arXiv 1807.06757"
OWN = "Comity's own"


@dataclass(frozen=True, slots=True)
class Definition:
    """One figure."""

    unit: str
    """`1` for a share or a count."""
    means: str
    source: str


EPISODE: Mapping[str, Definition] = MappingProxyType(
    {
        "duration_s": Definition("s", "From the first frame to the last.", FRANCIS),
        "path_length_m": Definition("m", "Way of the robot's centre.", FRANCIS),
        "success_weighted_by_path_length": Definition(
            "1",
            "Success times l / max(p, l): p the way gone, l the shortest way through the places where it "
            "docked, around people at the safety margin.",
            ANDERSON,
        ),
        "min_speed_m_s": Definition("m/s", "Least speed between two frames.", FRANCIS),
        "mean_speed_m_s": Definition("m/s", "Mean speed over the episode, standing included.", FRANCIS),
        "max_speed_m_s": Definition("m/s", "Largest speed between two frames.", FRANCIS),
        "min_acceleration_m_s2": Definition("m/s^2", "Least size of the change of velocity.", FRANCIS),
        "mean_acceleration_m_s2": Definition("m/s^2", "Mean size of the change of velocity.", FRANCIS),
        "max_acceleration_m_s2": Definition("m/s^2", "Largest size of the change of velocity.", FRANCIS),
        "min_jerk_m_s3": Definition("m/s^3", "Least size of the change of acceleration.", FRANCIS),
        "mean_jerk_m_s3": Definition("m/s^3", "Mean size of the change of acceleration.", FRANCIS),
        "max_jerk_m_s3": Definition("m/s^3", "Largest size of the change of acceleration.", FRANCIS),
        "heading_change_rad": Definition("rad", "All turning of the robot, both ways added up.", HUNAVSIM),
        "stalled_s": Definition(
            "s", "Slower than 0.02 m/s before the robot first docked, visit by visit.", FRANCIS
        ),
        "failures_to_progress": Definition(
            "1", "How often it came no farther than 0.1 m in 3 s before it first docked.", FRANCIS
        ),
        "person_contacts": Definition(
            "1", "Contacts with people that began; from frames alone, overlaps of bodies.", FRANCIS
        ),
        "wall_contacts": Definition("1", "Contacts with walls and closed doors that began.", FRANCIS),
        "furniture_contacts": Definition("1", "Contacts with furniture that began.", FRANCIS),
        "touches": Definition("1", "Contacts of every kind that began.", OWN),
        "min_clearance_m": Definition("m", "Smallest gap to any person, between surfaces.", FRANCIS),
        "min_centre_distance_m": Definition(
            "m", "Smallest distance to any person, between centres.", FRANCIS
        ),
        "intimate_space_surface_s": Definition(
            "s", "Nearest person closer than 0.45 m, between surfaces.", HUNAVSIM
        ),
        "personal_space_surface_s": Definition(
            "s", "Nearest person at 0.45 to 1.2 m, between surfaces.", HUNAVSIM
        ),
        "social_space_surface_s": Definition(
            "s", "Nearest person at 1.2 to 3.6 m, between surfaces.", HUNAVSIM
        ),
        "min_time_to_collision_s": Definition(
            "s", "Least time until robot and a person would touch if both went on as they go.", FRANCIS
        ),
        "space_compliance_share": Definition(
            "1",
            "Share of time in which the robot was outside the distance of all people it was neither visiting "
            "nor leaving, to 1 cm, between surfaces.",
            FRANCIS,
        ),
        "longest_intrusion_s": Definition(
            "s",
            "Longest time within the distance of a person it was neither visiting nor leaving.",
            OWN,
        ),
    }
)
"""Of the whole episode. What has no value (nobody there, no way known) is left out."""

VISIT: Mapping[str, Definition] = MappingProxyType(
    {
        "stop_distance_error_m": Definition(
            "m", "Distance at the stop minus wanted, between surfaces, where it docked.", OWN
        ),
        "overshoot_m": Definition(
            "m", "How much nearer it came during the visit than was wanted then, at least 0.", OWN
        ),
        "bearing_error_deg": Definition("deg", "Between wanted and reached bearing, at that rest.", OWN),
        "robot_facing_error_deg": Definition(
            "deg", "How far the robot looked past the person, at that rest.", OWN
        ),
        "person_facing_error_deg": Definition(
            "deg", "How far the person looked past the robot, less the wanted bearing, at that rest.", OWN
        ),
        "speed_within_1_5_m_m_s": Definition(
            "m/s",
            "Fastest within 1.5 m of the body on the way in, from any side, less the person's own speed.",
            OWN,
        ),
        "speed_at_3_6_m_m_s": Definition("m/s", "Speed when it came within 3.6 m, between surfaces.", OWN),
        "speed_at_1_2_m_m_s": Definition("m/s", "Speed when it came within 1.2 m, between surfaces.", OWN),
        "speed_at_wanted_plus_0_3_m_m_s": Definition("m/s", "Speed 0.3 m before the wanted distance.", OWN),
        "peak_closing_speed_m_s": Definition("m/s", "Fastest shrinking of the gap on the way in.", OWN),
        "peak_deceleration_m_s2": Definition("m/s^2", "Hardest braking on the way in.", OWN),
        "visible_approach_share": Definition(
            "1", "Within 3.6 m: share of time within 60 degrees of where the person looks.", OWN
        ),
        "hold_error_rms_m": Definition(
            "m",
            "Root mean square of distance minus wanted, 5 s from that rest on, or to its end or a new wish.",
            OWN,
        ),
        "compliance_share": Definition(
            "1",
            "Share of time, visits to them left out, in which the robot was outside this person's distance, "
            "to 1 cm, between surfaces.",
            OWN,
        ),
    }
)
"""Of one person."""


def of_episode(metrics: Metrics) -> dict[str, float]:
    """The figures of the whole episode by the names of `EPISODE`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics))
    flat: dict[str, float | None] = {}
    for field in fields(Metrics):
        value = getattr(metrics, field.name)
        if isinstance(value, Spread):
            flat |= {f"{part}_{field.name}": getattr(value, part) for part in ("min", "mean", "max")}
        elif value is None or isinstance(value, int | float):
            flat[field.name] = value
    return _with_values(flat)


def of_person(metrics: Metrics, person: str) -> dict[str, float]:
    """The figures of one person by the names of `VISIT`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics), person=(person, str))
    stopped = metrics.stopping.get(person)
    values = {field.name: getattr(stopped, field.name) for field in fields(Stopping)} if stopped else {}
    return _with_values({**values, "compliance_share": metrics.compliance_share.get(person)})


def _with_values(figures: Mapping[str, float | None]) -> dict[str, float]:
    return {name: value for name, value in figures.items() if value is not None and math.isfinite(value)}
