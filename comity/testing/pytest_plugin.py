"""The pytest plugin: collects `*.scenario.yaml`, one test for each case.

It is loaded by every pytest that runs beside Comity, so everything else is imported when there is a scenario.
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
"""What pytest-xdist calls the first of its processes, all of which collect everything."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Four options, all of which a project can do without."""
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
    """Make the marker of slow scenarios known."""
    config.addinivalue_line("markers", "slow: a scenario that its file marks as slow")


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Take over scenario files, and nothing else."""
    if file_path.name.endswith(SUFFIX):
        return ScenarioTests.from_parent(parent, path=file_path)
    return None


@pytest.hookimpl(optionalhook=True)  # known since pytest 8
def pytest_collect_directory(path: Path, parent: pytest.Collector) -> None:
    """Warn of golden episodes whose scenario is not there; it is pytest that looks into the folder."""
    if path.name.endswith(GOLDEN) and _is_first(parent.config):
        from comity.testing.collection.cases import shown
        from comity.testing.golden.place import abandoned, told_abandoned

        for folder in abandoned([path]):
            parent.warn(pytest.PytestCollectionWarning(told_abandoned(folder, shown(folder))))


def _is_first(config: pytest.Config) -> bool:
    """Of several processes, all of which collect the same, one does the warning."""
    worker: str = getattr(config, "workerinput", {"workerid": FIRST_WORKER})["workerid"]
    return worker == FIRST_WORKER


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Let the report of a file that cannot be used hold its result."""
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
    """Let the report of a test hold its result: with xdist, another process tells of it."""
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
        """What is tried instead of its matrix's profiles."""
        self.measured: dict[str, Measured] = {}
        """What its cases came to so far, by their names: comparisons need no second episode."""

    def collect(self) -> Iterator[pytest.Item]:
        """Its tests, or the first thing in it that cannot be used."""
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
            # As pytest reads it back, or `--lf` finds nobody: since 9.2 it parts a name from its brackets.
            node_id = f"{self.nodeid}::{claim.id}"
            yield ScenarioTest.from_parent(self, name=claim.id, nodeid=node_id, claim=claim)

    def _warn_of_left_over(self, claims: Sequence[Claim]) -> None:
        """Say which golden episodes beside the file hold nothing any more."""
        from comity.testing.golden.place import left_over
        from comity.testing.runner.telling import left_over_text
        from comity.testing.trials.case import Case

        for path in left_over(claim.case for claim in claims if isinstance(claim.case, Case)):
            self.warn(pytest.PytestWarning(left_over_text(path)))


class UnmetError(Exception):
    """Expectations that do not hold, in words."""


class RefusedError(Exception):
    """Bad input that was found when a test was carried out, in words."""


class ScenarioTest(pytest.Item):
    """One case."""

    parent: ScenarioTests

    def __init__(self, *, claim: Claim, **others: Any) -> None:
        super().__init__(**others)
        self._claim = claim
        self.result: Result | None = None
        """What came of it; None before it has ended."""
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

        with suppress(InputError):  # it is the result that says so
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
        """Sentences for what does not hold and for bad input; a traceback for everything else."""
        if isinstance(excinfo.value, UnmetError | RefusedError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """The place of the expectations."""
        return self.path, self._claim.line - 1, self.name
