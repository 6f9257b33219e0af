"""The shape of `comity test --json`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class TestAnswer(Record):
    """One test."""

    __test__ = False  # not a class of tests

    id: str
    file: str
    status: Literal["passed", "failed", "xfailed", "xpassed", "refused"]
    profile: str | None
    """Null for a comparison of profiles."""
    seed: int | None
    outcome: str | None
    """Null where there was no plan, and for a comparison."""
    simulated_s: float | None
    distances_m: Mapping[str, tuple[float, float | None]]
    """By person, wanted and reached."""
    text: str
    """What does not hold, and why; empty where all of it does."""
    picture: str | None
    again: str
    """The command that runs it alone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TriedAnswer(Record):
    """What came of one profile's tests."""

    profile: str
    tests: int
    """All that were run with it, whether or not others were tried there."""
    failed: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ServedAnswer(TriedAnswer):
    """How one profile was served: its tests and failures are all, the rest is over `shared_cases`."""

    served: float
    """The share of those who were to be visited."""
    time_s: float | None
    """Mean, simulated; as intrusion and detour over the tests in which nobody else's profile had more people
    served, at least one. Null where there is none."""
    distance_error_m: float | None
    """Mean of reached against wanted, without its sign."""
    intrusion_s: float | None
    """Mean of the longest in each episode."""
    detour_m: float | None
    """Mean way beyond the straight lines from stop to stop."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BrokenAnswer(Record):
    """An expectation that does not hold."""

    file: str
    where: str
    """File and line, as failures have it."""
    expectation: str
    profiles: tuple[str, ...]
    """For whom; empty for a comparison of profiles."""
    failed: int
    """The tests in which it does not hold."""
    tests: int
    """Those of its file; of an expectation that compares, its comparisons."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnexplainedAnswer(Record):
    """A difference between two profiles that no parameter explains."""

    scenario: str
    case: str
    """The tests' id without the profile."""
    what: str
    unit: str
    profiles: tuple[str, str]
    values: tuple[float, float]
    settings: tuple[str, ...] = ()
    """Parameters that differ because a person asked for it: then it is no unfairness."""
    because: str
    """Why nothing explains it."""
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class TestsAnswer(Record):
    """`comity test --json`."""

    __test__ = False

    passed: int
    failed: int
    xfailed: int
    xpassed: int
    refused: int
    not_run: int | None
    """Tests that were left when `-x` or Ctrl-C ended it; null where it ended before the first."""
    seconds: float
    tests: tuple[TestAnswer, ...]
    broken: tuple[BrokenAnswer, ...]
    """What does not hold, and for whom: each expectation once."""
    profiles: tuple[ServedAnswer, ...]
    """The most that were tried in one case; of as many, those that were so most often."""
    shared_cases: int
    """Cases that all `profiles` were tried in: the means are over these."""
    other_cases: int
    """Measured cases that the means leave out."""
    other_profiles: tuple[TriedAnswer, ...]
    """Those that share no case with all `profiles`."""
    unexplained: tuple[UnexplainedAnswer, ...] | None
    """With `--fairness`."""
    asked_for: tuple[UnexplainedAnswer, ...] | None
    """With `--fairness`: what people's own settings are behind; not counted as a failure."""
    not_compared: int | None
    """With `--fairness`: tests that were not measured, or no other profile in their case."""
