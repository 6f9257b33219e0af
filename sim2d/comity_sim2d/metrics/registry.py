"""All metrics: name, unit, definition, source, and whether there is one per run, per visit or per person."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from types import MappingProxyType
from typing import Literal

from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics.episode import Metrics
from comity_sim2d.metrics.motion import Spread
from comity_sim2d.metrics.near_people import NearPeople
from comity_sim2d.metrics.stopping import Stopping

FRANCIS = "Francis et al. 2023, arXiv 2306.16740"
HUNAVSIM = "Pérez-Higueras et al. 2023, HuNavSim, arXiv 2305.01303"
ANDERSON = "Anderson et al. 2018, arXiv 1807.06757"
OWN = "Comity's own"
HALL = "Hall 1966, The Hidden Dimension"
HALF_TURN_DEG = 180.0
_ENDS: Mapping[str, str] = {
    "m/s^3": "_m_s3",
    "m/s^2": "_m_s2",
    "m/s": "_m_s",
    "rad/m": "_rad_m",
    "m": "_m",
    "s": "_s",
    "deg": "_deg",
    "rad": "_rad",
}
"""By unit, the end of a metric's name."""


@dataclass(frozen=True, slots=True)
class Metric:
    """One metric."""

    name: str
    """As JSON and tables have it, with the unit at its end."""
    unit: str
    """`1` for a share or a count."""
    means: str
    source: str = OWN
    per: Literal["run", "visit", "person"] = "run"
    """`visit`: of a person whom the robot was to visit; `person`: of any person of the scenario."""
    least: float | None = 0.0
    """The least that it can be, in its unit; None: there is none."""
    most: float | None = None
    """The most, likewise."""

    @property
    def short_name(self) -> str:
        """The name without its unit, as sentences have it."""
        return without_unit(self.name, self.unit)


def without_unit(name: str, unit: str) -> str:
    """The name of a value without the unit at its end: `path_length` of `path_length_m` and `m`."""
    return name.removesuffix(_ENDS.get(unit, ""))


def by_name(*metrics: Metric) -> Mapping[str, Metric]:
    """The metrics by their names, in their order."""
    return MappingProxyType({metric.name: metric for metric in metrics})


