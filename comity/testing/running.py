"""Running many tests on all cores, each file's tests in one process and in order."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path

from comity.testing import processes
from comity.testing.cases import Claim
from comity.testing.known import Known
from comity.testing.measured import Measured
from comity.testing.result import Result, known_or_result, note, result_of

FEW = 6
"""Tests that are done before other processes have started."""
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
    from concurrent.futures import as_completed

    one = partial(_in_turn, update=update, afresh=afresh, failed=failed)
    batches = [tuple(group) for _, group in groupby(claims, key=lambda claim: claim.path)]
    batches.sort(key=lambda batch: -_weight(batch))
    with processes.pool(jobs) as pool:
        submitted = [pool.submit(_batch, batch, one) for batch in batches]
        for done in as_completed(submitted):
            yield from done.result()


def _weight(batch: Sequence[Claim]) -> int:
    """How long it takes, roughly: what is long goes first, so that no process waits at the end."""
    scenario = batch[0].case.file.scenario
    walking = sum(person.walks is not None for person in scenario.people.values())
    passing = scenario.passers_by.count if scenario.passers_by else 0
    return len(batch) * (len(scenario.people) + passing + OF_A_WALK * walking)


def _batch(claims: Sequence[Claim], one: Callable[[Sequence[Claim]], Iterator[Result]]) -> list[Result]:
    return list(one(claims))


def _in_turn(claims: Iterable[Claim], *, update: bool, afresh: bool, failed: Path | None) -> Iterator[Result]:
    """The comparisons of a file come last, and take what was measured in its cases."""
    measured: dict[Path, dict[str, Measured]] = defaultdict(dict)
    for claim in claims:
        before = measured[claim.path]
        known = Known.of_this_machine()
        if update or afresh:
            result = result_of(claim, update=update, failed=failed, before=before)
            note(claim, result, known)
        else:
            result = known_or_result(claim, known, failed=failed, before=before)
        if result.measured:
            before[claim.id] = result.measured
        yield result
