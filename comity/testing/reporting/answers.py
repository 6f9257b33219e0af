"""The shape of `comity test --json`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers import Answer


class TestAnswer(Answer):
    """One test."""

    __test__ = False  # not a class of tests

    id: str
    file: str
    status: Literal["passed", "failed", "xfailed", "xpassed", "refused"]
    profile: str | None = Field(description="Null for a comparison of profiles.")
    seed: int | None
    outcome: str | None = Field(description="Null where there was no plan, and for a comparison.")
    simulated_s: float | None
    distances_m: Mapping[str, tuple[float, float | None]] = Field(
        description="By person, wanted and reached."
    )
    text: str = Field(description="What does not hold, and why; empty where all of it does.")
    picture: str | None
    again: str = Field(description="The command that runs it alone.")


class TriedAnswer(Answer):
    """What came of one profile's tests."""

    profile: str
    tests: int = Field(description="All that were run with it, whether or not others were tried there.")
    failed: int


class ServedAnswer(TriedAnswer):
    """How one profile was served: its tests and failures are all, the rest is over `shared_cases`."""

    served: float = Field(description="The share of those who were to be visited.")
    time_s: float | None = Field(
        description="Mean, simulated; as intrusion and detour over the tests in which nobody else's profile "
        "had more people served, and somebody was. Null where there is none."
    )
    distance_error_m: float | None = Field(description="Mean of reached against wanted, without its sign.")
    intrusion_s: float | None = Field(description="Mean of the longest in each episode.")
    detour_m: float | None = Field(description="Mean way beyond the straight lines from stop to stop.")


class BrokenAnswer(Answer):
    """An expectation that does not hold."""

    file: str
    where: str = Field(description="File and line, as failures have it.")
    expectation: str
    profiles: tuple[str, ...] = Field(description="For whom; empty for a comparison of profiles.")
    failed: int = Field(description="The tests in which it does not hold.")
    tests: int = Field(description="Those of its file; of an expectation that compares, its comparisons.")


class UnexplainedAnswer(Answer):
    """A difference between two profiles that no parameter explains."""

    scenario: str
    case: str = Field(description="The tests' id without the profile.")
    what: str
    unit: str
    profiles: tuple[str, str]
    values: tuple[float, float]
    settings: tuple[str, ...] = Field(
        default=(),
        description="Parameters that differ because somebody asked for it: then it is no unfairness.",
    )
    because: str = Field(description="Why nothing explains it.")
    text: str


class TestsAnswer(Answer):
    """`comity test --json`."""

    __test__ = False

    passed: int
    failed: int
    xfailed: int
    xpassed: int
    refused: int
    not_run: int | None = Field(
        description="Tests that were left when `-x` or Ctrl-C ended it; null where it ended before the first."
    )
    seconds: float
    tests: tuple[TestAnswer, ...]
    broken: tuple[BrokenAnswer, ...] = Field(
        description="What does not hold, and for whom: each expectation once."
    )
    profiles: tuple[ServedAnswer, ...] = Field(
        description="The most that were tried in one case; of as many, those that were so most often."
    )
    shared_cases: int = Field(
        description="Cases that all `profiles` were tried in: the means are over these."
    )
    other_cases: int = Field(description="Measured cases that the means leave out.")
    other_profiles: tuple[TriedAnswer, ...] = Field(
        description="Those that share no case with all `profiles`."
    )
    unexplained: tuple[UnexplainedAnswer, ...] | None = Field(description="With `--fairness`.")
    asked_for: tuple[UnexplainedAnswer, ...] | None = Field(
        description="With `--fairness`: what people's own settings are behind; not counted as a failure."
    )
    not_compared: int | None = Field(
        description="With `--fairness`: tests that were not measured, or no other profile in their case."
    )
