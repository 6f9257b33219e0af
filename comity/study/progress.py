"""Progress of a study, derived from its journal and its lock, so it is correct even after SIGKILL."""

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
    """The progress of an unfinished study."""

    folder: Path
    file: str
    """Path of the study's file, from its account."""
    ended: int
    """Number of different episodes in the journal."""
    episodes: int
    """Number of different episodes of the study."""
    is_running: bool
    """Whether a command on this machine writes to the folder now; otherwise it was stopped or killed."""

    @property
    def state(self) -> str:
        """State as text: `interrupted at 3 of 8 episodes`."""
        count = f"{self.ended} of {self.episodes} episodes"
        return f"running now, with {count}" if self.is_running else f"interrupted at {count}"

    @property
    def remedy(self) -> str:
        """How to run the rest."""
        if self.is_running:
            return "Wait until `comity study run` has ended."
        command = shlex.join(["comity", "study", "run", self.file, "--out", str(self.folder)])
        return f"To go on from there: {command}"


def progress_of(folder: Path) -> StudyProgress | None:
    """Progress of the study in a folder; None if it is done, or there is none.

    The journal is authoritative: a killed command leaves its account as it was at the start.
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
