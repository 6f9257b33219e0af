"""Running many tests on all cores, each file's tests in one process and in order."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

from comity.testing.cases import Claim, claims_in
from comity.testing.known import Known
from comity.testing.result import Result, known_or_result, result_of

if TYPE_CHECKING:
    from multiprocessing.context import BaseContext

FEW = 6
"""Tests that are done before other processes have started."""


def results(
    claims: Sequence[Claim],
    *,
    jobs: int | None = None,
    profiles: Sequence[str] = (),
    update: bool = False,
    afresh: bool = False,
    failed: Path | None = None,
) -> Iterator[Result]:
    """Every test's result, as they come.

    Args:
        claims: The tests.
        jobs: Processes; None for one on each core.
        profiles: As the tests were gathered with.
        update: Whether to store golden episodes.
        afresh: Whether to run also what passed before and cannot come out otherwise now.
        failed: The folder for the runs of failed tests.
    """
    jobs = jobs or len(
        os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else range(os.cpu_count() or 1)
    )
    if jobs == 1 or len(claims) <= FEW:
        yield from (_result(claim, update=update, afresh=afresh, failed=failed) for claim in claims)
        return
    from concurrent.futures import ProcessPoolExecutor, as_completed

    one = partial(_result, update=update, afresh=afresh, failed=failed)
    batches = [
        (path, frozenset(claim.id for claim in group))
        for path, group in groupby(claims, key=lambda claim: claim.path)
    ]
    batches.sort(key=lambda batch: -len(batch[1]))
    with ProcessPoolExecutor(jobs, mp_context=_context()) as pool:
        submitted = [pool.submit(_batch, *batch, tuple(profiles), one) for batch in batches]
        for done in as_completed(submitted):
            yield from done.result()


def _batch(
    path: Path, ids: frozenset[str], profiles: tuple[str, ...], one: Callable[[Claim], Result]
) -> list[Result]:
    claims = claims_in(path, profiles=profiles)
    return [one(claim) for claim in claims if claim.id in ids]


def _result(claim: Claim, *, update: bool, afresh: bool, failed: Path | None) -> Result:
    if update or afresh:
        return result_of(claim, update=update, failed=failed)
    return known_or_result(claim, Known.of_this_machine(), failed=failed)


def _context() -> BaseContext:
    """Processes that start clean, and where the system can, with everything imported once for all of them."""
    from multiprocessing import get_all_start_methods, get_context

    if "forkserver" not in get_all_start_methods():
        return get_context("spawn")
    context = get_context("forkserver")
    context.set_forkserver_preload(["comity.testing.running"])
    return context
