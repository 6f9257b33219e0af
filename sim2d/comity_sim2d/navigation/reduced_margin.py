"""Whether the robot may pass a person nearer than `PERSON_MARGIN_M`: one decision, all conditions in a table.

The decision reads declared facts of the person, what the tracker shows now, and what the scenario and the
operator allow. It reads no cultural variable. Every condition is necessary, and a fact that is not known
fails its condition.

Nothing calls it yet: routes keep `PERSON_MARGIN_M` from everybody until a scenario can set its own margin.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from comity_sim2d.scene.obstacles import PERSON_MARGIN_M
from comity_sim2d.scene_error import require_between

BODY_MARGIN_M = 0.15
"""Distance that is left to a body after all errors of the robot [m] (our choice: half of the margin)."""
FASTEST_M_S = 0.2
"""Maximum speed beside a person at a reduced margin [m/s] (our choice)."""
ADULT_YEARS = 18.0
"""Minimum declared age [years]: the Convention on the Rights of the Child (1989), Article 1."""
FACING_DEG, BEHIND_DEG = 60.0, 90.0
"""A robot within the first bearing of the person's heading is faced; beyond the second it comes from behind
(our choice)."""


@dataclass(frozen=True, slots=True)
class PassageFacts:
    """All that the decision depends on. The defaults refuse."""

    asked_m: float = PERSON_MARGIN_M
    """`margin_m` of the scenario [m]."""
    latency_s: float | None = None
    """From a measurement until the base acts on it, at most [s]; None: the robot does not state it."""
    braking_m_s2: float | None = None
    """Deceleration of the base [m/s^2], above 0; None: not stated."""
    tracking_sd_m: float | None = None
    """Standard deviation of the position of a tracked person [m]; None: not stated."""
    is_allowed: bool = False
    """Whether the operator of a real robot allows it; true in simulation."""
    speed_m_s: float = float("inf")
    """Maximum speed while the person is near [m/s]."""
    age_years: float | None = None
    """Declared age, the least where a range was declared; None: not disclosed."""
    is_known: bool = False
    """Whether the tracker sees the person now and knows which person it is."""
    posture: str = ""
    walks: bool = True
    has_mobility_aid: bool = True
    has_reduced_hearing: bool = True
    has_reduced_sight: bool = True
    bearing_deg: float | None = None
    """Robot as seen from the person, from the person's heading [deg], in [-180, 180]; None: not known."""
    has_stepped_aside: bool = False
    """Whether the person was asked, moved, and stands again."""
    said_yes: bool = False
    """Whether the person was asked, and agreed; silence is no."""
    has_waited: bool = False
    """Whether the robot has waited for the way to become free, and has asked."""
    has_other_route: bool = True
    """Whether a route of any length keeps the full margin."""


Condition = tuple[str, Callable[[PassageFacts], bool]]
"""The reason to refuse, and whether the condition holds."""


def _within(bearing_deg: float | None, most_deg: float) -> bool:
    return bearing_deg is not None and abs(bearing_deg) <= most_deg


CONDITIONS: tuple[Condition, ...] = (
    ("the scenario sets no smaller margin", lambda c: c.asked_m < PERSON_MARGIN_M),
    (
        "the robot does not state its latency, braking and tracking errors",
        lambda c: None not in (c.latency_s, c.braking_m_s2, c.tracking_sd_m),
    ),
    ("the operator does not allow it", lambda c: c.is_allowed),
    (f"the robot is faster than {FASTEST_M_S:g} m/s", lambda c: c.speed_m_s <= FASTEST_M_S),
    ("no age is declared", lambda c: c.age_years is not None),
    (
        f"the declared age is below {ADULT_YEARS:g}",
        lambda c: c.age_years is None or c.age_years >= ADULT_YEARS,
    ),
    ("the tracker does not know the person", lambda c: c.is_known),
    ("the person does not stand", lambda c: c.posture == "standing"),
    ("the person walks", lambda c: not c.walks),
    ("the person has a mobility aid", lambda c: not c.has_mobility_aid),
    ("the person hears less", lambda c: not c.has_reduced_hearing),
    ("the person sees less", lambda c: not c.has_reduced_sight),
    ("the robot comes from behind", lambda c: _within(c.bearing_deg, BEHIND_DEG)),
    (
        "the person neither faces nor answers the robot",
        lambda c: c.said_yes or _within(c.bearing_deg, FACING_DEG),
    ),
    (
        "the person neither stepped aside nor said yes",
        lambda c: c.has_stepped_aside or c.said_yes,
    ),
    ("the robot has not waited and asked", lambda c: c.has_waited),
    ("another route keeps the margin", lambda c: not c.has_other_route),
)


@dataclass(frozen=True, slots=True)
class PersonMargin:
    """The clearance that a route keeps from one person, surface to surface."""

    clearance_m: float
    reasons: tuple[str, ...]
    """Why it is not less; empty where the margin of the scenario is granted."""


def least_margin_m(
    latency_s: float, braking_m_s2: float, tracking_sd_m: float, speed_m_s: float = FASTEST_M_S
) -> float:
    """Smallest margin that a robot can keep: 0.15 m + v t + v^2 / (2 a) + 2 sd [m].

    Args:
        latency_s: From a measurement until the base acts on it, t [s], in [0, 10].
        braking_m_s2: Deceleration a [m/s^2], in [0.01, 100].
        tracking_sd_m: Standard deviation of a tracked position, sd [m], in [0, 10].
        speed_m_s: Speed v [m/s], in [0, 0.2].

    Raises:
        SceneError: Where a number is outside its range.
    """
    require_between("robot", "latency_s", latency_s, 0.0, 10.0)
    require_between("robot", "braking_m_s2", braking_m_s2, 0.01, 100.0)
    require_between("robot", "tracking_sd_m", tracking_sd_m, 0.0, 10.0)
    require_between("robot", "speed_m_s", speed_m_s, 0.0, FASTEST_M_S)
    stopping_m = speed_m_s * latency_s + speed_m_s**2 / (2.0 * braking_m_s2)
    return BODY_MARGIN_M + stopping_m + 2.0 * tracking_sd_m


def margin_for(now: PassageFacts) -> PersonMargin:
    """The margin beside one person: the scenario's if every condition holds, else `PERSON_MARGIN_M`.

    A margin below what the robot can keep is refused, not raised.
    """
    reasons = tuple(reason for reason, holds in CONDITIONS if not holds(now))
    if not reasons:
        assert now.latency_s is not None
        assert now.braking_m_s2 is not None
        assert now.tracking_sd_m is not None
        least_m = least_margin_m(now.latency_s, now.braking_m_s2, now.tracking_sd_m, max(now.speed_m_s, 0.0))
        if not now.asked_m >= least_m:
            reasons = (f"the robot can keep {least_m:.2f} m at least, and {now.asked_m:.2f} m is set",)
    return PersonMargin(PERSON_MARGIN_M, reasons) if reasons else PersonMargin(now.asked_m, ())
