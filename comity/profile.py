"""What one person declared about themselves: all of it optional, none of it inferred."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from comity import library
from comity_fis import Where
from comity_fis.yaml_file import YamlFile, read_yaml

Fact = Annotated[str, Field(min_length=1, max_length=200)] | float


class Profile(BaseModel):
    """One person's own words; a key that is left out was not disclosed."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity profile")

    schema_version: Literal[1] = 1
    name: str = Field(min_length=1, max_length=100)
    about: str = Field(default="", description="A sentence for whoever reads a list of profiles.")
    culture: str | None = Field(
        default=None,
        description="Self-declared: an ISO 3166 code such as DEU, or a region such as 'Arab countries'.",
    )
    gender: str | None = Field(default=None, description="Self-declared; a rulebook may know only some.")
    age: float | None = Field(default=None, ge=0, le=117, description="Years.")
    education: int | None = Field(
        default=None, ge=0, le=8, description="Highest level completed, as ISCED 2011 numbers them."
    )
    latitude: float | None = Field(
        default=None, ge=-90, le=90, description="Of where the person grew up [deg], north positive."
    )
    touch_consent: Literal["given", "withheld"] | None = Field(
        default=None, description="Whether greetings that touch are welcome; never presumed."
    )
    robot_experience: str | None = Field(default=None, description="low or high.")
    formality: str | None = Field(
        default=None, description="informal or formal: how this person wants to be met."
    )
    other: Mapping[str, Fact] = Field(
        default_factory=dict, description="Further facts, by the name of a rulebook's variable."
    )
    settings: Mapping[str, Fact] = Field(
        default_factory=dict,
        description="What the person explicitly asked for, by parameter; replaces inference.",
    )

    def facts(self) -> dict[str, str | float]:
        """Everything disclosed, by name."""
        named = self.model_dump(
            exclude={"schema_version", "name", "about", "other", "settings"}, exclude_none=True
        )
        return {**named, **self.other}


@dataclass(frozen=True, slots=True)
class Declared:
    """A profile and the file, or the part of one, that it came from, so that complaints name a line."""

    profile: Profile
    file: YamlFile | None
    """None where nothing was written down: nobody in particular."""


NOBODY = Declared(Profile(name="nobody in particular"), None)


def load_profile(name: str, *, beside: Path | None = None, where: Where | None = None) -> Declared:
    """A shipped profile by name, or one from a file.

    Args:
        name: A shipped name or a path.
        beside: The folder that a relative path starts from; the current one when None.
        where: Where the name was written, for the message.

    Raises:
        InputError: if there is none, or the file does not hold a profile.
    """
    path, called = library.find("profile", name, beside=beside, where=where)
    file = read_yaml(path, called)
    return Declared(file.check(Profile), file)
