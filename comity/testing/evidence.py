"""The run of a failed test, kept to be looked at: a run folder with a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from comity.run_folder import PICTURE

if TYPE_CHECKING:
    from comity.testing.cases import Claim

MOST = 12
"""Pictures drawn by one process: who breaks everything at once does not wait for hundreds."""

_kept: list[Path] = []


def kept(claim: Claim, folder: Path) -> Path | None:
    """Write the run folder of a failed test; `comity trace` and `comity replay` read it.

    Args:
        claim: What failed.
        folder: Below it, one folder for each test.

    Returns:
        The picture; None for a comparison of profiles, without a plan, or where it cannot be written.
    """
    from comity.recording import record
    from comity.report.pictures import draw_episode
    from comity.testing.case import Across
    from comity.testing.trial import prepared_case
    from comity_domain import PlanningFailed
    from comity_fis import InputError

    if isinstance(claim.case, Across) or len(_kept) >= MOST:
        return None
    out = folder / claim.case.slug
    try:
        recorded = record(prepared_case(claim.case), seed=claim.case.seed, out=out, pictures=False)
    except (PlanningFailed, InputError, OSError):
        return None
    draw_episode(recorded.episode, out / PICTURE)
    _kept.append(out)
    return out / PICTURE
