"""The verdict of a test: all its expectations, compared with what happened."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity.testing.collection.cases import shown
from comity.testing.expectation import Expectation, Finding, ProfileComparison
from comity.testing.golden.file import differences, store
from comity.testing.golden.place import place_of
from comity.testing.kinds.state import OUTCOME, State, judge_outcome
from comity.testing.measuring.compared_profiles import ComparedProfiles
from comity.testing.measuring.measured import Measured, measured
from comity.testing.trials.attempt import attempted
from comity.testing.trials.case import Across
from comity_domain import PlanningFailed
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.collection.cases import Claim
    from comity.testing.expectation import Written
    from comity.testing.trials.case import Case


NOTHING: Mapping[str, Measured] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Failure:
    """A failed expectation."""

    text: str
    where: Where
    finding: Finding


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict of a test."""

    failures: tuple[Failure, ...]
    measured: Measured | None = None
    """Results for reports; None for a comparison, and without a plan."""

    @property
    def passed(self) -> bool:
        """Whether all expectations hold."""
        return not self.failures


def judged(claim: Claim, *, update: bool = False, before: Mapping[str, Measured] = NOTHING) -> Verdict:
    """Run a test and judge it.

    Args:
        claim: The case and its expectations.
        update: Whether to store its golden episode instead of comparing with it.
        before: Results already measured in other cases, by the case's name, which comparisons reuse.

    Raises:
        InputError: if a sentence names something that the scenario does not have.
    """
    try:
        if isinstance(claim.case, Across):
            return Verdict(tuple(_compared(claim, ComparedProfiles(claim.case, before))))
        episode = attempted(claim.case)
    except PlanningFailed as failed:
        finding = Finding("a plan", failed.reason, (failed.remedy,))
        goals = claim.case.file.where("goals")
        return Verdict((Failure("everybody can be served", goals, finding),))
    failures = [*_failures(claim, episode), *_changed(claim.case, episode, update=update)]
    return Verdict(tuple(failures), measured(claim.case, episode))


def _compared(claim: Claim, compared: ComparedProfiles) -> Iterator[Failure]:
    for one in claim.expectations:
        assert isinstance(one.meaning, ProfileComparison)
        yield from _placed(one, one.meaning.compare(compared))


def _failures(claim: Claim, episode: Episode) -> Iterator[Failure]:
    for one in claim.expectations:
        assert isinstance(one.meaning, Expectation)
        yield from _placed(one, one.meaning.judge(episode))
    if not any(_about_outcome(one) for one in claim.expectations):
        for finding in judge_outcome(episode, "success"):
            yield Failure("outcome is success", claim.case.file.where("goals"), finding)


def _changed(case: Case, episode: Episode, *, update: bool) -> Iterator[Failure]:
    """Differences from the golden episode; or none, and the golden episode is written."""
    if update:
        store(case, episode)
        return
    for finding in differences(case, episode):
        yield Failure("as in the golden episode", Where(shown(place_of(case))), finding)


def _about_outcome(one: Written) -> bool:
    return isinstance(one.meaning, State) and one.meaning.subject == OUTCOME


def _placed(one: Written, findings: Iterator[Finding]) -> Iterator[Failure]:
    try:
        for finding in findings:
            yield Failure(one.text, one.where, finding)
    except InputError as error:
        raise error.at(one.where) from None
