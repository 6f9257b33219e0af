"""Location of a case's golden episode, and golden episodes without a case."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from comity.testing.naming import GOLDEN, SUFFIX

if TYPE_CHECKING:
    from comity.testing.trials.case import Case

_SIGN, _SIGN_WITHIN = b"comity-golden-", 100
"""Marker that every golden episode contains within its first bytes."""


def place_of(case: Case) -> Path:
    """Path such as `hall.golden/german_man-seed0.json`, next to `hall.scenario.yaml`."""
    stem = case.path.name.removesuffix(SUFFIX)
    return case.path.with_name(f"{stem}{GOLDEN}") / f"{case.slug}.json"


def left_over(cases: Iterable[Case]) -> Iterator[Path]:
    """Golden episodes next to the scenarios of these cases that belong to none of them.

    Their profile, world or seed was renamed, or a file has the name of the folder.
    """
    places = {place_of(case) for case in cases}
    for folder in sorted({place.parent for place in places}):
        yield from [folder] if folder.is_file() else sorted(set(folder.glob("*.json")) - places)


def abandoned(folders: Iterable[Path]) -> Iterator[Path]:
    """Folders of golden episodes whose scenario is missing.

    The scenario was renamed, moved or deleted. Other content of such folders is ignored.
    """
    for folder in folders:
        scenario = _scenario_of(folder)
        if not (scenario.exists() or scenario.is_symlink()) and any(map(_is_golden, folder.glob("*.json"))):
            yield folder


def told_abandoned(folder: Path, shown: str) -> str:
    """Message about such a folder: what was expected, what came, and the remedy."""
    return (
        f"{shown}: expected {_scenario_of(folder).name} beside these golden episodes, got none: no case is "
        "compared with them. Call the folder as the scenario is called now, or remove it and run "
        "`comity test --update`."
    )


def _scenario_of(folder: Path) -> Path:
    return folder.with_name(folder.name.removesuffix(GOLDEN) + SUFFIX)


def _is_golden(path: Path) -> bool:
    try:
        if not path.is_file():  # reading a pipe would block
            return False
        with path.open("rb") as file:
            return _SIGN in file.read(_SIGN_WITHIN)
    except OSError:
        return False
