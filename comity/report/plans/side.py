"""Conversion of an approach direction, which has no left or right, to the bearing of a side."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from comity_domain import PlanStep

SIDES = (
    "An approach direction counts off the person's front, to the left and the right alike: on the side front "
    "the two cancel out, and the bearing is 0."
)
"""Explanation why a direction of 11.7 deg may be approached from the front."""


def toward(steps: Iterable[PlanStep], person: str, parameter: str) -> str:
    """Suffix ` → front` for the approach direction of a visited person, else empty."""
    if parameter != "approach_direction":
        return ""
    sides = [step.arguments[-1] for step in steps if step.action == "Reach_user" and step.person == person]
    return f" → {sides[0]}" if sides else ""
