"""The result of a test, in a form that can be sent to another process."""

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
"""`xfailed`: it failed as its file requires; `xpassed`: it passed although it must fail, which is a
failure."""


@dataclass(frozen=True, slots=True)
class Result:
    """The result of one test."""

    id: str
    path: Path
    status: Status
    text: str
    """The failure; empty if it passed."""
    again: str
    """The command that runs it alone."""
    picture: Path | None
    seconds: float
    measured: Measured | None
    compares: bool = False
    """Whether it is a comparison of profiles rather than a test of one profile."""
    profile: str | None = None
    """Profile of the test; None for a comparison, and for a file that cannot be used."""
    broken: tuple[tuple[str, str], ...] = ()
    """Failed expectations, each once: its position, and its text."""

    @property
    def good(self) -> bool:
        """Whether the result is as expected."""
        return self.status in ("passed", "xfailed")


FORM = TypeAdapter(Result)
"""Conversion to and from JSON."""


def result_of(
    claim: Claim,
    *,
    update: bool = False,
    failed: Path | None = None,
    before: Mapping[str, Measured] = NOTHING,
) -> Result:
    """Run a test: it passes, fails or is refused; pytest decides whether that is expected.

    Args:
        claim: The case and its expectations.
        update: Whether to store its golden episode.
        failed: The folder for the runs of failed tests; None keeps none.
        before: Results just measured in other cases, by the case's name.
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
        text: What is wrong with the file.
        profiles: Profiles named instead of its matrix's.
    """
    again = command(path, profiles=profiles)
    return Result(shown(path), from_here(path) or path, "refused", text, again, None, 0.0, None)


def lost(path: Path, name: str, text: str) -> Result:
    """The result of a test that did not finish.

    Args:
        path: Its file.
        name: The test's id.
        text: What ended the test.
    """
    return Result(name, from_here(path) or path, "failed", text, command(path, name), None, 0.0, None)


def _kept_or_removed(claim: Claim, verdict: Verdict, failed: Path | None) -> Evidence:
    """Store the run of a test that fails unexpectedly; remove an older run if it passes."""
    if failed and verdict.passed:
        removed(claim, failed)
    elif failed and not claim.markers.xfail:
        return kept(claim, failed)
    return NONE
