"""The sides from which the robot may approach a person, with their desirability.

The inferred approach direction is unsigned: 30 degrees may be left or right. So its desirability curve over
[0, 90] is mirrored about 0 and cut into three sectors, from which the planner chooses.
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
    """One side of a person."""

    name: str
    """Name: front, left or right, as the person sees it."""
    bearing_deg: float
    """Angle from the person's facing to the robot, in (-180, 180], positive to their left [deg]."""
    desirability: float
    """Desirability, in [0, 1]."""
    inferred: bool
    """Whether the inferred direction lies on this side: it is the most desirable one of equals."""

    @property
    def tie_break(self) -> int:
        """Tie-break between sides of equal cost, see `ties`; after that: front, left, right."""
        return tie_break(self.desirability, departures=not self.inferred)


def sides(values: Inference) -> Mapping[str, Side]:
    """The sides that a person accepts, by name; an explicit request leaves no other.

    A request beyond `widest_deg` leaves none.
    """
    direction = values["approach_direction"]
    if is_setting(direction):
        if WIDEST_DEG > widest_deg(values) < direction.number:
            return {}
        return {side.name: side for side in _asked_for(direction.number)}
    return {side.name: side for side in _inferred(direction)}


def widest_deg(values: Inference) -> float:
    """Maximum unsigned bearing of the robot [deg]: the limit of the person's direction, at most 90."""
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
