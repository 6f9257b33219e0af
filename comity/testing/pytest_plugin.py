"""The pytest plugin: collects `*.scenario.yaml`, one test for each case.

Every pytest in an environment with Comity loads it, so other modules are imported only when there is a
scenario.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from comity.testing.naming import GOLDEN, RESULT, SUFFIX

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim
    from comity.testing.measuring.measured import Measured
    from comity.testing.runner.result import Result

FIRST_WORKER = "gw0"
"""Name of pytest-xdist's first process; all of them collect everything."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add four optional options."""
    group = parser.getgroup("comity", "scenario tests")
    group.addoption(
        "--comity-update", action="store_true", help="Store golden episodes instead of comparing with them."
    )
    group.addoption(
        "--comity-failed",
        metavar="DIR",
        default="runs/failed",
        help="Where the runs of failed scenario tests go, with a picture; empty: nowhere.",
    )
    group.addoption(
        "--comity-profile",
        metavar="P",
        action="append",
        default=[],
        help="Instead of the profiles of every matrix: a name, or a path from the current folder.",
    )
    group.addoption(
        "--comity-engine",
        metavar="NAME",
        default="comity",
        help="Who plans: comity, or an engine of unified-planning that is installed.",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker of slow scenarios."""
    config.addinivalue_line("markers", "slow: a scenario that its file marks as slow")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect scenario files, and nothing else."""
    if file_path.name.endswith(SUFFIX):
        return ScenarioTests.from_parent(parent, path=file_path)
    return None


@pytest.hookimpl(optionalhook=True)  # known since pytest 8
def pytest_collect_directory(path: Path, parent: pytest.Collector) -> None:
    """Warn of golden episodes whose scenario is missing; pytest itself collects the folder."""
    if path.name.endswith(GOLDEN) and _is_first(parent.config):
        from comity.testing.collection.cases import shown
        from comity.testing.golden.place import abandoned, told_abandoned

        for folder in abandoned([path]):
            parent.warn(pytest.PytestCollectionWarning(told_abandoned(folder, shown(folder))))


def _is_first(config: pytest.Config) -> bool:
    """Whether this process gives the warnings: all processes collect the same tests."""
    worker: str = getattr(config, "workerinput", {"workerid": FIRST_WORKER})["workerid"]
    return worker == FIRST_WORKER


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Add the result to the report of a file that cannot be used."""
    report = yield
    if isinstance(collector, ScenarioTests) and report.failed:
        from comity.testing.runner.result import FORM, refused

        result = refused(collector.path, report.longreprtext, collector.profiles)
        setattr(report, RESULT, FORM.dump_json(result).decode())
    return report


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item,
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Add the result to the report of a test: with xdist, another process prints it."""
    report = yield
    if isinstance(item, ScenarioTest) and report.when == "call" and item.result:
        from comity.testing.runner.result import FORM

        result = item.result
        if report.skipped:
            result = replace(result, status="xfailed")
        elif report.failed and result.good:
            result = replace(result, status="xpassed", text=report.longreprtext)
        setattr(report, RESULT, FORM.dump_json(result).decode())
    return report


class ScenarioTests(pytest.File):
    """A scenario file."""

    def __init__(self, **others: Any) -> None:
        super().__init__(**others)
        self.profiles: Sequence[str] = list(self.config.getoption("comity_profile") or ())
        """Profiles that replace those of its matrix."""
        self.measured: dict[str, Measured] = {}
        """Results of its cases so far, by name, so that comparisons need no second episode."""

    def collect(self) -> Iterator[pytest.Item]:
        """Its tests, or the first error in it."""
        from comity.testing.collection.cases import claims_in
        from comity_fis import InputError

        try:
            claims = claims_in(
                self.path, profiles=self.profiles, engine=str(self.config.getoption("comity_engine"))
            )
        except InputError as error:
            raise self.CollectError(str(error)) from None
        if _is_first(self.config) and not self.profiles:
            self._warn_of_left_over(claims)
        for claim in claims:
            # Written as pytest parses it, or `--lf` finds no test: since 9.2 it splits a name from its
            # brackets.
            node_id = f"{self.nodeid}::{claim.id}"
            yield ScenarioTest.from_parent(self, name=claim.id, nodeid=node_id, claim=claim)

    def _warn_of_left_over(self, claims: Sequence[Claim]) -> None:
        """Warn of golden episodes next to the file that belong to no case."""
        from comity.testing.golden.place import left_over
        from comity.testing.runner.telling import left_over_text
        from comity.testing.trials.case import Case

        for path in left_over(claim.case for claim in claims if isinstance(claim.case, Case)):
            self.warn(pytest.PytestWarning(left_over_text(path)))


class UnmetError(Exception):
    """Failed expectations, in words."""


class RefusedError(Exception):
    """Bad input found while running a test, in words."""


class ScenarioTest(pytest.Item):
    """One case."""

    parent: ScenarioTests

    def __init__(self, *, claim: Claim, **others: Any) -> None:
        super().__init__(**others)
        self._claim = claim
        self.result: Result | None = None
        """Its result; None before it has ended."""
        markers = claim.markers
        if markers.slow:
            self.add_marker("slow")
        if markers.xfail:
            xfail = pytest.mark.xfail(reason=markers.xfail, strict=claim.must_fail, raises=UnmetError)
            self.add_marker(xfail)

    def runtest(self) -> None:
        """Run the episode and judge it."""
        from comity.testing.runner.result import result_of
        from comity_fis import InputError

        with suppress(InputError):  # the result reports it
            self.user_properties += self._claim.case.properties()
        folder = str(self.config.getoption("comity_failed"))
        result = result_of(
            self._claim,
            update=bool(self.config.getoption("comity_update")),
            failed=Path(folder) if folder else None,
            before=self.parent.measured,
        )
        self.result = result
        if result.status == "refused":
            raise RefusedError(result.text)
        if result.measured:
            self.user_properties += result.measured.properties()
            self.parent.measured[result.id] = result.measured
        if not result.good:
            raise UnmetError(result.text)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Sentences for failed expectations and bad input; a traceback for everything else."""
        if isinstance(excinfo.value, UnmetError | RefusedError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """The position of the expectations in the file."""
        return self.path, self._claim.line - 1, self.name
