"""What the planner is asked: whom to visit, along which routes, and how culture weighs against distance."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from comity_fis.errors import InputError
from comity_fis.value import Inference

PARAMETERS = (
    "conversational_distance",
    "approach_direction",
    "approach_speed",
    "greeting_modality",
    "greeting_gesture",
)
"""What the two actions bind."""


@dataclass(frozen=True, slots=True)
class Visitee:
    """A person to visit, with their inferred parameters."""

    name: str
    values: Inference

    def __post_init__(self) -> None:
        missing = [name for name in PARAMETERS if name not in self.values.parameters]
        if missing:
            raise InputError(
                expected=f"a rulebook with all the parameters of a visit ({', '.join(PARAMETERS)})",
                got=f"{self.values.rulebook!r}, which has no {', '.join(missing)}",
                remedy="Plan with the rulebook bruno2017, or add the parameters to yours.",
            )


@dataclass(frozen=True, slots=True, order=True)
class Spot:
    """A place to stand: beside a person, on one of their sides."""

    place: str
    """The person's name."""
    side: str


START = Spot("start", "here")
"""Where the robot stands now. No person's side is called `here`, so a person may be called start."""

Travel = Mapping[tuple[Spot, Spot], float]
"""Route lengths in metres, from START or a spot to a spot; where there is no entry, there is no route."""


@dataclass(frozen=True, slots=True)
class Weights:
    """What disliked options are worth in metres of detour: metres per unit of -ln(desirability).

    At 1 m the robot goes 0.69 m further rather than choose an option half as desirable, and 4.6 m rather than
    one that is not desirable at all. A design choice, without a source: the project reports how stable plans
    are when the weights go from a quarter to four times.
    """

    side_m: float = 1.0
    greeting_m: float = 1.0

    def __post_init__(self) -> None:
        for name, weight in (("side_m", self.side_m), ("greeting_m", self.greeting_m)):
            if not 0.0 <= weight <= 100.0:
                raise ValueError(f"{name} must be between 0 and 100 metres, got {weight!r}")


@dataclass(frozen=True, slots=True)
class VisitRequest:
    """Visit and greet each of these people once, in any order."""

    robot: str
    visitees: tuple[Visitee, ...]
    travel: Travel
    weights: Weights = field(default_factory=Weights)

    def __post_init__(self) -> None:
        names = [visitee.name for visitee in self.visitees]
        if len(set(names)) < len(names):
            raise ValueError(f"every person is visited once, got {names!r}")
        for (start, end), length_m in self.travel.items():
            if not (math.isfinite(length_m) and length_m >= 0.0):
                raise ValueError(
                    f"a route has a finite length >= 0, got {length_m!r} m from {start} to {end}"
                )
