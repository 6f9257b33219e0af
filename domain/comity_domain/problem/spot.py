"""Where the robot may stand, and what leads from one such place to another."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Spot:
    """A place to stand: beside a person, on one of their sides, or where something is kept."""

    place: str
    """The person's name, or the location's."""
    side: str


START = Spot("start", "here")
"""Where the robot stands now. No person's side is called `here`, so a person may be called start."""
THERE = "there"
"""What takes the place of a side at a location."""

Way = tuple[str | None, str]
"""From a person, a location or the start (None) to a person or a location, whatever the sides."""

Leg = tuple[Spot, Spot]
"""From START or a spot to a spot."""

Travel = Mapping[Leg, float]
"""Route lengths in metres; where there is no entry, there is no route."""


def location(name: str) -> Spot:
    """Where the robot stands to fetch something."""
    return Spot(name, THERE)


Nearness = Mapping[str, float]
"""How far the robot stands from others, by name, between the nearest points of the two bodies [m]."""


def place_of(spot: Spot) -> str | None:
    """Before whom, or at which location, a spot is; None at the start, as a person may be called start."""
    return None if spot == START else spot.place


def names_in(leg: tuple[Spot, Spot], names: Collection[str]) -> bool:
    """Whether a leg begins or ends before one of these people."""
    return any(place_of(spot) in names for spot in leg)
