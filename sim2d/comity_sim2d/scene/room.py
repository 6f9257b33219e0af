"""A room: its floor, its inner walls, and its furniture."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from comity_sim2d.kinds import require_kinds
from comity_sim2d.pose import XY
from comity_sim2d.scene_error import (
    SceneError,
    require_between,
    require_finite,
    require_points,
    require_text,
    require_tuple,
)

CIRCLE_CORNERS = 24
"""Number of corners of round furniture, which is up to 0.9 % wider than specified (our choice)."""


@dataclass(frozen=True, slots=True)
class Room:
    """The walkable floor as a polygon; its outline is a wall."""

    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""
    holes: tuple[tuple[XY, ...], ...] = ()
    """Holes in the floor, such as a courtyard: the corners of each, all inside the room [m]."""

    def __post_init__(self) -> None:
        require_tuple("room", "holes", self.holes, tuple, "outlines, each of points `(x, y)`")
        _require_corners("room", self.corners)
        for hole in self.holes:
            _require_corners("room", hole, "holes")

    @property
    def outlines(self) -> tuple[tuple[XY, ...], ...]:
        """The outer outline, then that of every hole."""
        return (self.corners, *self.holes)

    @classmethod
    def rectangle(cls, width_m: float, height_m: float) -> Room:
        """A room with one corner at the origin: `width_m` along x, `height_m` along y."""
        require_between("room", "width_m", width_m, 0.01, 1000.0)
        require_between("room", "height_m", height_m, 0.01, 1000.0)
        return cls(((0.0, 0.0), (width_m, 0.0), (width_m, height_m), (0.0, height_m)))


@dataclass(frozen=True, slots=True)
class Wall:
    """An inner wall: a straight line with a thickness and round ends."""

    start: XY
    end: XY
    thickness_m: float = 0.10
    name: str = ""
    """Name for messages and pictures; unnamed walls go by their number in the scene."""

    def __post_init__(self) -> None:
        require_kinds("wall", name=(self.name, str))
        entity = self.name or "wall"
        require_points(entity, "start", (self.start,))
        require_points(entity, "end", (self.end,))
        require_between(entity, "thickness_m", self.thickness_m, 0.001, 10.0)
        if self.start == self.end:
            raise SceneError(
                entity=entity,
                expected="a wall between two different points",
                got=f"{self.start} twice",
                remedy="Give the wall a length, or use furniture for a pillar.",
            )


@dataclass(frozen=True, slots=True)
class Furniture:
    """An obstacle: a simple polygon with a name."""

    name: str
    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""

    def __post_init__(self) -> None:
        require_text("furniture", "name", self.name)
        _require_corners(self.name, self.corners)

    @property
    def called(self) -> str:
        """Its name in a sentence: `the low table` for a kind of thing, `t1` and `Billy` for proper names.

        Lower-case words are taken for a kind of thing (our choice).
        """
        is_a_kind = re.fullmatch(r"(?!(?:the|an?) )[a-z]+(?:[ -][a-z]+)*", self.name) is not None
        return f"the {self.name}" if is_a_kind else self.name

    @classmethod
    def box(
        cls, name: str, x_m: float, y_m: float, *, width_m: float, depth_m: float, angle_rad: float = 0.0
    ) -> Furniture:
        """A rectangle by its centre: `width_m` along x and `depth_m` along y, turned by `angle_rad`."""
        require_text("furniture", "name", name)
        require_finite(name, x_m=x_m, y_m=y_m, angle_rad=angle_rad)
        require_between(name, "width_m", width_m, 0.01, 1000.0)
        require_between(name, "depth_m", depth_m, 0.01, 1000.0)
        c, s = math.cos(angle_rad), math.sin(angle_rad)
        half = [(sx * width_m / 2, sy * depth_m / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return cls(name, tuple((x_m + c * u - s * v, y_m + s * u + c * v) for u, v in half))

    @classmethod
    def circle(cls, name: str, x_m: float, y_m: float, *, radius_m: float) -> Furniture:
        """A disc given by its centre, as the circumscribed regular polygon of `CIRCLE_CORNERS` corners."""
        require_text("furniture", "name", name)
        require_finite(name, x_m=x_m, y_m=y_m)
        require_between(name, "radius_m", radius_m, 0.01, 500.0)
        reach, step = radius_m / math.cos(math.pi / CIRCLE_CORNERS), math.tau / CIRCLE_CORNERS
        angles = [k * step for k in range(CIRCLE_CORNERS)]
        return cls(name, tuple((x_m + reach * math.cos(a), y_m + reach * math.sin(a)) for a in angles))


def _require_corners(entity: str, corners: tuple[XY, ...], field: str = "corners") -> None:
    require_points(entity, field, corners)
    if len(set(corners)) < 3:
        raise SceneError(
            entity=entity,
            field=field,
            expected="at least three different corners" + (" of each hole" if field == "holes" else ""),
            got=f"{len(set(corners))}",
            remedy="List the corners in order along the outline.",
        )
