"""The folder of a study: its files, its owner, and a lock for one writing command at a time."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from comity.system.locks import LOCK, locked
from comity.system.own_files import make_folder, read_regular, writing
from comity_fis import InputError, Where

RESULTS, PARQUET, DICTIONARY = "results.csv", "results.parquet", "dictionary.csv"
JOURNAL, ACCOUNT, WRITTEN = "journal.jsonl", "study.json", "study.yaml"


@contextmanager
def study_folder(path: Path, study: str) -> Iterator[Path]:
    """The folder, created if missing, and locked against other commands.

    Args:
        path: Path of the folder.
        study: Name of the study: the folder of another study is refused.

    Raises:
        InputError: if it contains something else, or another command writes to it.
    """
    from filelock import Timeout

    require_study_folder(path, study)
    make_folder(path, private=True)
    with ExitStack() as held:
        try:
            held.enter_context(locked(path, waits=False))
        except Timeout:
            raise _refusal(path, "one that is written to now", "Wait, or name another.") from None
        yield path


def require_study_folder(path: Path, study: str) -> None:
    """Refuse a folder with other content than this study, before any computation.

    Raises:
        InputError: if the folder contains something else.
    """
    with writing(path):
        if not path.exists():
            return
        if not path.is_dir():
            raise _refusal(path, "a file", "Name a folder, new or empty.")
        if all(one.name == LOCK for one in path.iterdir()):
            return
    try:
        found = json.loads(read_regular(path / ACCOUNT))["study"]
    except (OSError, ValueError, TypeError, KeyError):
        raise _refusal(
            path, "a folder with other things in it", "Name a new or an empty folder: nothing is overwritten."
        ) from None
    if found != study:
        raise _refusal(path, f"that of the study {found}", "Name another folder.")


def _refusal(path: Path, got: str, remedy: str) -> InputError:
    return InputError(expected="a folder for the study", got=got, remedy=remedy, where=Where(str(path)))
