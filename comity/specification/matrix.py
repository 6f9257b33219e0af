"""Test matrix of a scenario, and markers of its tests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints

from comity_fis.validation.one_line import one_line

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

Word = Annotated[str, StringConstraints(min_length=1, max_length=200), AfterValidator(one_line)]
Seed = Annotated[int, Field(strict=True, ge=0, le=2**32 - 1)]

PAPER = ("arab_woman", "german_woman", "arab_man", "german_man")
"""The four people of Bruno et al. (2017)."""


class Matrix(BaseModel):
    """What a scenario is tested with: every combination is a case of its own."""

    model_config = _FILE

    people: tuple[Word, ...] = Field(
        default=(),
        min_length=1,
        description="Who has the profiles of the cases; without it whom the first goal greets.",
    )
    profiles: Annotated[tuple[Word, ...], Field(min_length=1)] | Literal["all", "paper"] = Field(
        default=(),
        description="Shipped or stored names, or files; `all` is all that ship, `paper` the paper's four. "
        "Without it everybody is as written.",
    )
    seeds: tuple[Seed, ...] = Field(default=(0,), min_length=1, description="Of the sensors' noise.")
    rulebooks: tuple[Word, ...] = Field(
        default=(), min_length=1, description="Instead of the scenario's own."
    )
    worlds: Mapping[Word, Mapping[str, Any]] = Field(
        default_factory=dict,
        min_length=1,
        description="By a name, what is otherwise in each world: parts of the scenario, such as "
        "`{place: {noise_db: 80}}`. What is not named stays as it is written.",
    )


class Markers(BaseModel):
    """How the tests of a scenario are marked."""

    model_config = _FILE

    slow: bool = Field(
        default=False, strict=True, description='Left out by `-m "not slow"` and by `comity test --fast`.'
    )
    xfail: Word | None = Field(
        default=None, description="Why the test must fail for now; it is reported when it passes."
    )
