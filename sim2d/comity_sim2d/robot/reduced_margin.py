"""Decision whether the robot may pass a person closer than `PERSON_MARGIN_M`: a table of conditions.

The decision uses declared facts of the person, the current estimate of the tracker, and what the scenario
allows. It uses no cultural variable. Every condition is necessary, and an unknown fact fails its condition.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from comity_fis.proxemics import BEHIND_DEG, FACES_DEG, PERSON_MARGIN_M
from comity_sim2d.base.drive import REDUCED_M_S, SPEED_SHARE
from comity_sim2d.base.smoothing import acceleration_within, window_ticks
from comity_sim2d.scene.margin_facts import MarginFacts
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_sim2d.scene.person import Person

BODY_MARGIN_M = 0.15
"""Distance to a body that remains after all errors of the robot [m] (our choice: half of the margin)."""
ADULT_YEARS = 18.0
"""Minimum declared age [years]: the Convention on the Rights of the Child (1989), Article 1."""
UNAIDED_RADIUS_M = 0.35
"""Maximum radius of a person without a mobility aid [m] (our choice: a broad man's shoulders, 0.55 m, and
15 cm). Who takes up more room has a wheelchair, a frame or a chair, whatever else is declared."""
CONTROL_HZ = 20
"""Rate of commands if there is no world yet [Hz]."""


@dataclass(frozen=True, slots=True)
class PassageFacts:
    """All facts that the decision depends on. With the defaults it refuses."""

    asked_m: float = PERSON_MARGIN_M
    """`margin_m` of the scenario [m]."""
    least_m: float = PERSON_MARGIN_M
    """Result of `least_margin_m` [m]."""
    declared: MarginFacts = field(default_factory=MarginFacts)
    is_known: bool = False
    """Whether the tracker currently sees and recognises the person."""
    radius_m: float = math.inf
    """Radius of the person's body [m], with all that they sit in or lean on."""
    posture: str = ""
    walks: bool = True
    bearing_deg: float | None = None
    """Bearing of the robot from the person's heading, in [-180, 180] [deg]; None if unknown."""
    has_stepped_aside: bool = False
    """Whether the person was asked, moved, and stands again."""
    said_yes: bool = False
    """Whether the person was asked and agreed; silence means no."""
    said_otherwise: bool = True
    """Whether the last words of the person since they were asked are others than the yes."""
    has_waited: bool = False
    """Whether the robot has waited for the path to become free, and has asked."""
    has_other_route: bool = True
    """Whether a route of any length keeps the full margin."""


Condition = tuple[str, Callable[[PassageFacts], bool]]
"""The reason to refuse, and whether the condition holds."""


def _within(bearing_deg: float | None, most_deg: float) -> bool:
    """Whether a bearing is this small; an unknown one is refused by its own condition."""
    return bearing_deg is None or abs(bearing_deg) <= most_deg


def _is_adult(declared: MarginFacts) -> bool:
    return declared.age_years is not None and declared.age_years >= ADULT_YEARS


AGE = f"no age of {ADULT_YEARS:g} or more is declared"
MOBILITY = "that they walk without an aid is not declared"
HEARING = "that they hear well is not declared"
SIGHT = "that they see well is not declared"
FACTS = {MOBILITY: "mobility", HEARING: "hearing", SIGHT: "sight"}
"""Declared facts by the reason to refuse where they are unknown."""

CONDITIONS: tuple[Condition, ...] = (
    ("the scenario sets no smaller margin", lambda c: c.asked_m < PERSON_MARGIN_M),
    ("the robot cannot keep the margin that is set", lambda c: c.asked_m >= c.least_m),
    (AGE, lambda c: _is_adult(c.declared)),
    ("they use a wheelchair", lambda c: not c.declared.uses_wheelchair),
    (MOBILITY, lambda c: c.declared.walks_unaided or c.declared.uses_wheelchair),
    ("they take up the room of somebody with an aid", lambda c: c.radius_m <= UNAIDED_RADIUS_M),
    (HEARING, lambda c: c.declared.hears_well),
    (SIGHT, lambda c: c.declared.sees_well),
    ("the tracker does not see and recognise them", lambda c: c.is_known),
    ("they do not stand", lambda c: c.posture == "standing" and c.declared.stands),
    ("they walk", lambda c: not c.walks),
    ("it is not known where they face", lambda c: c.bearing_deg is not None),
    ("the robot comes from behind", lambda c: _within(c.bearing_deg, BEHIND_DEG)),
    ("they neither face nor answer the robot", lambda c: c.said_yes or _within(c.bearing_deg, FACES_DEG)),
    ("they neither stepped aside nor said yes", lambda c: c.has_stepped_aside or c.said_yes),
    ("the last that they said is not the yes", lambda c: not c.said_otherwise),
    ("the robot has not waited and asked", lambda c: c.has_waited),
    ("another route keeps the margin", lambda c: not c.has_other_route),
)


