"""`comity test`: scenarios held against what they expect."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from collections.abc import Iterable

    from comity.testing.result import Result


def test(
    paths: Annotated[
        list[str],
        typer.Argument(
            metavar="PATH", help="Folders, files *.scenario.yaml, or FILE::TEST; this folder without any."
        ),
    ] = [],  # noqa: B006  (Typer copies it)
    *,
    shipped: Annotated[bool, typer.Option("--shipped", help="The scenarios that ship with Comity.")] = False,
    words: Annotated[
        str | None,
        typer.Option("-k", metavar="WORDS", help="Only tests whose id holds these: 'arab and not seed1'."),
    ] = None,
    profile: Annotated[
        list[str], typer.Option("--profile", metavar="P", help="Instead of the profiles of every matrix.")
    ] = [],  # noqa: B006
    fast: Annotated[bool, typer.Option("--fast", help="Leave out what its file marks as slow.")] = False,
    first: Annotated[bool, typer.Option("-x", help="Stop at the first failure.")] = False,
    afresh: Annotated[
        bool, typer.Option("--afresh", help="Also run what passed before and hangs on nothing that changed.")
    ] = False,
    update: Annotated[
        bool, typer.Option("--update", help="Store golden episodes beside the scenarios.")
    ] = False,
    fairness: Annotated[
        bool, typer.Option("--fairness", help="Flag differences between profiles that no parameter explains.")
    ] = False,
    jobs: Annotated[
        int | None, typer.Option("--jobs", min=1, help="Processes; one on each core without it.")
    ] = None,
    failed: Annotated[
        str,
        typer.Option("--failed", metavar="DIR", help="Where failed runs and pictures go; '' for nowhere."),
    ] = "runs/failed",
    as_json: AsJson = False,
) -> None:
    """Run scenarios for each of their profiles, and say which expectations do not hold, and why.

    The same as `pytest` does with these files. `comity test --shipped --profile paper` tries what ships
    with the four people of the paper. Exit code 1: something does not hold.
    """
    from time import perf_counter

    from comity.testing.account import answer, summary
    from comity.testing.gathering import gathered, matching
    from comity.testing.running import results

    start = perf_counter()
    claims = matching(gathered(paths, ship=shipped, profiles=_words(profile), fast=fast), words)
    kept = Path(failed) if failed else None
    found = list(
        _watched(
            results(claims, jobs=jobs, profiles=_words(profile), update=update, afresh=afresh, failed=kept),
            len(claims),
            quiet=as_json,
            first=first,
        )
    )
    order = {claim.id: i for i, claim in enumerate(claims)}
    found.sort(key=lambda result: (str(result.path), order[result.id]))
    told = answer(found, perf_counter() - start, fairness=fairness)
    if as_json:
        print_json(told)
    else:
        summary(found, told)
    if told.refused:
        raise typer.Exit(2)
    raise typer.Exit(0 if all(result.good for result in found) and not told.unexplained else 1)


def _words(profiles: list[str]) -> tuple[str, ...]:
    from comity.library import shipped
    from comity.matrix import PAPER

    groups = {"paper": PAPER, "all": tuple(shipped("profile"))}
    return tuple(dict.fromkeys(name for word in profiles for name in groups.get(word, (word,))))


def _watched(found: Iterable[Result], count: int, *, quiet: bool, first: bool) -> Iterable[Result]:
    if first:
        found = _until_failure(found)
    if quiet or not sys.stderr.isatty():
        yield from found
        return
    from comity.report.text import console

    with console(to_errors=True).status(f"{count} tests") as status:
        for done, result in enumerate(found, start=1):
            status.update(f"{done} of {count} tests")
            yield result


def _until_failure(found: Iterable[Result]) -> Iterable[Result]:
    for result in found:
        yield result
        if not result.good:
            return
