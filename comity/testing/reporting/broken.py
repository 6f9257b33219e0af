"""Failed expectations by profile: an overview after an edit."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from comity.report.text import table
from comity.testing.reporting.answers import BrokenAnswer

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.testing.runner.result import Result

OVERVIEW = 3
"""Above this number of failed tests an overview is shown (our choice)."""
MOST = 20
"""Maximum number of expectations listed singly; above it, counts by scenario are shown (our choice)."""


def broken(results: Sequence[Result]) -> tuple[BrokenAnswer, ...]:
    """Every expectation that fails in some test, file by file."""
    failed: dict[tuple[str, str, str], list[Result]] = defaultdict(list)
    for result in results:
        if not result.good:
            for where, text in result.broken:
                failed[str(result.path), where, text].append(result)
    tests = Counter((str(result.path), result.compares) for result in results)
    return tuple(
        BrokenAnswer(
            file=path,
            where=where,
            expectation=text,
            profiles=tuple(dict.fromkeys(result.profile for result in found if result.profile)),
            failed=len(found),
            tests=tests[path, found[0].compares],
        )
        for (path, where, text), found in failed.items()
    )


def broken_table(told: Sequence[BrokenAnswer], results: Iterable[Result]) -> RenderableType:
    """The failed expectations as a table: one by one, or by scenario if there are many."""
    tried: dict[str, set[str]] = defaultdict(set)
    for result in results:
        if result.profile:
            tried[str(result.path)].add(result.profile)
    if len(told) > MOST:
        return table(_by_scenario(told, tried), head=("scenario", "expectations", "for"))
    rows = [(f"{one.where}: {one.expectation}", _whom(one.profiles, tried[one.file])) for one in told]
    return table(rows, head=("expectation", "for"))


def _by_scenario(
    told: Sequence[BrokenAnswer], tried: Mapping[str, Collection[str]]
) -> Iterable[tuple[str, str, str]]:
    for path, of_file in groupby(told, key=lambda one: one.file):
        every = tuple(of_file)
        profiles = dict.fromkeys(profile for one in every for profile in one.profiles)
        called = every[0].where.rpartition(":")[0]
        yield called, str(len(every)), _whom(tuple(profiles), tried[path])


def _whom(profiles: Sequence[str], tried: Collection[str]) -> str:
    if not profiles:
        return "all in comparison"
    if len(profiles) == len(tried) > 1:
        return f"all {len(tried)} profiles"
    return ", ".join(profiles)
