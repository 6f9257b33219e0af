"""`comity test`: scenarios held against what they expect."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, EngineName, print_json
from comity.system.stopping import is_stop
from comity_fis.errors import ComityError, InputError, Where

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from comity.testing.runner.result import Result
    from comity.testing.runner.running import Run

Paths = Annotated[
    list[str],
    typer.Argument(
        metavar="PATH",
        help="Folders, files *.scenario.yaml, or FILE::TEST; this folder without any. "
        "Options of pytest may follow after --.",
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
Update = Annotated[bool, typer.Option("--update", help="Store golden episodes beside the scenarios.")]
Fairness = Annotated[
    bool, typer.Option("--fairness", help="Flag differences between profiles that no parameter explains.")
]
Jobs = Annotated[
    int | None,
    typer.Option("--jobs", min=1, help="Processes; without it as many as the files and the cores are worth."),
]
Failed = Annotated[
    str, typer.Option("--failed", metavar="DIR", help="Where failed runs and pictures go; '' for nowhere.")
]


ENDED_EARLY, NO_TESTS = (3, 4), 5
"""Exit codes of pytest: an error of its own or a wrong option; nothing to run."""
FILES_EACH = 4
"""Scenarios that are worth a process of their own: starting it takes as long as their tests (as measured)."""
MOST_FILES = 256
"""Files that are counted to find out how many processes are worth it."""


def test(
    paths: Paths = [],  # noqa: B006  (Typer copies it)
    *,
    shipped: Shipped = False,
    sets: Sets = [],  # noqa: B006
    words: Words = None,
    profile: Profiles = [],  # noqa: B006
    fast: Fast = False,
    first: First = False,
    update: Update = False,
    fairness: Fairness = False,
    engine: EngineName = "comity",
    jobs: Jobs = None,
    failed: Failed = "runs/failed",
    as_json: AsJson = False,
) -> None:
    """Run scenarios for each of their profiles, and say which expectations do not hold, and why.

    The same as `pytest` does with these files, whatever it is set to in this folder; its options may follow
    after `--`: `comity test -- --lf` runs what failed the last time. `comity test --set comity-bench-1
    --profile paper` tries the benchmark with the four people of the paper. Where a scenario has no `at`,
    facts are taken on 2026-01-01, and not today as `comity run` does. Exit code 1: something does not hold.
    """
    from time import perf_counter

    start = perf_counter()
    with _told_anyway(fairness=fairness, as_json=as_json):
        named = list(takewhile(lambda word: not word.startswith("-"), paths))
        _require_engine(engine, update=update)
        arguments = _asked(named, _ship(sets, taught=shipped), profile, update=update)
        options = [
            f"--comity-failed={failed}",
            f"--comity-engine={engine}",
            *(f"--comity-profile={name}" for name in profile),
            *(["--comity-update"] if update else []),
            *([f"-k={words}"] if words else []),
            *(["-m=not slow"] if fast else []),
            *(["-x"] if first else []),
            *_processes(arguments, jobs),
            *paths[len(named) :],
        ]
        ran = _run(arguments, options, quiet=as_json)
        _require_tests(ran, arguments, words=words, fast=fast)
    if ran.code in ENDED_EARLY and not (ran.results or as_json):  # pytest has said why
        raise typer.Exit(2)
    took = perf_counter() - start
    code = _tell(ran.results, took, not_run=ran.not_run, fairness=fairness, as_json=as_json)
    raise ran.stopped[0] if ran.stopped else typer.Exit(2 if ran.code in ENDED_EARLY else code)


def _ship(sets: Sequence[str], *, taught: bool) -> dict[str, Path]:
    from comity.system.scenario_sets import set_asked, taught_scenarios

    files = dict(taught_scenarios()) if taught else {}
    for name in sets:
        files |= set_asked(name)
    return files


def _require_engine(engine: str, *, update: bool) -> None:
    """Refuse what is not installed, and golden episodes by another planner than the default."""
    from comity_domain import ENGINE

    if engine == ENGINE:
        return
    from comity_domain.custom.solving.choosing import require_installed

    require_installed(engine)
    if update:
        raise InputError(
            expected=f"golden episodes planned by {ENGINE}",
            got=f"--update with --engine {engine}",
            remedy="Leave one of the two options out: golden episodes are compared with the default.",
        )


def _asked(
    words: Sequence[str], ship: Mapping[str, Path], profiles: Sequence[str], *, update: bool
) -> Sequence[str]:
    """The paths that are meant; what is wrong with these or with profiles is said once, before any test."""
    from comity.testing.collection.gathering import gathered
    from comity.testing.golden.file import refuse_shipped
    from comity.testing.trials.profiles import instead

    instead(profiles)
    arguments = gathered(words, ship=ship, profiles=profiles)
    for argument in arguments if update else ():
        refuse_shipped(Path(argument.partition("::")[0]))
    return arguments


def _processes(arguments: Sequence[str], jobs: int | None) -> Sequence[str]:
    """The options for the number of workers: none where starting them takes longer than the tests."""
    from comity.testing.collection.gathering import files_in

    if jobs is not None:
        return (f"--numprocesses={jobs if jobs > 1 else 0}",)
    most = len(files_in(arguments, MOST_FILES)) // FILES_EACH
    return ("--numprocesses=auto", f"--maxprocesses={most}") if most > 1 else ("--numprocesses=0",)


def _run(arguments: Sequence[str], options: Sequence[str], *, quiet: bool) -> Run:
    from comity.commands.progress import counting
    from comity.testing.runner.running import run

    with counting(quiet=quiet) as counted:

        def note(result: Result, count: int) -> None:
            counted(f"{result.status.upper():8} {result.id}  {result.seconds:.1f} s", count)

        return run(arguments, options, note=note, warn=lambda text: print(f"comity: {text}", file=sys.stderr))


def _require_tests(ran: Run, arguments: Sequence[str], *, words: str | None, fast: bool) -> None:
    """Refuse a call that chooses no test, or after which pytest has looked for none."""
    if ran.results or ran.not_run or ran.stopped or ran.code in ENDED_EARLY:
        return
    if ran.code != NO_TESTS:
        raise InputError(
            expected="pytest to look for tests and to run them",
            got="neither",
            remedy="Leave out options after -- that only show something, or install pytest again.",
        )
    chosen = " and ".join([*([f"-k {words!r}"] if words else []), *(["--fast"] if fast else [])])
    if chosen:
        raise InputError(
            expected=f"tests that {chosen} chooses",
            got="none",
            remedy="`pytest --collect-only -q` lists the names of the tests in a folder.",
        )
    raise InputError(
        expected="files *.scenario.yaml",
        got="none with a test to run",
        remedy="Name a folder that has some, or try `comity test --shipped`.",
        where=Where(arguments[0]),
    )


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


def _tell(
    results: Sequence[Result], seconds: float, *, not_run: int | None, fairness: bool, as_json: bool
) -> int:
    """Print the account, and give the exit code."""
    from comity.testing.reporting.account import answer, summary

    told = answer(results, seconds, not_run=not_run, fairness=fairness)
    if as_json:
        print_json(told)
    elif told.refused == len(results) == 1 and not_run == 0:  # the only file cannot be used
        print(f"comity: {results[0].text}", file=sys.stderr)
    else:
        summary(results, told)
    if told.refused:
        return 2
    return 0 if all(result.good for result in results) and not told.unexplained else 1
