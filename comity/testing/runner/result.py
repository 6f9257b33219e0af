"""What came of a test, in a form that crosses to another process."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pydantic import TypeAdapter

from comity.testing.collection.cases import shown
from comity.testing.measuring.measured import Measured
from comity.testing.runner.evidence import NONE, kept, removed
from comity.testing.runner.telling import again, command, failure_text
from comity.testing.trials.case import Across, from_here
from comity.testing.verdict import NOTHING, judged
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim
    from comity.testing.runner.evidence import Evidence
    from comity.testing.verdict import Verdict

Status = Literal["passed", "failed", "xfailed", "xpassed", "refused"]
"""`xfailed`: it failed as its file says it must; `xpassed`: it did not, which is a failure, too."""


@dataclass(frozen=True, slots=True)
class Result:
    """One test's end."""

    id: str
    path: Path
    status: Status
    text: str
    """Empty where it passed."""
    again: str
    """The command that runs it alone."""
    picture: Path | None
    seconds: float
    measured: Measured | None
    compares: bool = False
    """Whether it is a comparison of profiles, and no profile's own test."""
    profile: str | None = None
    """Whose test it is; None for a comparison, and for a file that cannot be used."""
    broken: tuple[tuple[str, str], ...] = ()
    """What does not hold, each expectation once: its place, and as it is written."""

    @property
    def good(self) -> bool:
        """Whether it is as it should be."""
        return self.status in ("passed", "xfailed")


FORM = TypeAdapter(Result)
"""As JSON."""


def result_of(
    claim: Claim,
    *,
    update: bool = False,
    failed: Path | None = None,
    before: Mapping[str, Measured] = NOTHING,
) -> Result:
    """Carry a test out: it passes, fails or is refused; whether that is expected is for pytest to say.

    Args:
        claim: The case and its expectations.
        update: Whether to store its golden episode.
        failed: The folder for the runs of failed tests; None keeps none.
        before: What was measured in other cases just now, by the case's name.
    """
    start = time.perf_counter()
    case = claim.case
    verdict: Verdict | None = None
    status: Status
    try:
        verdict = judged(claim, update=update, before=before)
        evidence = _kept_or_removed(claim, verdict, failed)
        status = "passed" if verdict.passed else "failed"
        text = "" if verdict.passed else failure_text(claim, verdict.failures, evidence)
    except InputError as error:
        status, text, evidence = "refused", str(error), NONE
    failures = verdict.failures if verdict else ()
    return Result(
        id=claim.id,
        path=from_here(claim.path) or claim.path,
        status=status,
        text=text,
        again=again(claim),
        picture=evidence.picture,
        seconds=time.perf_counter() - start,
        measured=verdict.measured if verdict else None,
        compares=isinstance(case, Across),
        profile=None if isinstance(case, Across) else case.profile_name,
        broken=tuple(dict.fromkeys((str(failure.where), failure.text) for failure in failures)),
    )


def refused(path: Path, text: str, profiles: Sequence[str] = ()) -> Result:
    """The result of a file that cannot be used.

    Args:
        path: The file.
        text: What is wrong with it.
        profiles: What was named instead of its matrix's profiles.
    """
    again = command(path, profiles=profiles)
    return Result(shown(path), from_here(path) or path, "refused", text, again, None, 0.0, None)


def lost(path: Path, name: str, text: str) -> Result:
    """The result of a test that came to no end.

    Args:
        path: Its file.
        name: The test's id.
        text: What ended it.
    """
    return Result(name, from_here(path) or path, "failed", text, command(path, name), None, 0.0, None)


def _kept_or_removed(claim: Claim, verdict: Verdict, failed: Path | None) -> Evidence:
    """The run of a test that fails and is not expected to; where one passes, an older run goes."""
    if failed and verdict.passed:
        removed(claim, failed)
    elif failed and not claim.markers.xfail:
        return kept(claim, failed)
    return NONE
