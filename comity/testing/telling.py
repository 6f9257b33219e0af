"""A failure as people read it."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator
from textwrap import wrap
from typing import TYPE_CHECKING

from comity.testing.cases import ships, shown
from comity.testing.evidence import NONE
from comity.testing.shaping import HEAD

if TYPE_CHECKING:
    from pathlib import Path

    from comity.testing.cases import Claim
    from comity.testing.evidence import Evidence
    from comity.testing.verdict import Failure

WIDTH = 100
_INDENT = " " * 13


def failure_text(claim: Claim, failures: Iterable[Failure], evidence: Evidence = NONE) -> str:
    """Every failure with its place, and how to see it again.

    Args:
        claim: What failed.
        failures: What does not hold.
        evidence: The picture of the episode.
    """
    told: dict[tuple[str, ...], str] = {}
    lines = [line for failure in failures for line in (*_lines(failure, told), "")]
    if ships(claim.path):
        lines.append(f"  file       {claim.path}")
    if str(evidence):
        lines.append(f"  picture    {evidence}")
    lines.append(f"  again      {again(claim)}")
    return "\n".join(lines)


def again(claim: Claim) -> str:
    """The command that runs this test alone."""
    return command(claim.path, claim.id, claim.others)


def command(path: Path, test: str | None = None, profiles: Iterable[str] = ()) -> str:
    """The line for a shell that runs a file's tests, or one of them."""
    name = shown(path)
    name = f"./{name}" if name.startswith("-") else name  # else it would be an option
    others = (word for profile in profiles for word in ("--profile", profile))
    return shlex.join(["comity", "test", f"{name}::{test}" if test else name, *others])


def _lines(failure: Failure, told: dict[tuple[str, ...], str]) -> Iterator[str]:
    """One failure; reasons that were told already, by the place of who told them, are not told again.

    The same holds for a parameter behind several figures, by its own line.
    """
    finding = failure.finding
    yield f"{failure.where}: {failure.text}"
    yield from _folded("expected", finding.expected)
    yield from _folded("got", finding.got)
    before = told.setdefault(tuple(finding.because), str(failure.where))
    if finding.because and before != str(failure.where):
        yield from _folded("because", f"as of {before}")
        return
    here = str(failure.where)
    fresh = [
        cause
        for cause in dict.fromkeys(finding.because)
        if not cause.startswith(HEAD) or told.setdefault((cause,), here) == here
    ]
    for i, cause in enumerate(fresh):
        yield from _folded("because" if i == 0 else "", cause)


def _folded(head: str, text: str) -> Iterator[str]:
    for i, line in enumerate(wrap(text, WIDTH - len(_INDENT)) or [""]):
        yield f"  {head if i == 0 else '':9}  {line}".rstrip()
