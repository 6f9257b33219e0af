"""Replay of a row's episode from the study's file, with its page."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from comity.answers.study_report import StudyShowAnswer
from comity.output.run_folder import REPLAY
from comity.study.folder import ACCOUNT, WRITTEN
from comity.study.report.answering import study_name
from comity.study.report.episodes import require_rows
from comity.study.statement import STATEMENT
from comity.study.study_plan import load_study
from comity.study.tasks import task_of
from comity.study.worker import installation, prepared_of
from comity.system.own_files import make_folder, read_regular
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.study.results import Study
    from comity.study.study_plan import StudyCell, StudyPlan

PAGE_ALONE: tuple[Literal["page"], ...] = ("page",)
EPISODES = "episodes"
"""Folder of replayed episodes, inside the study's."""


@dataclass(frozen=True, slots=True)
class RowReplayer:
    """A study whose rows can be replayed."""

    study: Study
    plan: StudyPlan

    @classmethod
    def of(cls, study: Study, file: Path) -> RowReplayer:
        """Create with the file that the study was run from, and the files next to it.

        Raises:
            InputError: if the file is missing, or cannot be read.
        """
        return cls(study, plan_of(study, file))

    def play(self, number: int, out: Path) -> StudyShowAnswer:
        """Run a row's episode again, into a run folder with its page.

        Args:
            number: Number of the row, from 1.
            out: The run folder.

        Raises:
            InputError: for a row that is not in the table, or whose episode is no longer in the study's file.
            PlanningFailed: if no plan was found, as when the study ran.
        """
        from comity.recording import record

        row = self._row(number)
        cell = self._cell(row)
        installed = installation()
        prepared = prepared_of(task_of(self.plan, cell, installed))
        recorded = record(prepared, seed=cell.seed, out=out, views=PAGE_ALONE)
        digest = recorded.episode.trace_sha256
        is_same_input = row["key"] == cell.key(installed.code, installed.fingerprint)
        return StudyShowAnswer(
            study=study_name(self.study),
            statement=STATEMENT,
            row=number,
            episode=str(recorded.folder.path),
            page=str(recorded.folder / REPLAY),
            outcome=recorded.episode.outcome,
            trace_sha256=digest,
            same=digest == row["trace_sha256"],
            differs=None if is_same_input else _differs(row, installed.code, installed.fingerprint),
        )

    def _row(self, number: int) -> Mapping[str, str]:
        require_rows(self.study)
        rows = self.study.rows
        if not 1 <= number <= len(rows):
            raise InputError(
                expected=f"a row from 1 to {len(rows)}",
                got=str(number),
                remedy="The column `row` of results.csv counts them.",
                where=Where("--row"),
            )
        return rows[number - 1]

    def _cell(self, row: Mapping[str, str]) -> StudyCell:
        """The episode of a row: its scenario, condition, seed and individual."""
        same = {one["key"]: one for one in self.study.rows if one["individual"]}
        individual = row["individual"] or same.get(row["key"], row)["individual"]
        for cell in self.plan.cells():
            named = "" if cell.individual is None else cell.individual.name
            said = (cell.scenario, str(cell.condition.number), str(cell.seed), named)
            if said == (row["scenario"], row["condition"], row["seed"], individual):
                return cell
        raise InputError(
            expected="the file that the study was run from",
            got=f"one without the episode of row {row['row']}",
            remedy="It was changed since. Name an older one with --study, or run the study again.",
            where=Where(str(self.plan.file.path)),
        )


def _differs(row: Mapping[str, str], code: str, fingerprint: str) -> str:
    if not code.startswith(row["code"]):
        return f"the code of Comity: {row['code']} then, {code[: len(row['code'])]} now"
    if fingerprint != row["fingerprint"]:
        return f"the platform: {row['fingerprint']} then, {fingerprint} now"
    return "the study's file, its population, a scenario or a rulebook: changed since it was run"


def plan_of(study: Study, file: Path) -> StudyPlan:
    """The plan of a study, from the file that it was run from.

    Raises:
        InputError: if the file is missing, or cannot be read.
    """
    if not file.is_file():
        raise InputError(
            expected="the file that the study was run from, beside its population and scenarios",
            got=f"no such file: {file}",
            remedy="Name it: --study FILE. The copy in the study's folder has no population beside it.",
            where=Where(str(study.path)),
        )
    return load_study(file)


def file_of(study: Study) -> Path:
    """The file that a study was run from, according to its account; otherwise the copy in its folder."""
    try:
        return Path(json.loads(read_regular(study.path / ACCOUNT))["file"])
    except (OSError, ValueError, TypeError, KeyError):
        return study.path / WRITTEN


def played_first(study: Study, file: Path, rows: Sequence[int], most: int, out: Path) -> dict[int, str]:
    """Pages by row: the first rows are replayed; pages of other rows are used if they exist.

    Args:
        study: The study.
        file: Its file; read only if an episode is replayed.
        rows: Rows of ended episodes.
        most: Maximum number of rows to replay.
        out: The folder of the report, which the returned paths are relative to.

    Raises:
        InputError: if the file no longer has these episodes.
    """
    first = rows[:most]
    replayer = RowReplayer.of(study, file) if first else None
    for folder in (out, out / EPISODES) if first else ():
        make_folder(folder, private=True)
    pages = {}
    for number in rows:
        folder = out / EPISODES / f"row-{number}"
        if replayer is not None and number in first:
            replayer.play(number, folder)
        if (folder / REPLAY).is_file():
            pages[number] = f"{EPISODES}/{folder.name}/{REPLAY}"
    return pages
