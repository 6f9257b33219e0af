"""The model of a map file; `comity schema map` prints its JSON schema."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints, model_validator

from comity_fis.errors import WrongValueError
from comity_fis.listing import listed
from comity_fis.validation.one_line import one_line
from comity_sim2d.scene.scene_check import MAX_OBSTACLES
from comity_sim2d.scene_error import FARTHEST_M

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

MAX_ROOMS, MAX_DOORS, MAX_LOCATIONS = 200, 400, 1000
"""Maximum numbers (our choice: a hospital floor has fewer of each)."""
MAX_CORNERS = 25_000
"""Maximum number of corners of rooms, holes and furniture together: a thousand circles (our choice; routes
then take seconds)."""
MAX_HOLES = MAX_CORNERS // 3


Number = Annotated[float, Field(strict=True)]
"""A number; strings and booleans are rejected."""
Name = Annotated[str, StringConstraints(min_length=1, max_length=100), AfterValidator(one_line)]
Metres = Annotated[Number, Field(ge=-FARTHEST_M, le=FARTHEST_M)]
Degrees = Annotated[Number, Field(ge=-360, le=360)]
Point = tuple[Metres, Metres]
WallLine = tuple[Point, Point]


class Outline(BaseModel):
    """A shape on the floor: a box or a polygon."""

    model_config = _FILE

    box_m: tuple[Metres, Metres, Metres, Metres] | None = Field(
        default=None, description="x and y of the lower left corner, width, height."
    )
    polygon_m: tuple[Point, ...] | None = Field(
        default=None, min_length=3, max_length=MAX_CORNERS, description="Corners in order, at least three."
    )

    @model_validator(mode="after")
    def _one_shape(self) -> Outline:
        given = [shape for shape in self._shapes() if getattr(self, shape) is not None]
        if len(given) != 1:
            raise WrongValueError(
                expected=f"one of {', '.join(f'`{shape}`' for shape in self._shapes())}",
                got=listed(f"`{shape}`" for shape in given) or "none of them",
                remedy="Remove all but one." if given else "Add `box_m: [x, y, width, height]`.",
            )
        if self.box_m is not None and min(self.box_m[2:]) <= 0:
            raise WrongValueError(
                expected="box_m with a width and a height above 0",
                got=list(self.box_m),
                remedy="Write it as x and y of the lower left corner, width, height.",
            )
        return self

    @classmethod
    def _shapes(cls) -> tuple[str, ...]:
        return ("box_m", "polygon_m")


class FurniturePiece(Outline):
    """Something that stands in the way."""

    name: Name
    circle_m: tuple[Metres, Metres, Annotated[Number, Field(gt=0, le=500)]] | None = Field(
        default=None, description="x and y of the middle, radius."
    )
    angle_deg: Degrees = Field(
        default=0.0, description="Turns a box about its middle, counter-clockwise; it is written unturned."
    )

    @model_validator(mode="after")
    def _turns_a_box(self) -> FurniturePiece:
        if self.angle_deg and self.box_m is None:
            raise WrongValueError(
                expected="angle_deg beside box_m",
                got=f"angle_deg {self.angle_deg:g} without a box",
                remedy="Remove it, or write the shape as `box_m`.",
            )
        return self

    @classmethod
    def _shapes(cls) -> tuple[str, ...]:
        return ("box_m", "polygon_m", "circle_m")


class InnerWall(BaseModel):
    """A wall inside a room; between two rooms that touch there is one already."""

    model_config = _FILE

    line_m: WallLine = Field(description="From a point to a point.")
    thickness_m: Number = Field(default=0.10, ge=0.01, le=2)
    name: Name | None = None


class DoorInWall(BaseModel):
    """A gap in an inner wall that can be shut."""

    model_config = _FILE

    at_m: Point = Field(description="Its middle, on the wall.")
    width_m: Number = Field(ge=0.01, le=50, description="Clear width.")
    open: bool = Field(default=True, strict=True, description="At the start.")
    kind: Literal["hinged", "sliding", "opening"] = Field(
        default="hinged", description="An opening has no leaf and cannot be shut."
    )

    @model_validator(mode="after")
    def _no_shut_opening(self) -> DoorInWall:
        if self.kind == "opening" and not self.open:
            raise WrongValueError(
                expected="an opening that is open: it has no leaf",
                got="open: false",
                remedy="Remove `open: false`, or make it `kind: sliding`.",
            )
        return self


class NamedPoint(BaseModel):
    """A place with a name, where a person can stand."""

    model_config = _FILE

    at_m: Point
    facing_deg: Degrees | None = Field(
        default=None, description="Counter-clockwise from the x axis; without it no matter."
    )


class MapFile(BaseModel):
    """Rooms, walls, doors, furniture and named places; lengths in metres, x to the right, y up."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity map")

    schema_version: Literal[1]
    name: Name
    about: str = ""
    rooms: Mapping[Name, Outline] = Field(
        min_length=1,
        max_length=MAX_ROOMS,
        description="Together they are the floor. Where two touch a wall stands between them; where two "
        "overlap they are one space.",
    )
    holes_m: tuple[Annotated[tuple[Point, ...], Field(min_length=3)], ...] = Field(
        default=(),
        max_length=MAX_HOLES,
        description="Corners of what is no floor in the rooms, such as a courtyard: its outline is a wall.",
    )
    walls: tuple[InnerWall, ...] = Field(default=(), max_length=MAX_OBSTACLES)
    doors: Mapping[Name, DoorInWall] = Field(default_factory=dict, max_length=MAX_DOORS)
    furniture: tuple[FurniturePiece, ...] = Field(default=(), max_length=MAX_OBSTACLES)
    locations: Mapping[Name, NamedPoint] = Field(default_factory=dict, max_length=MAX_LOCATIONS)
