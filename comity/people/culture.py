"""The culture that a person declares: one, or several with weights, roles and dates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from typing import Annotated, Any

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    StringConstraints,
    model_serializer,
    model_validator,
)

from comity.people.dated import UNKNOWN, Day, require_some_time
from comity_fis import country
from comity_fis.validation.one_line import one_line

CultureName = Annotated[str, StringConstraints(min_length=1, max_length=100), AfterValidator(one_line)]
Weight = Annotated[float, Field(strict=True, gt=0, le=1000)]


class Culture(BaseModel):
    """One of the cultures of a person."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    name: CultureName = Field(
        description="A country by ISO 3166 code or English name, a region, or any words."
    )
    role: Annotated[str, AfterValidator(lambda role: role and one_line(role))] = Field(
        default="", max_length=100, description="For the reader: grew up, lives in, family."
    )
    weight: Weight = Field(default=1.0, description="Only proportions count.")
    region: CultureName | None = Field(
        default=None, description="The row of the table of scores that the person lets stand for it."
    )
    from_: Day | None = Field(default=None, alias="from", description="The first day on which it counts.")
    until: Day | None = Field(default=None, description="The first day on which it counts no more.")

    @model_validator(mode="before")
    @classmethod
    def _what_is_told(cls, written: Any) -> Any:
        """Drop unknown fields of a culture."""
        if not isinstance(written, Mapping):
            return written
        return {key: value for key, value in written.items() if value != UNKNOWN or key == "name"}

    @model_validator(mode="after")
    def _some_time(self) -> Culture:
        require_some_time(self.from_, self.until)
        return self

    @model_serializer
    def _as_written(self) -> dict[str, Any]:
        days = {"from": self.from_ and self.from_.isoformat(), "until": self.until and self.until.isoformat()}
        given = {"name": self.name, "role": self.role, "weight": self.weight, "region": self.region, **days}
        return {name: value for name, value in given.items() if value}

    def counts(self, day: date | None) -> bool:
        """Whether it applies to the person on a day."""
        if not self.dated:
            return True
        assert day is not None
        return not (self.from_ and day < self.from_) and not (self.until and day >= self.until)

    @property
    def dated(self) -> bool:
        """Whether it applies only on some days."""
        return self.from_ is not None or self.until is not None


Cultures = (
    CultureName
    | Annotated[Mapping[CultureName, Weight], Field(min_length=1)]
    | Annotated[tuple[Culture, ...], Field(min_length=1)]
)
"""`SWE`; `{Egypt: 1, SWE: 2}`; or a list of cultures."""


@dataclass(frozen=True, slots=True)
class Belonging:
    """A culture that applies on a given day."""

    words: str
    """Name of the culture in the person's words."""
    weight: float = 1.0
    role: str = ""
    region: str | None = None
    """Region that the person accepts as its substitute."""
    otherwise: str | None = None
    """Region that the person accepts if the culture has no score of its own."""
    location: tuple[str | int, ...] = ("culture",)
    """Location in the profile's file."""

    @property
    def disclosed(self) -> bool:
        """Whether the culture is known."""
        return self.words != UNKNOWN

    def label(self, region: str | None) -> str:
        """`Egypt, grew up, as Arab countries`."""
        known = country(self.words)
        as_ = f"as {region}" if region else ""
        return ", ".join(filter(None, (known.name if known else self.words, self.role, as_)))


def belongings(cultures: Cultures | None, region: str | None, day: date | None) -> Iterator[Belonging]:
    """The cultures that apply on a day.

    Args:
        cultures: The declared cultures.
        region: Substitute for those that have no score of their own.
        day: The day; required if a culture has dates.
    """
    if isinstance(cultures, str):
        yield Belonging(cultures, otherwise=region)
    elif isinstance(cultures, Mapping):
        for name, weight in cultures.items():
            yield Belonging(name, weight, otherwise=region, location=("culture", name))
    elif cultures is not None:
        for i, one in enumerate(cultures):
            if one.counts(day):
                at = ("culture", i, "name" if one.region is None else "region")
                yield Belonging(one.name, one.weight, one.role, one.region, region, at)
