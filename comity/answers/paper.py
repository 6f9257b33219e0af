"""What `comity paper` answers: the paper's numbers beside ours."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis import Mode
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class ComputedDistanceAnswer(Record):
    """One distance as one mode computes it."""

    distance_cm: float
    difference_cm: float
    """From the paper's number: above 0 where ours is larger."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PrintedDistanceAnswer(Record):
    """One distance that the paper prints, and the same from this package in every mode."""

    case: int
    """1: individualism alone. 2: individualism and gender."""
    individualism: float
    gender: str | None
    """Null in case 1."""
    paper_cm: float
    modes: Mapping[Mode, ComputedDistanceAnswer]


@dataclass(frozen=True, slots=True, kw_only=True)
class PaperAnswer(Record):
    """`comity paper --json`."""

    numbers: tuple[PrintedDistanceAnswer, ...]
    """The six that the paper prints."""
    largest_difference_cm: Mapping[Mode, float]
    """From any of the six, without its sign."""
    case_1_with_the_shapes_of_case_2: tuple[PrintedDistanceAnswer, ...]
    """Case 1 with the close and far of case 2: the two cases use two sets of output shapes."""
