"""Evidence of a failed test: its stored run folder with a picture."""

from __future__ import annotations

import hashlib
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity.output.run_folder import PICTURE
from comity.testing.naming import SUFFIX
from comity.testing.trials.case import Across, Case, from_here, whole

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim

MOST = 12
"""Maximum number of pictures that one process draws below one folder: hundreds would take minutes."""

_drawn: Counter[Path] = Counter()


@dataclass(frozen=True, slots=True)
class Evidence:
    """The picture of a failed test, or why there is none."""

    picture: Path | None = None
    missing: str = ""
    """Why there is no picture; empty if none is expected."""

    def __str__(self) -> str:
        return str(self.picture or (f"none: {self.missing}" if self.missing else ""))


NONE = Evidence()


def kept(claim: Claim, folder: Path) -> Evidence:
    """Write the run folder of a failed test; `comity trace` and `comity replay` read it.

    Args:
        claim: The failed test.
        folder: Parent folder; inside, a folder for each scenario, and in it one for each case.
    """
    from comity_fis import InputError

    if isinstance(claim.case, Across):
        return NONE
    if _drawn[folder.absolute()] >= MOST:
        return Evidence(missing=f"{MOST} are drawn at most by one process; run this one alone")
    out = folder / place_of(claim.case)
    try:
        evidence = _recorded(claim.case, out)
    except InputError as error:
        return Evidence(missing=f"{error.where}: {error.got}")
    except OSError as error:
        return Evidence(missing=f"{error.filename or out}: {error.strerror or error}")
    _drawn[folder.absolute()] += bool(evidence.picture)
    return evidence


def removed(claim: Claim, folder: Path) -> None:
    """Remove the run folder of a test that passes now, and folders left empty.

    Args:
        claim: The passing test.
        folder: As for `kept`; the folder itself stays, as does everything in it that is no run.
    """
    from comity.output import run_folder
    from comity_fis import InputError

    if isinstance(claim.case, Across):
        return
    out = folder / place_of(claim.case)
    if not run_folder.is_run(out):
        return
    with suppress(InputError, OSError):  # a leftover does no harm
        run_folder.remove(out)
        for above in out.relative_to(folder).parents[:-1]:
            (folder / above).rmdir()


def place_of(case: Case) -> Path:
    """Path such as `hall/german_man-seed0` below the scenario's folders: unique for each case."""
    stem = case.path.name.removesuffix(SUFFIX)
    return _folder_of(case.path) / stem / case.slug


def _folder_of(path: Path) -> Path:
    """Path relative to the current folder; if it is elsewhere, its name with a digest of its location."""
    if here := from_here(path):
        return here.parent
    folder = whole(path).parent
    return Path(f"{folder.name}-{hashlib.sha256(bytes(folder)).hexdigest()[:8]}")


def _recorded(case: Case, out: Path) -> Evidence:
    from comity.recording import record
    from comity.testing.trials.attempt import prepared_case
    from comity_domain import PlanningFailed

    try:
        record(prepared_case(case), seed=case.seed, out=out, views=["picture"])
    except PlanningFailed:
        return NONE
    return Evidence(out / PICTURE)
