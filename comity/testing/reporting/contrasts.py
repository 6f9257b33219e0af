"""Differences between pairs of profiles, grouped by case: the value of each profile, highest first.

Thirteen profiles make 78 pairs; if one profile is served differently, twelve pairs show the same difference.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from comity.report.text import table
from comity.testing.reporting.fairness import asked_for, told

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.testing.reporting.answers import UnexplainedAnswer


def contrasts(found: Sequence[UnexplainedAnswer]) -> Iterator[RenderableType]:
    """For each case and differing metric: why it is reported, and the value of each profile."""
    gathered: dict[tuple[str, str], list[UnexplainedAnswer]] = {}
    for one in found:
        gathered.setdefault((one.case, one.what), []).append(one)
    for (case, what), pairs in gathered.items():
        yield f"{case}: {what}; {_because(pairs)}"
        yield table(_rows(pairs))
        yield ""


def _rows(pairs: Sequence[UnexplainedAnswer]) -> Iterator[tuple[str, str]]:
    values = {name: value for one in pairs for name, value in zip(one.profiles, one.values, strict=True)}
    alike: dict[str, list[str]] = {}
    for name in sorted(values, key=lambda name: (-values[name], name)):
        alike.setdefault(told(values[name], pairs[0].unit), []).append(name)
    return ((value, ", ".join(sorted(names))) for value, names in alike.items())


def _because(pairs: Sequence[UnexplainedAnswer]) -> str:
    """The reason that all pairs share, if any."""
    shared = set.intersection(*(set(one.settings) for one in pairs))
    if shared:
        return asked_for(sorted(shared))
    return "; or ".join(dict.fromkeys(one.because for one in pairs))
