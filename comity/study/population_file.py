"""The population file: individuals drawn with a seed, or taken from a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from comity.people.fact import Fact, Number
from comity.scenario import ComfortSpec
from comity.specification.matrix import Seed, Word
from comity_fis.errors import WrongValueError
from comity_sim2d.maps.file import Name

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)
MOST = 100_000
"""Maximum number of individuals of one population."""


class UniformFact(BaseModel):
    """A number drawn evenly between two ends."""

    model_config = _FILE

    from_: Number = Field(alias="from")
    to: Number


class ChosenFact(BaseModel):
    """A value drawn evenly from a list."""

    model_config = _FILE

    any_of: tuple[Fact, ...] = Field(min_length=1, max_length=1000)


class DrawnComfort(BaseModel):
    """The distribution of the distances at which the individuals of a group are at ease."""

    model_config = _FILE

    middle_m: Annotated[Number, Field(ge=0, le=10)] | None = Field(
        default=None, description="Mean of the middles of the comfort intervals, between surfaces."
    )
    sd_m: Annotated[Number, Field(ge=0, le=3)] | None = Field(
        default=None, description="Standard deviation of the middles between individuals."
    )
    rulebook: Name | None = Field(
        default=None,
        description="Instead of middle_m and sd_m: the distance and the spread that this rulebook gives for "
        "the individual's facts. A study that runs with the same rulebook needs `assume: rulebook`.",
    )
    half_width_m: Number = Field(
        default=0.2, ge=0.025, le=3, description="Half of the width of every comfort interval."
    )
    chance: Number = Field(default=1.0, ge=0, le=1, description="Of showing a discomfort at all.")
    source: Word = Field(description="Where the numbers come from, or `design choice`.")

    @model_validator(mode="after")
    def _one_origin(self) -> DrawnComfort:
        numbers = (self.middle_m is not None, self.sd_m is not None)
        if self.rulebook is None and all(numbers):
            return self
        if self.rulebook is not None and not any(numbers):
            return self
        raise WrongValueError(
            expected="`middle_m` and `sd_m`, or `rulebook`",
            got="both" if self.rulebook else "neither of them complete",
            remedy="Write for example `comfort: {middle_m: 0.8, sd_m: 0.25, source: design choice}`.",
        )


class DrawnGroup(BaseModel):
    """Individuals with something in common."""

    model_config = _FILE

    individuals: Annotated[int, Field(strict=True, ge=1, le=MOST)]
    facts: Mapping[Word, UniformFact | ChosenFact | Fact] = Field(
        default_factory=dict, description="By the keys of a profile; a value, or how it is drawn."
    )
    comfort: DrawnComfort | None = Field(default=None, description="Without it they do not react.")


class Wishes(BaseModel):
    """The share of individuals who ask for the distance that they like; a wish goes before culture."""

    model_config = _FILE

    share: Number = Field(ge=0, le=1)


class PopulationFile(BaseModel):
    """The individuals of a study; `comity schema population` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity population")

    schema_version: Literal[1]
    name: Name
    about: str = ""
    seed: Seed = Field(default=0, description="Of everything that is drawn for the individuals.")
    groups: Mapping[Name, DrawnGroup] = Field(default_factory=dict, max_length=1000)
    table: Name | None = Field(
        default=None,
        description="Instead of groups: a CSV file of individuals, one a row, beside this file.",
    )
    comfort: ComfortSpec | None = Field(
        default=None, description="With a table: of the individuals whose row states none."
    )
    wishes: Wishes | Literal["stated"] | None = Field(
        default=None,
        description="Without it no individual wishes anything; `stated`: those of the table's column wish_m.",
    )

    @model_validator(mode="after")
    def _one_origin(self) -> PopulationFile:
        if bool(self.groups) == (self.table is not None):
            raise WrongValueError(
                expected="either `groups` or `table`",
                got="both" if self.groups else "neither",
                remedy="Draw the individuals of groups, or name a CSV file of them.",
            )
        for given, key, needs in (
            (self.groups and self.comfort, "comfort", "table"),
            (self.groups and self.wishes == "stated", "wishes: stated", "table"),
        ):
            if given:
                raise WrongValueError(
                    expected=f"`{key}` beside `{needs}`",
                    got="it beside `groups`",
                    remedy="Write it into the groups, or state a share of wishes.",
                )
        return self
