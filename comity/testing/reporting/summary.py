"""How each profile was served, over all tests: who is served worse."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from statistics import fmean
from typing import TYPE_CHECKING

from comity.report.text import table
from comity.testing.reporting.answers import ServedAnswer

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.testing.judging.measured import Measured
    from comity.testing.runner.result import Result


def by_case(results: Sequence[Result]) -> Mapping[tuple[str, str], Sequence[Result]]:
    """Each case's measured tests, by the scenario's file and their id without the profile."""
    groups: dict[tuple[str, str], list[Result]] = {}
    for result in results:
        if result.measured:
            rest = result.id.replace(f"[{result.measured.profile}-", "[", 1)
            groups.setdefault((str(result.path), rest), []).append(result)
    return groups


def comparable(results: Sequence[Result]) -> Sequence[Result]:
    """The tests of the cases that were tried with the most profiles: only these compare like with like."""
    groups = by_case(results)
    most = max(map(len, groups.values()), default=0)
    return [result for group in groups.values() if len(group) == most for result in group]


def served(results: Sequence[Result]) -> tuple[ServedAnswer, ...]:
    """One line for each profile, over the cases that were tried with the most profiles."""
    compared = comparable(results)
    best = [one for case in _cases(compared) for one in case if 0 < one.served == _most(case)]
    by_profile: dict[str, list[Result]] = {}
    for result in compared:
        if result.measured:
            by_profile.setdefault(result.measured.profile, []).append(result)
    return tuple(_served(profile, of_it, best) for profile, of_it in sorted(by_profile.items()))


def served_alike(results: Sequence[Result]) -> list[Measured]:
    """The episodes of the cases in which every profile had as many people served: these took like times."""
    return [
        one for case in _cases(results) for one in case if all(one.served == each.served for each in case)
    ]


def _cases(results: Sequence[Result]) -> Iterator[Sequence[Measured]]:
    return ([one.measured for one in group if one.measured] for group in by_case(results).values())


def _most(case: Sequence[Measured]) -> int:
    return max(one.served for one in case)


def _served(profile: str, results: Sequence[Result], best: Sequence[Measured]) -> ServedAnswer:
    found = [result.measured for result in results if result.measured]
    errors = list(_errors(found))
    whole = [one for one in best if one.profile == profile]  # who serves nobody takes no time
    return ServedAnswer(
        profile=profile,
        tests=len(results),
        failed=sum(not result.good for result in results),
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
    """The same for people; those who are served worst come first."""
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
    head = ("profile", "tests", "failed", "served", "time", "off by", "intrusion", "detour")
    return table(rows, head=head)
