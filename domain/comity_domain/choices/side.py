"""The sides of a person from which the robot may come, and how suitable each is.

The inferred approach direction has no sign: 30 degrees may be on the left or on the right. Its desirability
curve over [0, 90] is therefore mirrored about 0 and cut into three sectors, for the planner to choose from.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_domain.choices.ties import tie_break
from comity_domain.problem.setting import is_setting
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.defuzzification.moved_curve import upper_limit
from comity_fis.inference.value import Inference, ParameterValue
from comity_fis.proxemics import FRONT_DEG, WIDEST_DEG


@dataclass(frozen=True, slots=True)
class Side:
    """One way to come near a person."""

    name: str
    """front, left or right, as the person sees it."""
    bearing_deg: float
    """From where the person faces to where the robot will stand, in (-180, 180], positive to their left."""
    desirability: float
    """In [0, 1]."""
    inferred: bool
    """The inferred direction lies on this side: it is the most desirable one of equals."""

    @property
    def tie_break(self) -> int:
        """What decides between sides of equal cost, as `ties` says; next are front, left, right."""
        return tie_break(self.desirability, departures=not self.inferred)


def sides(values: Inference) -> Mapping[str, Side]:
    """The sides that a person accepts, by name; what was asked for explicitly leaves no other.

    What was asked for and lies beyond `widest_deg` leaves none.
    """
    direction = values["approach_direction"]
    if is_setting(direction):
        if WIDEST_DEG > widest_deg(values) < direction.number:
            return {}
        return {side.name: side for side in _asked_for(direction.number)}
    return {side.name: side for side in _inferred(direction)}


def widest_deg(values: Inference) -> float:
    """How far round from a person's front the robot may stand [deg]: their direction's limits, at most 90."""
    return upper_limit(_curve(values["approach_direction"]), WIDEST_DEG)


def _asked_for(angle_deg: float) -> tuple[Side, ...]:
    """Both signs of the angle, where they differ."""
    if angle_deg == 0.0:
        return (Side("front", 0.0, 1.0, inferred=True),)
    left = Side("left", angle_deg, 1.0, inferred=True)
    if angle_deg == 180.0:
        return (left,)
    return (left, Side("right", -angle_deg, 1.0, inferred=True))


def _inferred(direction: ParameterValue) -> tuple[Side, ...]:
    curve = _curve(direction)
    from_the_side = abs(direction.number) > FRONT_DEG
    ahead = curve.height(0.0, FRONT_DEG)
    beside = curve.height(FRONT_DEG, WIDEST_DEG)
    bearing_deg = curve.centroid(FRONT_DEG, WIDEST_DEG)
    if bearing_deg is None:
        bearing_deg = (FRONT_DEG + WIDEST_DEG) / 2
    return (
        Side("front", 0.0, ahead, inferred=not from_the_side),  # the centre of a mirrored sector, by symmetry
        Side("left", bearing_deg, beside, inferred=from_the_side),
        Side("right", -bearing_deg, beside, inferred=from_the_side),
    )


def _curve(direction: ParameterValue) -> Curve:
    if isinstance(direction.desirability, Choice):
        raise TypeError(f"{direction.name} is nominal: it needs a curve over [0, {WIDEST_DEG:g}] degrees")
    return direction.desirability
