"""How each profile was served over all tests, to find those served worse."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import TYPE_CHECKING

from comity.report.text import table
from comity.testing.reporting.answers import ServedAnswer, TriedAnswer

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.testing.measuring.measured import Measured
    from comity.testing.runner.result import Result


def by_case(results: Sequence[Result]) -> Mapping[tuple[str, str], Sequence[Result]]:
    """The measured tests of each case, by the scenario's file and the test id without the profile."""
    groups: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        if result.measured:
            rest = result.id.replace(f"[{result.measured.profile}-", "[", 1)
            groups.setdefault((str(result.path), rest), []).append(result)
    return groups


@dataclass(frozen=True, slots=True)
class SharedCases:
    """The profiles that are compared, and the cases that all of them were tried in."""

    profiles: tuple[str, ...]
    tests: tuple[Result, ...]
    """Tests of these cases: only they are comparable."""
    cases: int
    left_out: int
    """Number of cases tried with other sets of profiles."""


def shared(results: Sequence[Result]) -> SharedCases:
    """The largest set of profiles tried in one case, with all its cases; of equal sets, the most frequent."""
    groups = list(by_case(results).values())
    tried = [frozenset(result.profile for result in group if result.profile) for group in groups]
    often = Counter(tried)
    together = max(often, key=lambda names: (len(names), often[names]), default=frozenset[str]())
    theirs = [group for group, names in zip(groups, tried, strict=True) if names == together]
    return SharedCases(
        profiles=tuple(sorted(together)),
        tests=tuple(result for group in theirs for result in group),
        cases=len(theirs),
        left_out=len(groups) - len(theirs),
    )


def served(results: Sequence[Result]) -> tuple[ServedAnswer, ...]:
    """One line for each compared profile: counts over all its tests, means over the shared cases."""
    compared = shared(results)
    best = [one for case in _cases(compared.tests) for one in case if 0 < one.served == _most(case)]
    return tuple(
        _served(
            _tried(profile, results),
            [one for one in _measured(compared.tests) if one.profile == profile],
            best,
        )
        for profile in compared.profiles
    )


def others(results: Sequence[Result]) -> tuple[TriedAnswer, ...]:
    """The profiles that share no case with all compared ones, and the results of their tests."""
    compared = shared(results).profiles
    names = {result.profile for result in results if result.profile and result.profile not in compared}
    return tuple(_tried(name, results) for name in sorted(names))


def served_alike(results: Sequence[Result]) -> list[Measured]:
    """Episodes of cases in which all profiles had equally many people served, at least one."""
    return [
        one for case in _cases(results) for one in case if all(0 < one.served == each.served for each in case)
    ]


def _cases(results: Sequence[Result]) -> Iterator[Sequence[Measured]]:
    return map(_measured, by_case(results).values())


def _measured(results: Iterable[Result]) -> list[Measured]:
    return [result.measured for result in results if result.measured]


def _most(case: Sequence[Measured]) -> int:
    return max(one.served for one in case)


def _tried(profile: str, results: Sequence[Result]) -> TriedAnswer:
    theirs = [result for result in results if result.profile == profile]
    return TriedAnswer(profile=profile, tests=len(theirs), failed=sum(not result.good for result in theirs))


def _served(tried: TriedAnswer, found: Sequence[Measured], best: Sequence[Measured]) -> ServedAnswer:
    errors = list(_errors(found))
    whole = [one for one in best if one.profile == tried.profile]  # serving nobody takes no time
    return ServedAnswer(
        profile=tried.profile,
        tests=tried.tests,
        failed=tried.failed,
        served=sum(one.served for one in found) / max(1, sum(one.wanted for one in found)),
        time_s=fmean(one.time_s for one in whole) if whole else None,
        distance_error_m=fmean(errors) if errors else None,
        intrusion_s=fmean(one.intrusion_s for one in whole) if whole else None,
        detour_m=fmean(one.detour_m for one in whole) if whole else None,
    )


def _errors(found: Iterable[Measured]) -> Iterator[float]:
    for one in found:
        for wanted, reached in one.distances_m.values():
            if reached is not None:
                yield abs(reached - wanted)


def served_table(lines: Iterable[ServedAnswer]) -> RenderableType:
    """The lines as a table, the worst served profile first."""
    ordered = sorted(lines, key=lambda one: (one.served, -one.failed, -(one.time_s or 0.0)))
    rows = [
        (
            one.profile,
            str(one.tests),
            str(one.failed),
            f"{one.served:.0%}",
            "-" if one.time_s is None else f"{one.time_s:.1f} s",
            "-" if one.distance_error_m is None else f"{100 * one.distance_error_m:.1f} cm",
            "-" if one.intrusion_s is None else f"{one.intrusion_s:.1f} s",
            "-" if one.detour_m is None else f"{one.detour_m:.2f} m",
        )
        for one in ordered
    ]
    head = ("profile", "tests", "failed", "served", "time", "error", "intrusion", "detour")
    return table(rows, head=head)