def reasons_against(now: PassageFacts) -> tuple[str, ...]:
    """Every reason to keep `PERSON_MARGIN_M` from a person; empty where the scenario's margin is granted."""
    return tuple(_told(reason, now.declared) for reason, holds in CONDITIONS if not holds(now))


def _told(reason: str, declared: MarginFacts) -> str:
    """A reason, with the age or the word that was declared."""
    if reason == AGE and declared.age_years is not None:
        return f"the least age that they declared is {declared.age_years:g}: below {ADULT_YEARS:g}"
    fact = FACTS.get(reason, "")
    word = dict(declared.words).get(fact)
    return f"they declared their {fact} as {word!r}" if word else reason


def could_pass(spec: RobotBody, person: Person) -> bool:
    """Whether the robot may pass a person at the scenario's margin, once the person faces it and lets it."""
    willing = PassageFacts(
        asked_m=spec.margin_m,
        least_m=least_margin_m(spec),
        declared=person.margin_facts,
        is_known=True,
        radius_m=person.radius_m,
        posture=person.posture,
        walks=person.may_move,
        bearing_deg=0.0,
        has_stepped_aside=True,
        said_yes=True,
        said_otherwise=False,
        has_waited=True,
        has_other_route=False,
    )
    return not reasons_against(willing)


def least_margin_m(spec: RobotBody, step_s: float = 1.0 / CONTROL_HZ) -> float:
    """Smallest margin that a robot can keep: 0.15 m + v t + v^2 / (2 a) + 2 sd [m].

    v is `REDUCED_M_S`; t the latency from a measurement to the motion: of the sensor, of one tick to command
    and one to move, and of a base that takes up commands slowly; a the deceleration of usual braking; sd the
    standard deviation of one measurement of a person's place.

    Args:
        spec: The robot's body.
        step_s: Time between two commands [s].
    """
    within = acceleration_within(spec.max_acceleration_m_s2, spec.max_jerk_m_s3)
    lag_s = (window_ticks(within, spec.max_jerk_m_s3, step_s) - 1) * step_s
    latency_s = spec.sensor.delay_s + 2.0 * step_s + lag_s
    return margin_for_m(latency_s, SPEED_SHARE * within, spec.sensor.sigma_m)


def margin_for_m(latency_s: float, braking_m_s2: float, sd_m: float) -> float:
    """Smallest margin that a robot with these errors can keep: 0.15 m + v t + v^2 / (2 a) + 2 sd [m].

    Args:
        latency_s: Latency t from a measurement to the resulting motion [s].
        braking_m_s2: Deceleration a [m/s^2], above 0.
        sd_m: Standard deviation of the estimated distance to a person [m].
    """
    stopping_m = REDUCED_M_S * latency_s + REDUCED_M_S**2 / (2.0 * braking_m_s2)
    return BODY_MARGIN_M + stopping_m + 2.0 * sd_m


def check_margin(spec: RobotBody, step_s: float = 1.0 / CONTROL_HZ) -> None:
    """Reject a margin that the robot cannot keep.

    Raises:
        SceneError: If it is lower than `PERSON_MARGIN_M` and than `least_margin_m`.
    """
    least_m = least_margin_m(spec, step_s)
    if spec.margin_m >= min(least_m, PERSON_MARGIN_M):
        return
    raise SceneError(
        entity=spec.name,
        field="margin_m",
        expected=f"margin_m of at least {least_m:.3f} m, which is {BODY_MARGIN_M:g} m and what this robot's "
        f"latency, braking and tracking add at {REDUCED_M_S:g} m/s",
        got=f"{spec.margin_m:g}",
        remedy=f"Set at least that, or leave it at {PERSON_MARGIN_M:g}; a sensor with less delay and noise "
        "and more acceleration lower it."
        if least_m < PERSON_MARGIN_M
        else f"Leave it at {PERSON_MARGIN_M:g}: this robot cannot keep less.",
    )
