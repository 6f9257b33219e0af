"""Where the golden episode of a case is kept, and which are of no case any more."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity.testing.trials.case import Case


def place_of(case: Case) -> Path:
    """`hall.golden/german_man-seed0.json`, beside `hall.scenario.yaml`."""
    stem = case.path.name.removesuffix(".scenario.yaml")
    return case.path.with_name(f"{stem}.golden") / f"{case.slug}.json"


def left_over(cases: Iterable[Case]) -> Iterator[Path]:
    """Golden episodes beside the scenarios of these cases with which none of them is compared.

    Their profile, world or seed is called otherwise by now, or the whole folder is a file.
    """
    places = {place_of(case) for case in cases}
    for folder in sorted({place.parent for place in places}):
        yield from [folder] if folder.is_file() else sorted(set(folder.glob("*.json")) - places)
