"""The folder of one run: its files, its creation, and protection against overwriting."""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from comity.system.locks import LOCK, is_locked, locked
from comity.system.own_files import PRIVATE_FOLDER, read_regular, written_whole
from comity_executor.tracing.file import parts_of
from comity_fis import InputError, Where
from comity_fis.record import Record, as_text, reader

Answer = TypeVar("Answer", bound=Record)

RUN = "run.json"
SCENARIO = "scenario.yaml"
PLAN = "plan.json"
TRACE = "trace.jsonl"
FRAMES = "frames.csv"
READINGS = "readings.csv"
BLACKBOARD = "blackboard.csv"
RECORDS = (RUN, SCENARIO, PLAN, TRACE, FRAMES, READINGS, BLACKBOARD)
"""The primary files of a run; all others are made from these."""
TABLES = "scores"
"""Subfolder of the score tables that the rulebook names."""
PICTURE = "picture.png"
ANIMATION = "episode.gif"
REPLAY = "replay.html"
COMPARISON = "comparison.html"

INTERRUPTED = "interrupted"
"""The error recorded for a run that was stopped with Ctrl-C or SIGTERM."""


@dataclass(frozen=True, slots=True)
class RunFolder:
    """The folder of one run."""

    path: Path

    def __truediv__(self, name: str) -> Path:
        return self.path / name

    def write(self, name: str, content: str | Record) -> None:
        """Write one file atomically."""
        text = content if isinstance(content, str) else as_text(content)
        (self / name).parent.mkdir(exist_ok=True, mode=PRIVATE_FOLDER)
        with written_whole(self / name, private=True) as part:
            part.write_text(text, encoding="utf-8", newline="\n")

    def read(self, name: str, model: type[Answer]) -> Answer:
        """Read one of the run's answers.

        Raises:
            InputError: It is missing or damaged.
        """
        try:
            return reader(model).validate_json(read_regular(self / name))
        except (OSError, ValidationError) as error:
            raise damaged(self / name, error) from None

    def is_open_to_others(self) -> bool:
        """Whether other users of the machine can list or change its content; they cannot read the files."""
        return os.name == "posix" and bool(stat.S_IMODE(self.path.stat().st_mode) & ~PRIVATE_FOLDER)

    def is_written_to(self) -> bool:
        """Whether its run is in progress."""
        return is_locked(self.path)

    def files(self) -> tuple[str, ...]:
        """Names of the files written so far."""
        tables = sorted(f"{TABLES}/{path.name}" for path in (self / TABLES).glob("*.csv"))
        parts = [path.name for path in parts_of(self / TRACE)[1:]]
        names = (*RECORDS, *parts, *tables, PICTURE, ANIMATION, REPLAY, COMPARISON)
        return tuple(name for name in names if (self / name).is_file())

    def bytes_per_minute(self, simulated_s: float) -> dict[str, int]:
        """Size of trace, readings and frames per simulated minute [bytes], by file.

        Args:
            simulated_s: Duration of the episode [s]; empty result for 0.
        """
        if simulated_s <= 0.0:
            return {}
        return {
            name: round(60.0 / simulated_s * sum(part.stat().st_size for part in parts_of(self / name)))
            for name in (TRACE, READINGS, FRAMES)
            if (self / name).is_file()
        }


def damaged(path: Path, error: Exception) -> InputError:
    """The error for a file of a run that cannot be read."""
    reason = error.strerror if isinstance(error, OSError) else str(error)
    if isinstance(error, FileNotFoundError):
        reason = "no such file"
    if isinstance(error, ValidationError):
        first = error.errors()[0]
        reason = f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    return InputError(
        expected=f"the {path.name} of a run",
        got=reason or str(error),
        remedy="Run the scenario again.",
        where=Where(str(path)),
    )


def place_for(out: Path | None, scenario: str) -> Path:
    """The folder for a new run; nothing is created yet.

    Args:
        out: The user's folder; None: the next free `runs/<scenario>-<n>`.
        scenario: Name of the scenario.

    Raises:
        InputError: The user's folder contains something other than a run.
    """
    if out is None:
        return _next_free(scenario)
    with _refusing(out):
        _check(out)
    return out


