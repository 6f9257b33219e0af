"""Summary of a test run: as JSON, and as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from comity.report.text import console, show, table, unbroken
from comity.testing.reporting.answers import TestAnswer, TestsAnswer
from comity.testing.reporting.broken import OVERVIEW, broken, broken_table
from comity.testing.reporting.contrasts import contrasts
from comity.testing.reporting.fairness import Reach, differences, reach, spread, thresholds, too_small
from comity.testing.reporting.summary import others, served, served_table, shared
from comity.testing.runner.telling import wraps
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.testing.runner.result import Result


FEW = 3
"""Maximum number of profiles named; more are counted."""


def answer(
    results: Sequence[Result], seconds: float, *, not_run: int | None = 0, fairness: bool
) -> TestsAnswer:
    """The answer of `comity test --json`."""
    counts = Counter(result.status for result in results)
    compared = shared(results)
    found, about = (differences(results), reach(results)) if fairness else ((), None)
    return TestsAnswer(
        passed=counts["passed"],
        failed=counts["failed"],
        xfailed=counts["xfailed"],
        xpassed=counts["xpassed"],
        refused=counts["refused"],
        not_run=not_run,
        seconds=round(seconds, 2),
        tests=tuple(map(_test, results)),
        broken=broken(results),
        profiles=served(results),
        shared_cases=compared.cases,
        other_cases=compared.left_out,
        other_profiles=others(results),
        unexplained=tuple(one for one in found if not one.settings) if fairness else None,
        not_compared=about.alone + about.unmeasured if about else None,
        asked_for=tuple(one for one in found if one.settings) if fairness else None,
    )


def _test(result: Result) -> TestAnswer:
    one = result.measured
    return TestAnswer(
        id=result.id,
        file=str(result.path),
        status=result.status,
        profile=result.profile,
        seed=one.seed if one else None,
        outcome=one.outcome if one else None,
        simulated_s=one.time_s if one else None,
        distances_m=one.distances_m if one else {},
        text=result.text,
        picture=str(result.picture) if result.picture else None,
        again=result.again,
    )


def summary(results: Sequence[Result], told: TestsAnswer) -> None:
    """Print failures, their overview, how each profile was served, and the counts."""
    bad = (result for result in results if not result.good)
    for text, alike in groupby(bad, key=lambda result: result.text):  # e.g. one error of a shared rulebook
        heads = (unbroken(f"{result.status.upper()} {result.id}") for result in alike)
        show(*heads, *_paragraphs(text), "")
    if told.failed > OVERVIEW:
        show("What does not hold, and for whom", broken_table(told.broken, results))
    if len(told.profiles) > 1:
        show("How each profile was served", served_table(told.profiles), *_beside(told))
    if told.unexplained is not None:
        show("Fairness", *_fairness(results, told))
    counts = [
        f"{getattr(told, status)} {status.replace('_', ' ')}"
        for status in ("passed", "failed", "refused", "xpassed", "xfailed", "not_run")
        if getattr(told, status) or status == "passed"
    ]
    show(f"{counted(len(told.tests), 'test')}: {', '.join(counts)} in {told.seconds:.1f} s")


def _paragraphs(text: str) -> Iterator[RenderableType]:
    """Paragraphs to be wrapped and lines to be kept, grouped as in the text."""
    from rich.cells import cell_len

    width = console().width
    for breaks, lines in groupby(text.splitlines(), key=lambda line: wraps(line) and cell_len(line) > width):
        together = "\n".join(lines)
        yield together if breaks else unbroken(together)


def _beside(told: TestsAnswer) -> Iterator[str]:
    """Notes on the table: the cases that its means cover, and the profiles that it omits."""
    if told.other_cases:
        rest = "1 other is" if told.other_cases == 1 else f"{told.other_cases} others are"
        over = counted(told.shared_cases, "case")
        yield f"  Means over the {over} that all of these have in common; {rest} left out."
    if told.other_profiles:
        tests = counted(sum(one.tests for one in told.other_profiles), "test")
        failed = sum(one.failed for one in told.other_profiles)
        names = ", ".join(one.profile for one in told.other_profiles)
        who = names if len(told.other_profiles) <= FEW else f"{len(told.other_profiles)} other profiles"
        yield f"  Not in the table: {who} ({tests}, {failed} failed)."
    if told.other_cases or told.other_profiles:
        yield ""


def _fairness(results: Sequence[Result], told: TestsAnswer) -> Iterator[RenderableType]:
    about = reach(results)
    yield from _left_out(about)
    if not about.compared:
        return
    rows = [
        (aspect, f"{apart:.2f}", f"most {most}, least {least}")
        for aspect, (most, least, apart) in spread(results).items()
        if round(apart, 2)
    ]
    if rows:
        yield table(rows, head=("on average", "apart", ""))
    small = too_small(results)
    if small:
        yield f"  Too small to be told: {thresholds(small)}."
    if told.unexplained:
        yield "No parameter explains\n"
        yield from contrasts(told.unexplained)
    else:
        which = "Every other" if told.asked_for or small else "Every"
        yield f"  {which} difference depends on a parameter that differs, and is in proportion to it."
    if told.asked_for:
        yield "Somebody asked for\n"
        yield from contrasts(told.asked_for)


def _left_out(about: Reach) -> Iterator[str]:
    """Notes on what the comparison does not cover."""
    if not about.compared:
        only = f"one profile, {about.profiles[0]}," if len(about.profiles) == 1 else "what was measured"
        yield f"  Nothing is compared: {only} cannot be, without another one in the same case."
    if about.apart:
        one, other = about.apart[0]
        pairs = counted(len(about.apart), "pair")
        such = ":" if len(about.apart) == 1 else ", such as"
        yield f"  Not compared: {pairs} of profiles that share no case{such} {one} and {other}."
    if about.compared and about.alone:
        yield f"  Left out: {counted(about.alone, 'test')} in whose case no other profile was measured."
    if about.unmeasured:
        were = "was" if about.unmeasured == 1 else "were"
        yield f"  Left out: {counted(about.unmeasured, 'test')} that {were} refused or without a plan."
