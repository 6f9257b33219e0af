"""How far a study is: derived from its journal and its lock, so also right after SIGKILL."""

from __future__ import annotations

import json
import shlex
from dataclasses import dataclass
from pathlib import Path

from comity.study.folder import ACCOUNT, JOURNAL
from comity.study.journal import read_journal
from comity.system.locks import is_locked
from comity.system.own_files import read_regular


@dataclass(frozen=True, slots=True)
class StudyProgress:
    """A study that is not done."""

    folder: Path
    file: str
    """The study's file, as its account has it."""
    ended: int
    """Different episodes that the journal holds."""
    episodes: int
    """Different episodes of the study."""
    is_running: bool
    """Whether a command on this machine writes to the folder now; else it was stopped or killed."""

    @property
    def state(self) -> str:
        """`interrupted at 3 of 8 episodes`."""
        count = f"{self.ended} of {self.episodes} episodes"
        return f"running now, with {count}" if self.is_running else f"interrupted at {count}"

    @property
    def remedy(self) -> str:
        """How the rest is carried out."""
        if self.is_running:
            return "Wait until `comity study run` has ended."
        command = shlex.join(["comity", "study", "run", self.file, "--out", str(self.folder)])
        return f"To go on from there: {command}"


def progress_of(folder: Path) -> StudyProgress | None:
    """How far the study in a folder is; None where it is done, or none is there.

    The journal counts: a command that was killed leaves its account as it was at the start.
    """
    try:
        account = json.loads(read_regular(folder / ACCOUNT))
        total, other = int(account["different"]), int(account["other"])
        if account["status"] == "done":
            return None
        file = str(account.get("file", "FILE"))
    except (OSError, ValueError, TypeError, KeyError):
        return None
    ended = len(read_journal(folder / JOURNAL).rows) - other
    return StudyProgress(folder, file, ended, total, is_locked(folder))
