"""One call of pytest with Comity's own configuration, and the result of each test."""

from __future__ import annotations

import hashlib
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from platformdirs import user_cache_path

from comity.system.stopping import STOPS
from comity.testing.naming import RESULT
from comity.testing.runner.result import FORM, Result, lost, refused

CONFIGURATION = Path(__file__).with_name("pytest.ini")
_ENVIRONMENT = {
    "PYTEST_ADDOPTS": None,
    "PYTEST_PLUGINS": None,
    "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    "PYTHONSAFEPATH": "1",  # keeps packages in the current folder from shadowing ours
}
"""Environment of pytest and its workers; overrides the user's settings for other uses of pytest."""

Note = Callable[[Result, int], None]
"""Called with each result as it arrives, and the number of tests collected."""


@dataclass
class Run:
    """A pytest plugin that stores the result of each test."""

    rootdir: Path
    """Folder that node ids are relative to."""
    note: Note
    warn: Callable[[str], None]
    code: int = pytest.ExitCode.OK
    """Exit code of pytest."""
    stopped: list[BaseException] = field(default_factory=list)
    """Exceptions raised by Ctrl-C or SIGTERM."""
    _workers: Any = None
    """xdist's plugin with the workers; None without workers."""
    _order: dict[str, int] | None = None
    """Index of each collected test, by its node id."""
    _found: dict[str, Result] = field(default_factory=dict)
    """Results by node id."""

    @property
    def results(self) -> list[Result]:
        """All results in the order of the tests; unusable files come first."""
        order = self._order or {}
        return [self._found[node_id] for node_id in sorted(self._found, key=lambda each: order.get(each, -1))]

    @property
    def not_run(self) -> int | None:
        """Number of tests not run; None if the run ended before they were collected."""
        if self._order is None:
            return None
        return len(self._order.keys() - self._found.keys())

    def pytest_sessionstart(self, session: pytest.Session) -> None:
        """Refuse an invalid `-k` or `-m` here: in workers it would become an internal error."""
        mark: Any = session.config.pluginmanager.get_plugin("mark")
        mark.pytest_collection_modifyitems(items=[], config=session.config)
        self._workers = session.config.pluginmanager.get_plugin("dsession")
        if self._workers:
            _hear_signals(hear=False)

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection(self) -> None:
        """Handle Ctrl-C again: the workers have been started."""
        _hear_signals(hear=True)

    def pytest_keyboard_interrupt(self) -> None:
        """Have xdist end its workers at once, with their running tests."""
        if self._workers and self._workers.nodemanager:
            self._workers.nodemanager.EXIT_TIMEOUT = 0.1  # [s]

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Store the order of the tests."""
        self._collected([item.nodeid for item in session.items])

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self, ids: Sequence[str]) -> None:
        """Store the order of the tests collected by workers."""
        self._collected(ids)

    def _collected(self, ids: Sequence[str]) -> None:
        self._order = {node_id: place for place, node_id in enumerate(ids)}

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Store the result of a file that cannot be used."""
        if self.stopped:  # it was converted to another error on the way
            raise KeyboardInterrupt
        if report.failed:
            crash = getattr(report.longrepr, "reprcrash", None)
            self._keep(report, refused(self.rootdir / report.nodeid, crash.message if crash else ""))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Store the result of a test, also if its process was lost."""
        if self.stopped:
            raise KeyboardInterrupt
        if report.failed or report.when == "call":
            file, _, name = report.nodeid.partition("::")
            result = self._keep(report, lost(self.rootdir / file, name, report.longreprtext))
            self.note(result, len(self._order or ()))

    def _keep(self, report: pytest.CollectReport | pytest.TestReport, otherwise: Result) -> Result:
        """Store the plugin's result from a report, or else `otherwise`."""
        told: str | None = getattr(report, RESULT, None)
        result = FORM.validate_json(told) if told else otherwise
        before = self._found.get(report.nodeid)  # xdist may run the test of a lost process again
        if before is None or before.good:
            self._found[report.nodeid] = result
        return result

    def pytest_warning_recorded(self, warning_message: Any) -> None:
        """Forward a warning to the user."""
        if issubclass(warning_message.category, pytest.PytestWarning):
            self.warn(str(warning_message.message))


def run(
    paths: Sequence[str],
    options: Sequence[str],
    *,
    note: Note,
    warn: Callable[[str], None],
) -> Run:
    """Run scenario tests with pytest, and no other tests found there.

    Args:
        paths: Absolute paths of folders and files, or `FILE::TEST`; at least one.
        options: Further options of pytest.
        note: Called with each result as it arrives, and the number of tests.
        warn: Called with each warning.
    """
    rootdir = _root_of([Path(path.partition("::")[0]) for path in paths])
    ran = Run(rootdir, note, warn)
    words = [
        f"--config-file={CONFIGURATION}",
        f"--rootdir={rootdir}",
        f"--confcutdir={rootdir}",
        f"--override-ini=cache_dir={_cache_folder()}",
        *options,
        "--",
        *paths,
    ]
    with _environment(), _interruptible(ran.stopped):
        try:
            ran.code = pytest.main(words, plugins=[ran])
        except KeyboardInterrupt:
            if not ran.stopped:
                raise
        finally:
            _hear_signals(hear=True)
    return ran


def _root_of(paths: Sequence[Path]) -> Path:
    """Root folder of pytest: the current one, or a common parent of all named paths."""
    if all(path.is_relative_to(Path.cwd()) for path in paths):
        return Path.cwd()
    return Path(os.path.commonpath([path if path.is_dir() else path.parent for path in paths]))


def _cache_folder() -> Path:
    """Folder in which pytest stores the last failures of the current folder."""
    here = hashlib.sha256(os.fsencode(Path.cwd())).hexdigest()[:16]
    return Path(os.environ.get("COMITY_CACHE") or user_cache_path("comity")) / "tests" / here


@contextmanager
def _environment() -> Iterator[None]:
    before = {name: os.environ.get(name) for name in _ENVIRONMENT}
    _set(_ENVIRONMENT)
    try:
        yield
    finally:
        _set(before)


def _set(variables: dict[str, str | None]) -> None:
    for name, value in variables.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value


def _hear_signals(*, hear: bool) -> None:
    """Deliver or block Ctrl-C and SIGTERM: workers started while they are blocked never receive them.

    This process ends its workers, which print nothing about it. Windows cannot block signals.
    """
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK if hear else signal.SIG_BLOCK, STOPS)


@contextmanager
def _interruptible(stopped: list[BaseException]) -> Iterator[None]:
    """Raise `KeyboardInterrupt` for Ctrl-C and SIGTERM: pytest turns any other exception into a failure.

    Args:
        stopped: Exceptions raised by the program's own handlers, to be raised again after pytest.
    """
    handlers = {int(number): signal.getsignal(number) for number in STOPS}

    def stop(number: int, frame: FrameType | None) -> None:
        handler = handlers[number]
        assert callable(handler)
        try:
            handler(number, frame)
        except BaseException as error:
            stopped.append(error)
            raise KeyboardInterrupt from None

    for number, handler in handlers.items():
        if callable(handler):
            signal.signal(number, stop)
    try:
        yield
    finally:
        for number, handler in handlers.items():
            if callable(handler):
                signal.signal(number, handler)
