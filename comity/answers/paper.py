"""What `comity paper` answers: the paper's numbers beside ours."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import Field

from comity.answers.base import Answer
from comity_fis import Mode


class ComputedDistanceAnswer(Answer):
    """One distance as one mode computes it."""

    distance_cm: float
    difference_cm: float = Field(description="From the paper's number: above 0 where ours is larger.")


class PrintedDistanceAnswer(Answer):
    """One distance that the paper prints, and the same from this package in every mode."""

    case: int = Field(description="1: individualism alone. 2: individualism and gender.")
    individualism: float
    gender: str | None = Field(description="Null in case 1.")
    paper_cm: float
    modes: Mapping[Mode, ComputedDistanceAnswer]


class PaperAnswer(Answer):
    """`comity paper --json`."""

    numbers: tuple[PrintedDistanceAnswer, ...] = Field(description="The six that the paper prints.")
    largest_difference_cm: Mapping[Mode, float] = Field(description="From any of the six, without its sign.")
    case_1_with_the_shapes_of_case_2: tuple[PrintedDistanceAnswer, ...] = Field(
        description="Case 1 with the close and far of case 2: the two cases use two sets of output shapes."
    )
