"""The planning problem of a scenario as PDDL files, for other planners and for readers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from comity_domain import plan_pddl
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.preparation import Prepared

DOMAIN, PROBLEM = "domain.pddl", "problem.pddl"


def write_pddl(prepared: Prepared, folder: Path) -> None:
    """Write `domain.pddl` and `problem.pddl`, whole or not at all.

    Raises:
        InputError: if the folder cannot be used, or holds files of these names that are not ours.
    """
    domain, problem = plan_pddl(prepared.asked.request)
    texts = {folder / DOMAIN: _OURS + domain, folder / PROBLEM: _OURS + problem}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path in texts:
            if path.exists() and not path.read_text(encoding="utf-8", errors="replace").startswith(_OURS):
                raise InputError(
                    expected="a place for the PDDL files",
                    got=f"a {path.name} that Comity did not write",
                    remedy="Name another folder: nothing is overwritten.",
                    where=Where(str(path)),
                )
        for path, text in texts.items():
            path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(
            expected="a folder for the PDDL files",
            got=error.strerror or str(error),
            remedy="Name a folder that you may write to.",
            where=Where(str(folder)),
        ) from None


_OURS = "; Written by Comity.\n"
