"""Where the golden episode of a case is kept, and which are of no case any more."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from comity.testing.naming import GOLDEN, SUFFIX

if TYPE_CHECKING:
    from comity.testing.trials.case import Case

_SIGN, _SIGN_WITHIN = b"comity-golden-", 100
"""What every golden episode has among its first bytes."""


def place_of(case: Case) -> Path:
    """`hall.golden/german_man-seed0.json`, beside `hall.scenario.yaml`."""
    stem = case.path.name.removesuffix(SUFFIX)
    return case.path.with_name(f"{stem}{GOLDEN}") / f"{case.slug}.json"


def left_over(cases: Iterable[Case]) -> Iterator[Path]:
    """Golden episodes beside the scenarios of these cases with which none of them is compared.

    Their profile, world or seed is called otherwise by now, or the whole folder is a file.
    """
    places = {place_of(case) for case in cases}
    for folder in sorted({place.parent for place in places}):
        yield from [folder] if folder.is_file() else sorted(set(folder.glob("*.json")) - places)


def abandoned(folders: Iterable[Path]) -> Iterator[Path]:
    """Those of some folders that hold golden episodes, and beside which their scenario is not.

    It is called otherwise by now, was moved, or is gone. What else is kept in a folder of such a name is no
    concern of ours.
    """
    for folder in folders:
        scenario = _scenario_of(folder)
        if not (scenario.exists() or scenario.is_symlink()) and any(map(_is_golden, folder.glob("*.json"))):
            yield folder


def told_abandoned(folder: Path, shown: str) -> str:
    """What is said of such a folder: what was expected, what came, and what to do."""
    return (
        f"{shown}: expected {_scenario_of(folder).name} beside these golden episodes, got none: no case is "
        "compared with them. Call the folder as the scenario is called now, or remove it and run "
        "`comity test --update`."
    )


def _scenario_of(folder: Path) -> Path:
    return folder.with_name(folder.name.removesuffix(GOLDEN) + SUFFIX)


def _is_golden(path: Path) -> bool:
    try:
        if not path.is_file():  # a pipe would be waited for
            return False
        with path.open("rb") as file:
            return _SIGN in file.read(_SIGN_WITHIN)
    except OSError:
        return False
