"""Spots where the robot may stand, and the legs and routes between them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, order=True)
class Spot:
    """A spot to stand at: on one side of a person, or at the location of an object."""

    place: str
    """Name of the person or location."""
    side: str


START = Spot("start", "here")
"""The robot's current position. No side of a person is called `here`, so a person may be called `start`."""
THERE = "there"
"""Replaces the side at a location."""

Way = tuple[str | None, str]
"""From a person, a location or the start (None) to a person or a location, whatever the sides."""

Leg = tuple[Spot, Spot]
"""From START or a spot to a spot."""

Travel = Mapping[Leg, float]
"""Route lengths [m]; a missing entry means that there is no route."""


def location(name: str) -> Spot:
    """The spot for fetching an object at a location."""
    return Spot(name, THERE)


Nearness = Mapping[str, float]
"""Distances from the robot to other people, by name, between the nearest points of the bodies [m]."""


def place_of(spot: Spot) -> str | None:
    """The person or location that a spot belongs to; None for the start, as a person may be called start."""
    return None if spot == START else spot.place


def names_in(leg: tuple[Spot, Spot], names: Collection[str]) -> bool:
    """Whether a leg begins or ends at one of these people."""
    return any(place_of(spot) in names for spot in leg)
