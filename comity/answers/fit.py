"""What `comity fit` answers: terms made from data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class ClusterCount(Record):
    """How many clusters the data form."""

    radius: float
    """Of the subtractive clustering, as a fraction of the data's range."""
    clusters: int


@dataclass(frozen=True, slots=True, kw_only=True)
class FittedTermAnswer(Record):
    """A term that data made."""

    centre: float
    squared_error: float
    """Of the fit, summed over all values."""
    largest_error: float
    """Off the degrees of c-means anywhere in the data's range, also between the values."""
    form: Literal["free", "held"]
    """Free: the paper's fit to the values. Held: to one peak and heights of at most 1."""
    because: str | None
    """What is wrong with the free fit; null where nothing is."""
    two_term_gaussian: tuple[tuple[float, float, float], ...]
    """Height, centre, width."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FitAnswer(Record):
    """`comity fit --json`."""

    file: str
    column: str
    values: int
    empty: int
    """Cells that were skipped: empty, or NA."""
    low: float
    high: float
    radius: float
    clusters: tuple[ClusterCount, ...]
    radius_for_more: float | None
    """The largest smaller radius with several clusters."""
    terms: Mapping[str, FittedTermAnswer]
    """Empty where the data form one cluster."""
    variable: Mapping[str, object] | None
    """As a rulebook file holds it."""
    files: tuple[str, ...]
