"""Parts of a place that have a name: areas, which are the rooms of a map, and locations, which are points."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.pose import XY


@dataclass(frozen=True, slots=True)
class Area:
    """A part of the floor with a name, such as a room."""

    name: str
    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""


@dataclass(frozen=True, slots=True)
class Location:
    """A point with a name, where somebody can stand."""

    name: str
    x_m: float
    y_m: float
    heading_rad: float | None = None
    """Which way one faces there; None: no matter."""

    @property
    def xy(self) -> XY:
        """Where it is."""
        return (self.x_m, self.y_m)
