"""`comity test`: scenarios held against what they expect."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json
from comity.system.stopping import Stopped, is_stop
from comity_fis.errors import ComityError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from comity.testing.collection.cases import Claim
    from comity.testing.collection.gathering import Gathered
    from comity.testing.runner.processes import ProcessLost
    from comity.testing.runner.result import Result

Paths = Annotated[
    list[str],
    typer.Argument(
        metavar="PATH", help="Folders, files *.scenario.yaml, or FILE::TEST; this folder without any."
    ),
]
Shipped = Annotated[
    bool, typer.Option("--shipped", help="The scenarios to learn from that ship with Comity.")
]
Sets = Annotated[
    list[str], typer.Option("--set", metavar="NAME", help="A set that ships with Comity: comity-bench-1.")
]
Words = Annotated[
    str | None,
    typer.Option(
        "-k", metavar="WORDS", help="Only tests whose names hold these: '(arab or german) and not seed1'."
    ),
]
Profiles = Annotated[
    list[str],
    typer.Option(
        "--profile", metavar="P", help="Instead of the profiles of every matrix; a path starts from here."
    ),
]
Fast = Annotated[bool, typer.Option("--fast", help="Leave out what its file marks as slow.")]
First = Annotated[bool, typer.Option("-x", help="Stop at the first failure.")]
Afresh = Annotated[
    bool, typer.Option("--afresh", help="Also run what passed before and hangs on nothing that changed.")
]
Update = Annotated[bool, typer.Option("--update", help="Store golden episodes beside the scenarios.")]
Fairness = Annotated[
    bool, typer.Option("--fairness", help="Flag differences between profiles that no parameter explains.")
]
Jobs = Annotated[int | None, typer.Option("--jobs", min=1, help="Processes; one on each core without it.")]
Failed = Annotated[
    str, typer.Option("--failed", metavar="DIR", help="Where failed runs and pictures go; '' for nowhere.")
]


def test(
    paths: Paths = [],  # noqa: B006  (Typer copies it)
    *,
    shipped: Shipped = False,
    sets: Sets = [],  # noqa: B006
    words: Words = None,
    profile: Profiles = [],  # noqa: B006
    fast: Fast = False,
    first: First = False,
    afresh: Afresh = False,
    update: Update = False,
    fairness: Fairness = False,
    jobs: Jobs = None,
    failed: Failed = "runs/failed",
    as_json: AsJson = False,
) -> None:
    """Run scenarios for each of their profiles, and say which expectations do not hold, and why.

    The same as `pytest` does with these files. `comity test --set comity-bench-1 --profile paper` tries
    the benchmark with the four people of the paper. Where a scenario has no `at`, facts are taken on
    2026-01-01, and not today as `comity run` does. Exit code 1: something does not hold.
    """
    from itertools import chain
    from time import perf_counter

    with _told_anyway(fairness=fairness, as_json=as_json):
        from comity.testing.runner import processes

        ship = _ship(sets, taught=shipped)
        if ship and jobs != 1:
            processes.start()
        from comity.testing.collection.gathering import gathered, matching
        from comity.testing.runner.result import unread
        from comity.testing.runner.running import results

        start = perf_counter()
        every = gathered(paths, ship=ship, profiles=_named(profile), fast=fast)
        claims = matching(every, words)
        _refuse(every, claims, update=update, as_json=as_json)
        _note_unused(every)
    found = results(claims, jobs=jobs, update=update, afresh=afresh, failed=Path(failed) if failed else None)
    ended: list[Result] = []
    stopped = _until_stopped(
        chain(unread(every.refused, profile), found), ended, len(claims), first=first, quiet=as_json
    )
    left = len(claims) + len(every.refused) - len(ended)
    took = perf_counter() - start
    code = _tell(_ordered(ended, claims), took, not_run=left, fairness=fairness, as_json=as_json)
    raise stopped or typer.Exit(code)


def _ship(sets: Sequence[str], *, taught: bool) -> dict[str, Path]:
    from comity.system.scenario_sets import set_asked, taught_scenarios

    files = dict(taught_scenarios()) if taught else {}
    for name in sets:
        files |= set_asked(name)
    return files


def _named(profiles: Sequence[str]) -> tuple[str, ...]:
    from comity.specification.matrix import PAPER
    from comity.system.library import shipped

    groups = {"paper": PAPER, "all": tuple(shipped("profile"))}
    return tuple(dict.fromkeys(name for word in profiles for name in groups.get(word, (word,))))


def _refuse(every: Gathered, claims: Sequence[Claim], *, update: bool, as_json: bool) -> None:
    """What is told before any test: that the only file cannot be used, or is none to write beside."""
    from comity.testing.golden.file import refuse_shipped

    if not claims and len(every.refused) == 1 and not as_json:
        raise next(iter(every.refused.values()))
    for claim in claims if update else ():
        refuse_shipped(claim.case)


def _note_unused(every: Gathered) -> None:
    """Say which golden episodes hold nothing any more, and of which the scenario is not there."""
    from comity.testing.collection.cases import shown
    from comity.testing.golden.place import told_abandoned
    from comity.testing.runner.telling import left_over_text

    for path in every.left_over:
        print(f"comity: {left_over_text(path, '`comity test --update`')}", file=sys.stderr)
    for folder in every.abandoned:
        print(f"comity: {told_abandoned(folder, shown(folder))}", file=sys.stderr)


@contextmanager
def _told_anyway(*, fairness: bool, as_json: bool) -> Iterator[None]:
    """What ends inside, before any test, has its JSON object all the same."""
    from time import perf_counter

    start = perf_counter()
    try:
        yield
    except BaseException as error:
        if as_json and (isinstance(error, ComityError | OSError) or is_stop(error)):
            _tell((), perf_counter() - start, not_run=None, fairness=fairness, as_json=True)
        raise


def _until_stopped(
    found: Iterable[Result], ended: list[Result], count: int, *, first: bool, quiet: bool
) -> Stopped | ProcessLost | None:
    """Add and tell the results, up to the first failure where that is asked for; what stopped it before."""
    from comity.commands.progress import counting
    from comity.testing.runner.processes import ProcessLost

    try:
        with counting(count, quiet=quiet) as note:
            for result in found:
                ended.append(result)  # before it is told: what somebody has read of is never lost
                note(f"{result.status.upper():8} {result.id}  {result.seconds:.1f} s")
                if first and not result.good:
                    break
    except (Stopped, ProcessLost) as stopped:
        return stopped
    return None


def _ordered(results: Iterable[Result], claims: Sequence[Claim]) -> list[Result]:
    order = {(claim.path, claim.id): i for i, claim in enumerate(claims)}
    return sorted(results, key=lambda result: order.get((result.path, result.id), -1))


def _tell(
    results: Sequence[Result], seconds: float, *, not_run: int | None, fairness: bool, as_json: bool
) -> int:
    """Print the account, and give the exit code."""
    from comity.testing.reporting.account import answer, summary

    told = answer(results, seconds, not_run=not_run, fairness=fairness)
    if as_json:
        print_json(told)
    else:
        summary(results, told)
    if told.refused:
        return 2
    return 0 if all(result.good for result in results) and not told.unexplained else 1
