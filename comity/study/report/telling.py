"""Results of a study as text for a terminal."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from typing import TYPE_CHECKING

from comity.report.text import table, unbroken, words
from comity.study.report.outcomes import label_of
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.answers.study_report import (
        EstimateAnswer,
        ServedWorseAnswer,
        StudyCompareAnswer,
        StudyDifferenceAnswer,
        StudyReportAnswer,
        StudyShowAnswer,
    )

DECIMALS = 4
"""Decimals of numbers in text: a tenth of a millimetre is finer than any simulated quantity."""
SMALLEST = 10.0**-DECIMALS
FEW = 10
"""Below this number of units, a percentile interval is noticeably too narrow."""
HEAD = ("outcome", "group", "first", "second", "difference", "95 % interval", "Monte Carlo error", "pairs")


def report_text(answer: StudyReportAnswer) -> Iterator[RenderableType]:
    """Summary of a study's report."""
    counts = f"{answer.visits} visits, {answer.failures} failures, {answer.outliers} outliers"
    yield f"Study {answer.study}: {counts}"
    for one in answer.served_worse:
        if one.told_apart:
            yield f"  {worse_text(one)}"
    if few := few_of(one.estimate for one in answer.levels if one.estimate):
        yield f"  {few_text(few)}"
    yield unbroken(f"Page  {answer.page}")
    yield f"  {answer.statement}"


def few_of(estimates: Iterable[EstimateAnswer]) -> dict[str, int]:
    """Units that are too few for intervals, with their number: `{"individuals": 2, "seeds": 3}`.

    For individuals, the smallest level counts, such as a group; a single room or seed is treated as fixed.
    """
    counts = [(one.individuals, one.rooms, one.seeds) for one in estimates] or [(1, 1, 1)]
    people, rooms, seeds = zip(*counts, strict=True)
    smallest = {"individuals": min(people), "rooms": max(rooms), "seeds": max(seeds)}
    there = {"individuals": max(people) > 1, "rooms": max(rooms) > 1, "seeds": max(seeds) > 1}
    return {name: count for name, count in smallest.items() if there[name] and count < FEW}


def few_text(few: Mapping[str, int]) -> str:
    """`Few to resample (2 individuals, 3 seeds): ...`."""
    counts = ", ".join(counted(count, name.removesuffix("s")) for name, count in few.items())
    return f"Few to resample ({counts}): with fewer than {FEW} of one, intervals tend to be too narrow."


def worse_text(one: ServedWorseAnswer) -> str:
    """`german_women by conversational distance under evidence: 0.309 m (best: egyptian_men, 0.011 m)`."""
    worst, best = (value_text(value, one.unit) for value in (one.worst_missed, one.best_missed))
    return f"{one.worst} by {words(one.parameter)} under {one.rulebook}: {worst} (best: {one.best}, {best})"


def compare_text(answer: StudyCompareAnswer) -> Iterator[RenderableType]:
    """Two levels side by side."""
    yield f"Study {answer.study}, {answer.factor}: {answer.first} and {answer.second}, {answer.pairs} pairs"
    head = ("group", answer.first, answer.second, "difference", "95 % interval", "seeds")
    for (outcome, unit), found in groupby(answer.differences, key=lambda one: (one.outcome, one.unit)):
        yield ""
        yield f"  {label_of(outcome, unit)}"
        yield table([difference_cells(one)[1 : 1 + len(head)] for one in found], head=head)
    yield ""
    yield (
        "  Second minus first, within the same individual, room and seed. Intervals resample individuals, "
        "rooms and seeds; `seeds` is the Monte Carlo error, which seeds alone leave."
    )
    if few := few_of(one.difference for one in answer.differences):
        yield f"  {few_text(few)}"
    yield f"  {answer.statement}"


def difference_cells(one: StudyDifferenceAnswer) -> tuple[str, ...]:
    """A difference as cells of `HEAD`."""
    return (
        label_of(one.outcome, one.unit),
        one.group or "all",
        number_text(one.first),
        number_text(one.second),
        number_text(one.difference.mean, signed=True),
        interval_text(one.difference),
        number_text(one.difference.monte_carlo_error),
        str(one.difference.episodes),
    )


def show_text(answer: StudyShowAnswer) -> Iterator[RenderableType]:
    """Result of a replayed episode."""
    same = "the same digest" if answer.same else "another digest than in the table"
    yield f"Row {answer.row}: {answer.outcome}, {same}"
    if answer.differs:
        yield f"  Not as it was: {answer.differs}"
    yield unbroken(f"Page  {answer.page}")
    yield f"  {answer.statement}"


def interval_text(found: EstimateAnswer) -> str:
    """Interval as text: `0.12 to 0.49`, or a dash if there is nothing to resample."""
    if found.low is None or found.high is None:
        return "-"
    return f"{number_text(found.low)} to {number_text(found.high)}"


def value_text(value: float, unit: str) -> str:
    """Value with its unit: `0.309 m`; a share has none."""
    return number_text(value) if unit in ("1", "") else f"{number_text(value)} {unit}"


def number_text(value: float | None, *, signed: bool = False) -> str:
    """Three significant digits, at most four decimals: `0.309`, `11.4`, `0.0001`, `0`; a dash for None."""
    if value is None:
        return "-"
    if abs(value) < SMALLEST / 2:
        return "0"
    decimals = min(max(2 - math.floor(math.log10(abs(value))), 0), DECIMALS)
    digits = f"{value:{'+' if signed else ''}.{decimals}f}"
    return digits.rstrip("0").rstrip(".") if "." in digits else digits
