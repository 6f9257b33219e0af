"""Running many tests on all cores, each file's tests in order, and in one process unless they are many."""

from __future__ import annotations

import os
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

from comity.testing.collection.cases import Claim
from comity.testing.judging.measured import Measured
from comity.testing.judging.verdict import NOTHING
from comity.testing.runner import processes
from comity.testing.runner.known import Known
from comity.testing.runner.result import Result, known_or_result, note, result_of
from comity.testing.trials.case import Across

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    Batch = tuple[Claim, ...]
    Run = Callable[[Sequence[Claim], Mapping[str, Measured]], Iterator[Result]]

FEW = 6
"""Tests that are done before other processes have started."""
TOGETHER = 8
"""Cases of one file that a process carries out one after the other, and tells of together: one place, one map
of routes (our choice)."""
OF_A_WALK = 5
"""Where somebody walks, so many times as many ways are looked for (as measured)."""


def results(
    claims: Sequence[Claim],
    *,
    jobs: int | None = None,
    update: bool = False,
    afresh: bool = False,
    failed: Path | None = None,
) -> Iterator[Result]:
    """Every test's result, as they come.

    Args:
        claims: The tests.
        jobs: Processes; None for one on each core.
        update: Whether to store golden episodes.
        afresh: Whether to run also what passed before and cannot come out otherwise now.
        failed: The folder for the runs of failed tests.
    """
    jobs = jobs or len(
        os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else range(os.cpu_count() or 1)
    )
    if jobs == 1 or len(claims) <= FEW:
        yield from _in_turn(claims, update=update, afresh=afresh, failed=failed)
        return
    one = partial(_in_turn, update=update, afresh=afresh, failed=failed)
    with processes.pool(jobs) as pool:
        yield from _from_all(pool, claims, one)


def _from_all(pool: Executor, claims: Sequence[Claim], one: Run) -> Iterator[Result]:
    """The comparisons of a file in parts are made when all of its cases have been measured."""
    from concurrent.futures import FIRST_COMPLETED, wait

    batches, comparisons = _batches(claims)
    left = Counter(batch[0].path for batch in batches)
    measured: dict[Path, dict[str, Measured]] = defaultdict(dict)
    pending: dict[Future[list[Result]], Path] = {}

    def submit(batch: Batch) -> None:
        path = batch[0].path
        pending[pool.submit(_batch, batch, measured[path], one)] = path

    for batch in batches:
        submit(batch)
    while pending:
        for done in wait(pending, return_when=FIRST_COMPLETED).done:
            path = pending.pop(done)
            for result in done.result():
                if result.measured:
                    measured[path][result.id] = result.measured
                yield result
            left[path] -= 1
            if not left[path] and path in comparisons:
                submit(comparisons.pop(path))


def _batches(claims: Sequence[Claim]) -> tuple[list[Batch], dict[Path, Batch]]:
    """What one process does at a time, what takes long first; and the comparisons of files in parts."""
    batches, comparisons = [], {}
    for path, group in groupby(claims, key=lambda claim: claim.path):
        every = tuple(group)
        cases = tuple(claim for claim in every if not isinstance(claim.case, Across))
        if len(cases) <= TOGETHER:
            batches.append(every)
            continue
        batches += [cases[i : i + TOGETHER] for i in range(0, len(cases), TOGETHER)]
        if len(cases) < len(every):
            comparisons[path] = tuple(claim for claim in every if isinstance(claim.case, Across))
    return sorted(batches, key=lambda batch: -_weight(batch)), comparisons


def _weight(batch: Sequence[Claim]) -> int:
    """How long it takes, roughly: what is long goes first, so that no process waits at the end."""
    scenario = batch[0].case.file.scenario
    walking = sum(person.walks is not None for person in scenario.people.values())
    passing = scenario.passers_by.count if scenario.passers_by else 0
    return len(batch) * (len(scenario.people) + passing + OF_A_WALK * walking)


def _batch(claims: Batch, measured: Mapping[str, Measured], one: Run) -> list[Result]:
    return list(one(claims, measured))


def _in_turn(
    claims: Iterable[Claim],
    measured: Mapping[str, Measured] = NOTHING,
    *,
    update: bool,
    afresh: bool,
    failed: Path | None,
) -> Iterator[Result]:
    """The comparisons of a file come last, and take what was measured in its cases."""
    of_files: dict[Path, dict[str, Measured]] = defaultdict(lambda: dict(measured))
    for claim in claims:
        before = of_files[claim.path]
        known = Known.of_this_machine()
        if update or afresh:
            result = result_of(claim, update=update, failed=failed, before=before)
            note(claim, result, known)
        else:
            result = known_or_result(claim, known, failed=failed, before=before)
        if result.measured:
            before[claim.id] = result.measured
        yield result
