"""One call of pytest with a configuration of Comity's own, and what came of each test."""

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
    "PYTHONSAFEPATH": "1",  # a package of the current folder that is called as one of ours is not ours
}
"""What pytest and its workers read: nothing that the user set for another use of pytest."""

Note = Callable[[Result, int], None]
"""Is told of each result as it comes, with the number of tests that were collected."""


@dataclass
class Run:
    """A plugin of pytest that keeps what came of each test."""

    rootdir: Path
    """What node ids are relative to."""
    note: Note
    warn: Callable[[str], None]
    code: int = pytest.ExitCode.OK
    """Of pytest."""
    stopped: list[BaseException] = field(default_factory=list)
    """What Ctrl-C or SIGTERM raised."""
    _workers: Any = None
    """The plugin of xdist that has them; None without any."""
    _order: dict[str, int] | None = None
    """The place of each test that was collected, by its node id."""
    _found: dict[str, Result] = field(default_factory=dict)
    """By node id."""

    @property
    def results(self) -> list[Result]:
        """All results in the order of the tests; files that cannot be used come first."""
        order = self._order or {}
        return [self._found[node_id] for node_id in sorted(self._found, key=lambda each: order.get(each, -1))]

    @property
    def not_run(self) -> int | None:
        """The tests that were left when it ended; None where it ended before they were collected."""
        if self._order is None:
            return None
        return len(self._order.keys() - self._found.keys())

    def pytest_sessionstart(self, session: pytest.Session) -> None:
        """Refuse a wrong `-k` or `-m` here: workers would make an error of their own of it."""
        mark: Any = session.config.pluginmanager.get_plugin("mark")
        mark.pytest_collection_modifyitems(items=[], config=session.config)
        self._workers = session.config.pluginmanager.get_plugin("dsession")
        if self._workers:
            _hear_signals(hear=False)

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection(self) -> None:
        """Hear of Ctrl-C again: the workers have been started."""
        _hear_signals(hear=True)

    def pytest_keyboard_interrupt(self) -> None:
        """Let xdist end its workers at once, with what they have under way."""
        if self._workers and self._workers.nodemanager:
            self._workers.nodemanager.EXIT_TIMEOUT = 0.1  # [s]

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Keep the order of the tests."""
        self._collected([item.nodeid for item in session.items])

    @pytest.hookimpl(optionalhook=True)
    def pytest_xdist_node_collection_finished(self, ids: Sequence[str]) -> None:
        """The same where workers collect."""
        self._collected(ids)

    def _collected(self, ids: Sequence[str]) -> None:
        self._order = {node_id: place for place, node_id in enumerate(ids)}

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Keep a file that cannot be used."""
        if self.stopped:  # something on the way made another error of it
            raise KeyboardInterrupt
        if report.failed:
            crash = getattr(report.longrepr, "reprcrash", None)
            self._keep(report, refused(self.rootdir / report.nodeid, crash.message if crash else ""))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep what came of a test, also where its process was lost."""
        if self.stopped:
            raise KeyboardInterrupt
        if report.failed or report.when == "call":
            file, _, name = report.nodeid.partition("::")
            result = self._keep(report, lost(self.rootdir / file, name, report.longreprtext))
            self.note(result, len(self._order or ()))

    def _keep(self, report: pytest.CollectReport | pytest.TestReport, otherwise: Result) -> Result:
        """Keep what our plugin says of a report, or else this."""
        told: str | None = getattr(report, RESULT, None)
        result = FORM.validate_json(told) if told else otherwise
        before = self._found.get(report.nodeid)  # xdist may run the test of a lost process again
        if before is None or before.good:
            self._found[report.nodeid] = result
        return result

    def pytest_warning_recorded(self, warning_message: Any) -> None:
        """Pass a warning on to the user."""
        if issubclass(warning_message.category, pytest.PytestWarning):
            self.warn(str(warning_message.message))


def run(
    paths: Sequence[str],
    options: Sequence[str],
    *,
    note: Note,
    warn: Callable[[str], None],
) -> Run:
    """Let pytest run scenario tests, and nothing else that lies there.

    Args:
        paths: Absolute ones of folders and files, or `FILE::TEST`; at least one.
        options: More options of pytest.
        note: Is told of each result as it comes, with the number of tests.
        warn: Is told of warnings.
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
    """The folder below which pytest looks: the current one, or one that holds all that was named."""
    if all(path.is_relative_to(Path.cwd()) for path in paths):
        return Path.cwd()
    return Path(os.path.commonpath([path if path.is_dir() else path.parent for path in paths]))


def _cache_folder() -> Path:
    """Where pytest keeps which tests of the current folder failed last."""
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
    """Let Ctrl-C and SIGTERM come, or wait: workers that are started while they wait never hear of them.

    It is this process that ends its workers, and they say nothing of it. Windows knows no such thing.
    """
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK if hear else signal.SIG_BLOCK, STOPS)


@contextmanager
def _interruptible(stopped: list[BaseException]) -> Iterator[None]:
    """Ctrl-C and SIGTERM as `KeyboardInterrupt`: of everything else pytest makes a failure.

    Args:
        stopped: What the program's own handlers raise, to be raised once pytest has ended.
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
