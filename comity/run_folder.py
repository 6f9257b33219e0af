"""The folder of one run: what is in it, when it is created, and what is never overwritten."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import BaseModel, ValidationError

from comity_fis import InputError, Where

if TYPE_CHECKING:
    from typing import TypeVar

    Answer = TypeVar("Answer", bound=BaseModel)

RUN = "run.json"
SCENARIO = "scenario.yaml"
PLAN = "plan.json"
TRACE = "trace.jsonl"
FRAMES = "frames.csv"
READINGS = "readings.csv"
PICTURE = "picture.png"
ANIMATION = "episode.gif"
REPLAY = "replay.html"
COMPARISON = "comparison.html"


@dataclass(frozen=True, slots=True)
class RunFolder:
    """A folder that belongs to one run."""

    path: Path

    def __truediv__(self, name: str) -> Path:
        return self.path / name

    def write(self, name: str, content: str | BaseModel) -> None:
        """Write one file whole or not at all."""
        text = (
            content if isinstance(content, str) else content.model_dump_json(indent=2, by_alias=True) + "\n"
        )
        part = self.path / f".{name}.part"
        part.write_text(text, encoding="utf-8")
        part.replace(self.path / name)

    def digest(self) -> str | None:
        """Of the trace that the run ended with; None where it did not end."""
        account = json.loads((self / RUN).read_text(encoding="utf-8"))
        digest = account.get("trace_sha256")
        return digest if account.get("status") == "done" and isinstance(digest, str) else None

    def files(self) -> tuple[str, ...]:
        """What the run has written so far."""
        return tuple(
            name
            for name in (RUN, SCENARIO, PLAN, TRACE, FRAMES, READINGS, PICTURE, ANIMATION, REPLAY, COMPARISON)
            if (self / name).is_file()
        )


def place_for(out: Path | None, scenario: str) -> Path:
    """Where a run will go; nothing is created yet.

    Args:
        out: The folder that the user named; None for the next free `runs/<scenario>-<n>`.
        scenario: The scenario's name.

    Raises:
        InputError: if the user's folder holds something that is no run.
    """
    if out is None:
        return _next_free(scenario)
    with _refusing(out):
        _check(out)
    return out


def _check(out: Path) -> None:
    if out.exists() and not out.is_dir():
        raise _refusal(out, "a file", "Name a folder, new or empty.")
    if out.is_dir() and any(out.iterdir()) and not is_run(out):
        raise _refusal(
            out, "a folder with other things in it", "Name a new or an empty folder: nothing is overwritten."
        )


@contextmanager
def claimed(path: Path, *, new: bool) -> Iterator[RunFolder]:
    """Create the folder, or empty it of the run that it holds, and keep every other run out of it.

    Args:
        path: The folder.
        new: Whether it must not exist yet.

    Raises:
        FileExistsError: if it must not exist and does: another run was quicker.
        InputError: if another run writes to it now, or the system does not let us.
    """
    with _refusing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.mkdir(exist_ok=not new)
        handle = os.open(path, os.O_RDONLY)
    try:
        with _refusing(path):
            _lock(handle, path)
            folder = RunFolder(path)
            for name in folder.files():
                (folder / name).unlink()
            if not os.access(path, os.W_OK):
                raise PermissionError(13, "no permission to write here")
        yield folder
    finally:
        os.close(handle)


def _lock(handle: int, path: Path) -> None:
    """The system's own lock on the folder: it ends with the process, however that ends."""
    from fcntl import LOCK_EX, LOCK_NB, flock

    try:
        flock(handle, LOCK_EX | LOCK_NB)
    except BlockingIOError:
        raise _refusal(
            path, "a folder that another run writes to now", "Wait for it, or name another."
        ) from None


@contextmanager
def _refusing(path: Path) -> Iterator[None]:
    """Make the system's refusals errors that say what to do."""
    try:
        yield
    except FileExistsError:
        raise
    except OSError as error:
        raise _refusal(path, error.strerror or str(error), "Name a folder that you may write to.") from None


def is_run(path: Path) -> bool:
    """Whether a folder holds a run of ours."""
    try:
        return "trace_sha256" in json.loads((path / RUN).read_text(encoding="utf-8"))
    except (OSError, ValueError, TypeError):
        return False


def open_run(path: Path) -> RunFolder:
    """The folder of a run that exists.

    Raises:
        InputError: if there is none.
    """
    if not is_run(path):
        got = "a file" if path.is_file() else "no such folder"
        if path.is_dir():
            got = "a folder whose run.json is damaged" if (path / RUN).exists() else "a folder without one"
        raise InputError(
            expected="the folder of a run, with its run.json",
            got=got,
            remedy="`comity run` writes one and names it.",
            where=Where(str(path)),
        )
    return RunFolder(path)


def read_answer(path: Path, model: type[Answer]) -> Answer:
    """One of a run's JSON files.

    Raises:
        InputError: if it is missing or damaged.
    """
    try:
        return model.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as error:
        raise damaged(path, error) from None


def damaged(path: Path, error: Exception) -> InputError:
    """A complaint about a file of a run that cannot be read."""
    reason = error.strerror if isinstance(error, OSError) else "something else"
    if isinstance(error, ValidationError):
        first = error.errors()[0]
        reason = f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    return InputError(
        expected=f"the {path.name} of a run",
        got=reason or str(error),
        remedy="Run the scenario again.",
        where=Where(str(path)),
    )


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