def _check(out: Path) -> None:
    if out.exists() and not out.is_dir():
        raise _refusal(out, "a file", "Name a folder, new or empty.")
    if out.is_dir() and any(path.name != LOCK for path in out.iterdir()) and not is_run(out):
        raise _refusal(
            out, "a folder with other things in it", "Name a new or an empty folder: nothing is overwritten."
        )


@contextmanager
def claimed(path: Path, *, new: bool) -> Iterator[RunFolder]:
    """Create the folder, or delete the run in it, and lock it against other runs.

    Args:
        path: The folder.
        new: Whether it must not exist yet.

    Raises:
        FileExistsError: It must not exist but does: another run was quicker.
        InputError: Another run is writing to it, or the system prevents it.
    """
    with _refusing(path):
        _make(path, new=new)
        if not os.access(path, os.W_OK):
            raise PermissionError(13, "no permission to write here")
    folder = RunFolder(path)
    with ExitStack() as held:
        with _refusing(path):
            held.enter_context(_locked(path))
            for name in folder.files():
                (folder / name).unlink()
            with suppress(OSError):
                (folder / TABLES).rmdir()
        yield folder


def _make(path: Path, *, new: bool) -> None:
    """Create the folder; only if `new` may another run have created it meanwhile."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True, mode=PRIVATE_FOLDER)
    except FileExistsError:
        raise NotADirectoryError(20, f"{path.parent} is a file") from None
    try:
        path.mkdir(exist_ok=not new, mode=PRIVATE_FOLDER)
    except FileExistsError:
        if new:
            raise
        raise NotADirectoryError(20, "something else of that name") from None


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Lock the folder against other runs."""
    from filelock import Timeout

    with ExitStack() as held:
        try:
            held.enter_context(locked(path, waits=False))
        except Timeout:
            raise _refusal(
                path, "a folder that another run writes to now", "Wait for it, or name another."
            ) from None
        yield


@contextmanager
def _refusing(path: Path) -> Iterator[None]:
    """Turn system errors into errors with a remedy."""
    try:
        yield
    except FileExistsError:
        raise
    except OSError as error:
        raise _refusal(path, error.strerror or str(error), "Name a folder that you may write to.") from None


def remove(path: Path) -> None:
    """Delete a run, and its folder if nothing else is in it; other files are kept.

    Raises:
        InputError: Another run is writing to it, or the system prevents it.
    """
    if path.is_symlink() or not is_run(path):
        return
    with claimed(path, new=False):
        pass  # the run itself is deleted by now
    with suppress(OSError):
        path.rmdir()


def is_run(path: Path) -> bool:
    """Whether a folder contains a run."""
    try:
        return "trace_sha256" in json.loads(read_regular(path / RUN))
    except (OSError, ValueError, TypeError):
        return False


def open_run(path: Path) -> RunFolder:
    """The folder of an existing run.

    Raises:
        InputError: There is none.
    """
    if not is_run(path):
        got = "a file" if path.is_file() else "no such folder"
        if path.is_dir():
            got = "a folder whose run.json is damaged" if (path / RUN).exists() else "a folder without one"
        raise InputError(
            expected="the folder of a run, with its run.json",
            got=got,
            remedy="`comity run` writes one and names it, of your own robot with `--robot MODULE:CLASS`.",
            where=Where(str(path)),
        )
    return RunFolder(path)


def _next_free(scenario: str) -> Path:
    slug = re.sub(r"[^\w.-]+", "-", scenario).strip("-.") or "run"
    runs = Path("runs")
    taken = {path.name for path in runs.iterdir()} if runs.is_dir() else set()
    n = 1
    while f"{slug}-{n}" in taken:
        n += 1
    return runs / f"{slug}-{n}"


def _refusal(path: Path, got: str, remedy: str) -> InputError:
    return InputError(expected="a folder for the run", got=got, remedy=remedy, where=Where(str(path)))
