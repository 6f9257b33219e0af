"""What all tests share: the command line in an empty folder, and how Hypothesis searches.

Hypothesis never searches against the clock, and in CI with the same examples every time.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import typer.main
from hypothesis import settings
from terminal import signals_of_a_terminal

from comity.__main__ import main
from comity.people.consents import SCOPES, consents_of

settings.register_profile("comity", deadline=None, derandomize="CI" in os.environ)
settings.register_profile("study", deadline=None, max_examples=100)
settings.load_profile("comity")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--no-skips", action="store_true", help="a test that is skipped has failed")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Where everything can run, what a skipped test claims is not known to hold."""
    report = yield
    if report.skipped and not hasattr(report, "wasxfail") and item.config.getoption("--no-skips"):
        report.outcome, report.longrepr = "failed", f"skipped, which --no-skips forbids: {report.longrepr}"
    return report


@pytest.fixture(scope="session", autouse=True)
def _own_store(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A store and a cache of their own: what the developer keeps is none of the tests' business."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COMITY_HOME", str(tmp_path_factory.mktemp("kept")))
        patch.setenv("COMITY_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="session", autouse=True)
def _one_parser() -> Iterator[None]:
    """The parser of the command line is built once, not for every call."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(typer.main, "get_command", cache(typer.main.get_command))
        yield


@dataclass(frozen=True)
class Said:
    """What the command line answered."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)


Comity = Callable[..., Said]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def comity(
    here: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    request: pytest.FixtureRequest,
) -> Comity:
    """The `comity` command in an empty folder: `comity("run", "johanna", "--json")`.

    Everybody whom a test keeps agreed to everything, unless it is marked `nobody_agreed`.
    """
    agreed = request.node.get_closest_marker("nobody_agreed") is None

    def call(*words: object) -> Said:
        if words[:2] == ("profile", "set") and agreed and consents_of(str(words[2])) is None:
            run("profile", "consent", words[2], *SCOPES, "--by", "a_test", "--at", "2000-01-01")
        return run(*words)

    def run(*words: object) -> Said:
        monkeypatch.setattr(sys, "argv", ["comity", *map(str, words)])
        capsys.readouterr()
        try:
            with signals_of_a_terminal():
                main()
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
        out, err = capsys.readouterr()
        return Said(code, out, err)

    return call
