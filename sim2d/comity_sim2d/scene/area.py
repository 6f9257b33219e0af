"""Parts of a place that have a name: areas, which are the rooms of a map, and locations, which are points."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.pose import XY
from comity_sim2d.scene_error import require_finite, require_points, require_text


@dataclass(frozen=True, slots=True)
class Area:
    """A part of the floor with a name, such as a room."""

    name: str
    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""

    def __post_init__(self) -> None:
        require_text("room", "name", self.name)
        require_points(f"room {self.name}", "corners", self.corners)


@dataclass(frozen=True, slots=True)
class Location:
    """A named point where a person can stand."""

    name: str
    x_m: float
    y_m: float
    heading_rad: float | None = None
    """Heading of a person there [rad]; None: any."""

    def __post_init__(self) -> None:
        require_text("location", "name", self.name)
        entity = f"location {self.name}"
        require_finite(entity, x_m=self.x_m, y_m=self.y_m)
        if self.heading_rad is not None:
            require_finite(entity, heading_rad=self.heading_rad)

    @property
    def xy(self) -> XY:
        """Position [m]."""
        return (self.x_m, self.y_m)
