"""Failures as readable text."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from textwrap import wrap
from typing import TYPE_CHECKING

from comity.testing.amounts.shaping import HEAD
from comity.testing.collection.cases import ships, shown
from comity.testing.runner.citing import cited
from comity.testing.runner.evidence import NONE
from comity.testing.trials.day import day_taken
from comity_domain import ENGINE
from comity_fis.listing import listed

if TYPE_CHECKING:
    from pathlib import Path

    from comity.testing.collection.cases import Claim
    from comity.testing.runner.evidence import Evidence
    from comity.testing.verdict import Failure

WIDTH = 100
_INDENT = " " * 13
_SENTENCES = tuple(f"  {head:9}  " for head in ("expected", "got", "because", "also", ""))
"""Prefixes of lines of sentences."""


def failure_text(claim: Claim, failures: Iterable[Failure], evidence: Evidence = NONE) -> str:
    """Every failure with its position, and how to reproduce it.

    Args:
        claim: The failed test.
        failures: Failed expectations.
        evidence: The picture of the episode.
    """
    told: dict[tuple[str, ...], Failure] = {}
    failures = tuple(failures)
    alike = groupby(failures, key=lambda failure: tuple(failure.finding.because))
    lines = [line for because, group in alike for line in _lines(because, list(group), told)]
    if rules := cited(claim.case, (line for failure in failures for line in failure.finding.because)):
        lines += _folded("rules", rules)
    if ships(claim.path):
        lines.append(f"  file       {claim.path}")
    if day := day_taken(claim.case):
        lines.append(f"  day        {day}")
    if str(evidence):
        lines.append(f"  picture    {evidence}")
    lines.append(f"  again      {again(claim)}")
    return "\n".join(lines)


def wraps(line: str) -> bool:
    """Whether a line may be wrapped: sentences may; places, paths and commands, which are copied, may not."""
    return line.startswith(_SENTENCES)


def left_over_text(path: Path) -> str:
    """Message that a golden episode, or a file in place of its folder, belongs to no case."""
    expected = "a golden episode of a case" if path.suffix == ".json" else "a folder of golden episodes"
    return (
        f"{shown(path)}: expected {expected}, got one that no case is compared with. Call the "
        f"profile, world or seed as before, or remove it and run `comity test --update`."
    )


def again(claim: Claim) -> str:
    """The command that runs only this test."""
    return command(claim.path, claim.id, claim.others, engine=claim.case.engine)


def command(
    path: Path, test: str | None = None, profiles: Iterable[str] = (), *, engine: str = ENGINE
) -> str:
    """The shell command that runs a file's tests, or one of them."""
    name = shown(path)
    name = f"./{name}" if name.startswith("-") else name  # otherwise it would be an option
    others = (word for profile in profiles for word in ("--profile", profile))
    planner = () if engine == ENGINE else ("--engine", engine)
    return shlex.join(["comity", "test", f"{name}::{test}" if test else name, *others, *planner])


def _lines(
    because: tuple[str, ...], failures: Sequence[Failure], told: dict[tuple[str, ...], Failure]
) -> Iterator[str]:
    """Consecutive failures with the same reasons, which are printed once, after the last."""
    head = ""
    for failure in failures:
        if head and not because:
            yield ""
        before, head = head, f"{failure.where}: {failure.text}"
        if head != before or not because:
            yield head
        yield from _folded("expected", failure.finding.expected)
        yield from _folded("got", failure.finding.got)
    reasons = _fresh(because, failures[-1], told)
    if because and len(failures) > 1:
        every = "both" if len(failures) == 2 else f"all {len(failures)}"
        reasons = [f"for {every} of these", *reasons]
    for i, cause in enumerate(reasons):
        yield from _folded("because" if i == 0 else "", cause)
    for i, other in enumerate(other for failure in failures for other in failure.finding.also):
        yield from _folded("also" if i == 0 else "", other)
    yield ""


def _fresh(because: tuple[str, ...], here: Failure, told: dict[tuple[str, ...], Failure]) -> Sequence[str]:
    """Reasons not printed before; if all were, references to where they were printed.

    The single line of a parameter behind several metrics is also printed only once.
    """
    if because in told:
        return [f"as for {_place(told[because], here)}"]
    fresh = [cause for cause in dict.fromkeys(because) if not (cause.startswith(HEAD) and (cause,) in told)]
    if because and not fresh:
        places = dict.fromkeys(_place(told[(cause,)], here) for cause in because)
        return [f"as for {listed(places)}"]
    told.update({(cause,): here for cause in fresh if cause.startswith(HEAD)})
    if because:
        told[because] = here
    return fresh


def _place(failure: Failure, here: Failure) -> str:
    """Reference to another failure: its line, or its text if both have the same line."""
    shares_line = failure.where == here.where and failure.text != here.text
    return f"`{failure.text}`" if shares_line else str(failure.where)


def _folded(head: str, text: str) -> Iterator[str]:
    for i, line in enumerate(wrap(text, WIDTH - len(_INDENT)) or [""]):
        yield f"  {head if i == 0 else '':9}  {line}".rstrip()
