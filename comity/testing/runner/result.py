"""What came of a test, in a form that crosses to another process."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from traceback import format_exception
from typing import TYPE_CHECKING, Literal

from comity.testing.collection.cases import shown
from comity.testing.judging.measured import Measured
from comity.testing.judging.verdict import NOTHING, Verdict, judged
from comity.testing.runner.evidence import NONE, kept, removed
from comity.testing.runner.known import Known, key_of
from comity.testing.runner.telling import again, command, failure_text
from comity.testing.trials.case import Across
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim

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


def known_or_result(
    claim: Claim, known: Known, *, failed: Path | None = None, before: Mapping[str, Measured] = NOTHING
) -> Result:
    """The result of a test, which is known where it passed before and all that it depends on is the same.

    Args:
        claim: The case and its expectations.
        known: The tests that passed before.
        failed: The folder for the runs of failed tests; None keeps none.
        before: What was measured in other cases just now, by the case's name.
    """
    start = time.perf_counter()
    try:
        key = key_of(claim)
    except InputError:
        return result_of(claim, failed=failed, before=before)
    if passed := known.recall(key):
        if failed:
            removed(claim, failed)
        took = time.perf_counter() - start
        return _result(claim, "passed", took, passed.measured)
    result = result_of(claim, failed=failed, before=before)
    note(claim, result, known)
    return result


def note(claim: Claim, result: Result, known: Known) -> None:
    """Keep it in mind where a test has passed; not where what it depends on was removed meanwhile."""
    if result.status == "passed":
        with suppress(InputError):
            known.keep(key_of(claim), result.measured)


def result_of(
    claim: Claim,
    *,
    update: bool = False,
    failed: Path | None = None,
    before: Mapping[str, Measured] = NOTHING,
) -> Result:
    """Carry a test out.

    Args:
        claim: The case and its expectations.
        update: Whether to store its golden episode.
        failed: The folder for the runs of failed tests; None keeps none.
        before: What was measured in other cases just now, by the case's name.
    """
    start = time.perf_counter()
    picture: Path | None = None
    found: Measured | None = None
    broken: tuple[tuple[str, str], ...] = ()
    status: Status
    try:
        verdict = judged(claim, update=update, before=before)
        status, text, picture = _account(claim, verdict, failed)
        found = verdict.measured
        broken = tuple(dict.fromkeys((str(failure.where), failure.text) for failure in verdict.failures))
    except InputError as error:
        status, text = "refused", str(error)
    except Exception as error:  # a defect of Comity: one test fails, the others go on
        status, text = "failed", f"{claim.id} came to no end:\n{''.join(format_exception(error))}"
    took = time.perf_counter() - start
    return _result(claim, status, took, found, text=text, picture=picture, broken=broken)


def _account(claim: Claim, verdict: Verdict, failed: Path | None) -> tuple[Status, str, Path | None]:
    """What a verdict comes to, in words, and the picture of a run that is kept."""
    reason = claim.markers.xfail
    if not verdict.passed:
        evidence = kept(claim, failed) if failed and not reason else NONE
        text = failure_text(claim, verdict.failures, evidence)
        return "xfailed" if reason else "failed", text, evidence.picture
    if failed:
        removed(claim, failed)
    if claim.must_fail:
        return "xpassed", f"{claim.id} passes, though it is marked to fail: {reason}", None
    return "passed", "", None


def _result(
    claim: Claim,
    status: Status,
    took_s: float,
    found: Measured | None,
    *,
    text: str = "",
    picture: Path | None = None,
    broken: tuple[tuple[str, str], ...] = (),
) -> Result:
    case = claim.case
    return Result(
        id=claim.id,
        path=claim.path,
        status=status,
        text=text,
        again=again(claim),
        picture=picture,
        seconds=took_s,
        measured=found,
        compares=isinstance(case, Across),
        profile=None if isinstance(case, Across) else case.profile_name,
        broken=broken,
    )


def unread(files: Mapping[Path, InputError], profiles: Sequence[str] = ()) -> Iterator[Result]:
    """The results of files that cannot be used: the others are tested all the same."""
    for path, error in files.items():
        again = command(path, profiles=profiles)
        yield Result(shown(path), path, "refused", str(error), again, None, 0.0, None)