EPISODE: Mapping[str, Metric] = by_name(
    Metric("duration_s", "s", "From the first frame to the last.", FRANCIS),
    Metric("path_length_m", "m", "Path length of the robot's centre.", FRANCIS),
    Metric(
        "path_length_ratio",
        "1",
        "Path length by that of the shortest path through the places where it docked, around people at the "
        "safety margin; of episodes that served all.",
    ),
    Metric(
        "path_irregularity_rad_m",
        "rad/m",
        "Turning of the direction of travel for each metre of path, in stretches of 0.1 m; turns that walls "
        "and people demand are included.",
    ),
    Metric(
        "success_weighted_by_path_length",
        "1",
        "Success times l / max(p, l): p the path length, l the shortest path through the places where it "
        "docked, around people at the safety margin.",
        ANDERSON,
        most=1.0,
    ),
    Metric("mean_speed_m_s", "m/s", "Mean speed over the episode, standing included.", FRANCIS),
    Metric("max_speed_m_s", "m/s", "Largest speed between two frames.", FRANCIS),
    Metric("mean_acceleration_m_s2", "m/s^2", "Mean size of the change of velocity.", FRANCIS),
    Metric("max_acceleration_m_s2", "m/s^2", "Largest size of the change of velocity.", FRANCIS),
    Metric("mean_jerk_m_s3", "m/s^3", "Mean size of the change of acceleration.", FRANCIS),
    Metric("max_jerk_m_s3", "m/s^3", "Largest size of the change of acceleration.", FRANCIS),
    Metric("heading_change_rad", "rad", "All turning of the robot, both ways added up.", HUNAVSIM),
    Metric("stalled_s", "s", "Slower than 0.02 m/s before the robot first docked, visit by visit.", FRANCIS),
    Metric(
        "failures_to_progress",
        "1",
        "How often it came no farther than 0.1 m in 3 s before it first docked.",
        FRANCIS,
    ),
    Metric(
        "person_contacts",
        "1",
        "Contacts with people that began; from frames alone, overlaps of bodies.",
        FRANCIS,
    ),
    Metric("wall_contacts", "1", "Contacts with walls and closed doors that began.", FRANCIS),
    Metric("furniture_contacts", "1", "Contacts with furniture that began.", FRANCIS),
    Metric("touches", "1", "Contacts of every kind that began."),
    Metric(
        "contacts_by_robot",
        "1",
        "Contacts with people that began, in the frames, with the robot coming at the person at least as "
        "fast as the person came at it.",
    ),
    Metric("contacts_by_people", "1", "The other contacts with people that began in the frames."),
    Metric("min_clearance_m", "m", "Smallest gap to any person, between surfaces.", FRANCIS, least=None),
    Metric("min_centre_distance_m", "m", "Smallest distance to any person, between centres.", FRANCIS),
    Metric("intimate_space_surface_s", "s", "Nearest person closer than 0.45 m, between surfaces.", HUNAVSIM),
    Metric("personal_space_surface_s", "s", "Nearest person at 0.45 to 1.2 m, between surfaces.", HUNAVSIM),
    Metric("social_space_surface_s", "s", "Nearest person at 1.2 to 3.6 m, between surfaces.", HUNAVSIM),
    Metric(
        "mean_nearest_distance_m",
        "m",
        "Mean gap to the nearest person over time, between surfaces.",
        HUNAVSIM,
        least=None,
    ),
    *(
        Metric(
            f"{zone}_space_share",
            "1",
            f"Share of time with the nearest person {where}, between surfaces.",
            HALL,
            most=1.0,
        )
        for zone, where in (
            ("intimate", "closer than 0.45 m"),
            ("personal", "at 0.45 to 1.2 m"),
            ("social", "at 1.2 to 3.6 m"),
            ("public", "at 3.6 m or more"),
        )
    ),
    Metric(
        "p95_speed_within_1_5_m_m_s",
        "m/s",
        "95th percentile of the robot's speed within 1.5 m of any person, between surfaces.",
    ),
    Metric(
        "group_intrusions",
        "1",
        "How often the robot's body entered the space between people who stand together, while it neither "
        "visited nor left any of them, and all of them stood where they began.",
    ),
    Metric(
        "min_time_to_collision_s",
        "s",
        "Least time until robot and a person would touch if both went on as they go.",
        FRANCIS,
    ),
    Metric(
        "space_compliance_share",
        "1",
        "Share of time in which the robot was outside the distance of all people it was neither visiting "
        "nor leaving, to 1 cm, between surfaces.",
        FRANCIS,
        most=1.0,
    ),
    Metric(
        "longest_intrusion_s",
        "s",
        "Longest time within a person's distance while it was neither visiting nor leaving them; per run, "
        "of all people.",
    ),
    Metric(
        "walked_m",
        "m",
        "Path length of a person's centre; per run, of all people together, passers-by included.",
    ),
    Metric(
        "mean_walker_delay_s",
        "s",
        "Mean over those who walk, passers-by included, of their largest delay: how much later a person came "
        "to a place of the path taken without the robot, with the same seed.",
    ),
    Metric(
        "mean_walker_deviation_m",
        "m",
        "Mean over the same people of their largest distance from the path taken without the robot.",
    ),
    Metric("plan_cost_m", "m", "What the first plan costs, in metres of path."),
    Metric(
        "plan_gap",
        "1",
        "Share of that cost which a better plan could at most save; 0: none costs less.",
        most=1.0,
    ),
)
"""Per run. What has no value (nobody there, no path known) is left out."""

