"""What `comity fit` answers: terms made from data."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer


class ClusterCount(Answer):
    """How many clusters the data form."""

    radius: float = Field(description="Of the subtractive clustering, as a fraction of the data's range.")
    clusters: int


class FittedTermAnswer(Answer):
    """A term that data made."""

    centre: float
    squared_error: float = Field(description="Of the fit, summed over all values.")
    largest_error: float = Field(
        description="Off the degrees of c-means anywhere in the data's range, also between the values."
    )
    form: Literal["free", "held"] = Field(
        description="Free: the paper's fit to the values. Held: to one peak and heights of at most 1."
    )
    because: str | None = Field(description="What is wrong with the free fit; null where nothing is.")
    two_term_gaussian: tuple[tuple[float, float, float], ...] = Field(description="Height, centre, width.")


class FitAnswer(Answer):
    """`comity fit --json`."""

    file: str
    column: str
    values: int
    empty: int = Field(description="Cells that were skipped: empty, or NA.")
    low: float
    high: float
    radius: float
    clusters: tuple[ClusterCount, ...]
    radius_for_more: float | None = Field(description="The largest smaller radius with several clusters.")
    terms: Mapping[str, FittedTermAnswer] = Field(description="Empty where the data form one cluster.")
    variable: Mapping[str, object] | None = Field(description="As a rulebook file holds it.")
    files: tuple[str, ...]
