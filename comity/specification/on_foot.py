"""Moving people in a scenario: walks, and passers-by."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from comity.people.fact import Number
from comity_sim2d import SPEED_M_S, RobotReaction
from comity_sim2d.maps.file import Point

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

Seconds = Annotated[Number, Field(ge=0, le=36_000)]


class Walks(BaseModel):
    """A way that a person walks, around walls and furniture."""

    model_config = _FILE

    route: tuple[Point, ...] = Field(
        min_length=1, max_length=200, description="The points to go to, in order."
    )
    loop: bool = Field(default=False, description="Whether the first point follows the last.")
    speed_m_s: Annotated[Number, Field(ge=0.1, le=3)] = Field(
        default=SPEED_M_S, description="In the open; Moussaid et al. 2009 measured 1.29 m/s."
    )
    pause_s: Seconds | tuple[Seconds, ...] = Field(
        default=0.0, description="How long they stand at every point, or a number for each."
    )
    stops: bool = Field(
        default=False, description="Whether they stop for a robot that comes up to them, and look at it."
    )
    accompanied: bool = Field(
        default=False,
        description="Whether they agreed that the robot goes along with them, up to 0.5 m/s.",
    )


class PassersBySpec(BaseModel):
    """People who walk about, put there by the seed: in frames and metrics, and in no plan."""

    model_config = _FILE

    count: Annotated[int, Field(strict=True, ge=0, le=1000)]
    between: tuple[Point, ...] = Field(
        default=(), max_length=100, description="Points that they walk between; without any, anywhere."
    )
    speed_m_s: Annotated[Number, Field(ge=0.6, le=2)] = Field(
        default=SPEED_M_S, description="The mean; people differ by 0.19 m/s (Moussaid et al. 2009)."
    )
    reacts: RobotReaction = Field(default="regular", description="What they do about the robot.")
