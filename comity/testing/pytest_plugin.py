"""The pytest plugin: collects `*.scenario.yaml`, one test for each case.

It is loaded by every pytest that runs beside Comity, so everything else is imported when there is a scenario.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from comity.testing.naming import GOLDEN, SUFFIX

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim
    from comity.testing.judging.verdict import Failure

FIRST_WORKER = "gw0"
"""What pytest-xdist calls the first of its processes, all of which collect everything."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Two options, both of which a project can do without."""
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


class ScenarioTests(pytest.File):
    """A scenario file."""

    def collect(self) -> Iterator[pytest.Item]:
        """Its tests, or the first thing in it that cannot be used."""
        from comity.testing.collection.cases import claims_in
        from comity_fis import InputError

        try:
            claims = claims_in(self.path)
        except InputError as error:
            raise self.CollectError(str(error)) from None
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

        if _is_first(self.config):
            cases = (claim.case for claim in claims if isinstance(claim.case, Case))
            for path in left_over(cases):
                self.warn(pytest.PytestWarning(left_over_text(path, "`pytest --comity-update`")))


class UnmetError(Exception):
    """Expectations that do not hold, in words."""


class ScenarioTest(pytest.Item):
    """One case."""

    def __init__(self, *, claim: Claim, **others: Any) -> None:
        super().__init__(**others)
        self._claim = claim
        markers = claim.markers
        if markers.slow:
            self.add_marker("slow")
        if markers.xfail:
            xfail = pytest.mark.xfail(reason=markers.xfail, strict=claim.must_fail, raises=UnmetError)
            self.add_marker(xfail)

    def runtest(self) -> None:
        """Run the episode and judge it."""
        from comity.testing.judging.verdict import judged
        from comity.testing.runner.evidence import removed

        self.user_properties += self._claim.case.properties()
        verdict = judged(self._claim, update=bool(self.config.getoption("comity_update")))
        if verdict.measured:
            self.user_properties += verdict.measured.properties()
        folder = str(self.config.getoption("comity_failed"))
        if not verdict.passed:
            raise UnmetError(self._told(verdict.failures, folder))
        if folder:
            removed(self._claim, Path(folder))

    def _told(self, failures: tuple[Failure, ...], folder: str) -> str:
        from comity.testing.runner.evidence import NONE, kept
        from comity.testing.runner.telling import failure_text

        expected_to = self._claim.markers.xfail is not None
        evidence = kept(self._claim, Path(folder)) if folder and not expected_to else NONE
        return failure_text(self._claim, failures, evidence)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Sentences for what does not hold and for bad input; a traceback for everything else."""
        from comity_fis import InputError

        if isinstance(excinfo.value, UnmetError | InputError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        """The place of the expectations."""
        return self.path, self._claim.line - 1, self.name
