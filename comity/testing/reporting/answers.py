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
    """By person, target and actual distance [m]."""
    text: str
    """Failed expectations and their causes; empty if all hold."""
    picture: str | None
    again: str
    """The command that runs it alone."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TriedAnswer(Record):
    """What came of one profile's tests."""

    profile: str
    tests: int
    """All tests run with this profile, whether or not other profiles were tried in these cases."""
    failed: int


@dataclass(frozen=True, slots=True, kw_only=True)
class ServedAnswer(TriedAnswer):
    """How one profile was served: its tests and failures are all, the rest is over `shared_cases`."""

    served: float
    """Share of the people to visit who were served, in [0, 1]."""
    time_s: float | None
    """Mean simulated time [s]. Like intrusion and detour, over the tests in which no other profile had more
    people served, and at least one was. Null without such tests."""
    distance_error_m: float | None
    """Mean absolute difference between actual and target distance [m]."""
    intrusion_s: float | None
    """Mean of the longest intrusion in each episode [s]."""
    detour_m: float | None
    """Mean path length beyond the straight lines between stops [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BrokenAnswer(Record):
    """An expectation that does not hold."""

    file: str
    where: str
    """File and line, as in failures."""
    expectation: str
    profiles: tuple[str, ...]
    """Profiles for which it fails; empty for a comparison of profiles."""
    failed: int
    """Number of tests in which it fails."""
    tests: int
    """Number of tests of its file; for a comparison, the number of comparisons."""


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
    """Parameters that differ because a person asked for it; such a difference is no unfairness."""
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
    """Number of tests not run when `-x` or Ctrl-C ended the run; null if it ended before the first."""
    seconds: float
    tests: tuple[TestAnswer, ...]
    broken: tuple[BrokenAnswer, ...]
    """Failed expectations by profile, each once."""
    profiles: tuple[ServedAnswer, ...]
    """The largest set of profiles tried in one case; of equally large sets, the most frequent."""
    shared_cases: int
    """Number of cases that all `profiles` were tried in; the means cover these."""
    other_cases: int
    """Number of measured cases that the means leave out."""
    other_profiles: tuple[TriedAnswer, ...]
    """Profiles that share no case with all `profiles`."""
    unexplained: tuple[UnexplainedAnswer, ...] | None
    """With `--fairness`."""
    asked_for: tuple[UnexplainedAnswer, ...] | None
    """With `--fairness`: differences due to people's own settings; not counted as failures."""
    not_compared: int | None
    """With `--fairness`: number of tests not measured, or without another profile in their case."""
