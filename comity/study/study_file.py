"""The study file: scenarios, factors, individuals, seeds and the design that combines them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from comity.people.dated import Day
from comity.people.fact import Number
from comity.sharing.extra import Extra
from comity.specification.matrix import Seed, Word
from comity_fis.errors import WrongValueError
from comity_sim2d.maps.file import Name

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
VISITED = "visited"
"""Default role of the person whom the first goal of a scenario names, unless `roles` overrides it."""

StudyDesign = Literal["full", "list", "in step", "latin hypercube"]


class ValueRange(BaseModel):
    """Numbers between two ends, which a Latin hypercube fills."""

    model_config = _FILE

    from_: Number = Field(alias="from")
    to: Number
    whole: bool = Field(default=False, strict=True, description="Whether only whole numbers are meant.")

    @model_validator(mode="after")
    def _upwards(self) -> ValueRange:
        if self.from_ >= self.to:
            raise WrongValueError(
                expected="`from` below `to`", got=f"{self.from_:g} and {self.to:g}", remedy="Swap them."
            )
        return self


Levels = Annotated[tuple[Any, ...], Field(min_length=1, max_length=10_000)]


class StudyFile(BaseModel):
    """Which episodes a study has; `comity schema study` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity study")

    schema_version: Literal[1]
    name: Name
    about: str = ""
    scenarios: tuple[Name, ...] = Field(
        min_length=1, max_length=1000, description="Shipped scenarios, or files beside this one."
    )
    roles: Mapping[Name, Name | Mapping[Name, Name]] = Field(
        default_factory=dict,
        description="A person of each scenario by a name that all share: one name, or one by scenario. "
        "`visited` is whom the first goal names, unless it stands here.",
    )
    population: Name | None = Field(
        default=None, description="A file of individuals; each of them meets every condition."
    )
    individuals_are: Name = Field(default=VISITED, description="The role that the individuals take.")
    assume: Literal["rulebook"] | None = Field(
        default=None,
        description="State that comfort is drawn from a rulebook that the study runs with: the study then "
        "cannot say whether that rulebook serves people well.",
    )
    factors: Mapping[Word, Levels | ValueRange] = Field(
        default_factory=dict,
        max_length=100,
        description="What differs between conditions, by the path of a key in the scenario, such as "
        "`rulebook`, `robot.sensor.noise_m` or `people.visited.profile`: a list of values, or a range.",
    )
    design: StudyDesign = Field(
        default="full",
        description="How factors are combined: every combination; the `conditions` as listed; the first "
        "values of all factors, then the second, and so on; ranges filled evenly, lists in full.",
    )
    in_step: tuple[tuple[Word, ...], ...] = Field(
        default=(), description="Factors of a full design that change together, group by group."
    )
    conditions: tuple[Mapping[Word, Any], ...] = Field(
        default=(), max_length=100_000, description="Of the design `list`: values by path, one a condition."
    )
    samples: Annotated[int, Field(strict=True, ge=1, le=100_000)] | None = Field(
        default=None, description="Points of a Latin hypercube."
    )
    design_seed: Seed = Field(default=0, description="Of the Latin hypercube.")
    seeds: (
        Annotated[int, Field(strict=True, ge=1, le=100_000)]
        | Annotated[tuple[Seed, ...], Field(min_length=1, max_length=100_000)]
    ) = Field(default=(0,), description="Of the episodes: how many, counted from 0, or a list.")
    at: Day | None = Field(default=None, description="The day on which dated facts are taken.")
    tell: tuple[Extra, ...] = Field(
        default=(),
        description="Of individuals from a table also their culture or gender. Only where they agreed.",
    )

    @property
    def every_seed(self) -> tuple[int, ...]:
        """All seeds in order."""
        return tuple(range(self.seeds)) if isinstance(self.seeds, int) else self.seeds