VISIT: Mapping[str, Metric] = by_name(
    Metric(
        "docking_error_m",
        "m",
        "Between actual distance and the person's own as the robot docked last, between surfaces.",
        per="visit",
    ),
    Metric("docking_time_s", "s", "When the robot docked last, from the start.", per="visit"),
    Metric(
        "chosen_distance_m",
        "m",
        "Distance of the docking pose chosen last, between surfaces; of a person who moved, as they left it.",
        per="visit",
        least=None,
    ),
    Metric(
        "chosen_bearing_deg",
        "deg",
        "Bearing of the docking pose chosen last, positive to the person's left; of one who turned, as they "
        "left it.",
        per="visit",
        least=-HALF_TURN_DEG,
        most=HALF_TURN_DEG,
    ),
    Metric(
        "stop_distance_error_m",
        "m",
        "Distance at the stop minus target, between surfaces, where it docked.",
        per="visit",
        least=None,
    ),
    Metric(
        "overshoot_m",
        "m",
        "How much nearer it came during the visit than the target of that moment, at least 0.",
        per="visit",
    ),
    Metric(
        "bearing_error_deg",
        "deg",
        "Between target and actual bearing, at that rest.",
        per="visit",
        most=HALF_TURN_DEG,
    ),
    Metric(
        "robot_facing_error_deg",
        "deg",
        "How far the robot looked past the person, at that rest.",
        per="visit",
        most=HALF_TURN_DEG,
    ),
    Metric(
        "person_facing_error_deg",
        "deg",
        "How far the person looked past the robot, less the target bearing, at that rest.",
        per="visit",
        most=HALF_TURN_DEG,
    ),
    Metric(
        "speed_within_1_5_m_m_s",
        "m/s",
        "Fastest within 1.5 m of the body on the way in, from any side, less the person's own speed.",
        per="visit",
    ),
    Metric("speed_at_3_6_m_m_s", "m/s", "Speed when it came within 3.6 m, between surfaces.", per="visit"),
    Metric("speed_at_1_2_m_m_s", "m/s", "Speed when it came within 1.2 m, between surfaces.", per="visit"),
    Metric("speed_at_target_plus_0_3_m_m_s", "m/s", "Speed 0.3 m before the target distance.", per="visit"),
    Metric("peak_closing_speed_m_s", "m/s", "Fastest shrinking of the gap on the way in.", per="visit"),
    Metric("peak_deceleration_m_s2", "m/s^2", "Hardest braking on the way in.", per="visit"),
    Metric(
        "visible_approach_share",
        "1",
        "Within 3.6 m: share of time within 60 degrees of where the person looks.",
        per="visit",
        most=1.0,
    ),
    Metric(
        "hold_error_rms_m",
        "m",
        "Root mean square of distance minus target, 5 s from that rest on, or to its end or a new wish.",
        per="visit",
    ),
    Metric(
        "compliance_share",
        "1",
        "Share of time, visits to them left out, in which the robot was outside this person's distance, "
        "to 1 cm, between surfaces.",
        per="person",
        most=1.0,
    ),
    Metric(
        "longest_intrusion_s",
        "s",
        "Longest time within a person's distance while it was neither visiting nor leaving them; per run, "
        "of all people.",
        per="person",
    ),
    Metric(
        "p95_speed_within_1_5_m_m_s",
        "m/s",
        "95th percentile of the robot's speed within 1.5 m of this person, between surfaces.",
        per="person",
    ),
    Metric(
        "walked_m",
        "m",
        "Path length of a person's centre; per run, of all people together, passers-by included.",
        per="person",
    ),
    Metric(
        "walk_delay_s",
        "s",
        "Largest delay of a person who walks: how much later they came to a place of the path taken without "
        "the robot, with the same seed.",
        per="person",
    ),
    Metric(
        "walk_deviation_m",
        "m",
        "Largest distance of a person who walks from the path taken without the robot, with the same seed.",
        per="person",
    ),
)
"""Per visit, and per person."""


def by_short_name(metrics: Mapping[str, Metric]) -> Mapping[str, Metric]:
    """The metrics by their names with the unit and without it."""
    return {each.short_name: each for each in metrics.values()} | dict(metrics)


def of_episode(metrics: Metrics) -> dict[str, float]:
    """The metrics of the run by the names of `EPISODE`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics))
    flat: dict[str, float | None] = {}
    for field in fields(Metrics):
        value = getattr(metrics, field.name)
        if isinstance(value, Spread):
            flat |= {f"{part}_{field.name}": getattr(value, part) for part in ("mean", "max")}
        elif isinstance(value, NearPeople):
            flat |= asdict(value)
        elif value is None or isinstance(value, int | float):
            flat[field.name] = value
    return _with_values(flat)


def of_person(metrics: Metrics, person: str) -> dict[str, float]:
    """The metrics of one person by the names of `VISIT`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics), person=(person, str))
    stopped = metrics.stopping.get(person)
    values = {field.name: getattr(stopped, field.name) for field in fields(Stopping)} if stopped else {}
    walk = metrics.disturbed_walks.get(person)
    own = {
        "compliance_share": metrics.compliance_share.get(person),
        "longest_intrusion_s": metrics.longest_intrusion_by_person_s.get(person),
        "p95_speed_within_1_5_m_m_s": metrics.p95_speed_near_by_person_m_s.get(person),
        "walked_m": metrics.walked_by_person_m.get(person),
        "walk_delay_s": walk.delay_s if walk else None,
        "walk_deviation_m": walk.deviation_m if walk else None,
    }
    return _with_values({**values, **own})


def _with_values(figures: Mapping[str, float | None]) -> dict[str, float]:
    return {name: value for name, value in figures.items() if value is not None and math.isfinite(value)}
