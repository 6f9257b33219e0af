"""Answers to a questionnaire in a CSV file: a row per answer, or per answer sheet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from comity.study.questionnaires.questionnaire_file import OWN_COLUMNS, QuestionnaireFile
from comity_fis import closest
from comity_fis.validation.csv_table import CsvTable, Row, read_csv, short

MISSING = ("", "NA")
"""Cells of unanswered items; R writes NA."""
MOST_ROWS, MOST_SHEETS = 1_000_000, 10_000


@dataclass(frozen=True, slots=True)
class AnswerSheet:
    """The answers of one participant under one condition."""

    participant: str
    condition: str
    """Condition; empty if the table has none."""
    answers: dict[str, float] = field(default_factory=dict)
    """Raw answers by item; unanswered items are missing."""


@dataclass(frozen=True, slots=True)
class AnswersTable:
    """All sheets of a file in their order."""

    file: str
    sheets: tuple[AnswerSheet, ...]
    unused: tuple[str, ...]
    """Headings that are neither items nor otherwise known."""

    @property
    def conditions(self) -> tuple[str, ...]:
        """Conditions in order of appearance; empty if the table has none."""
        return tuple(dict.fromkeys(one.condition for one in self.sheets if one.condition))

    @property
    def participants(self) -> tuple[str, ...]:
        """Participants in order of appearance."""
        return tuple(dict.fromkeys(one.participant for one in self.sheets))


def read_answers(path: Path, questionnaire: QuestionnaireFile) -> AnswersTable:
    """The answers of a file, each checked against the scale of its item.

    With the columns `item` and `answer`, each row is one answer, as `comity study collect` writes them, and
    rows of other questionnaires are skipped. Otherwise each row is an answer sheet, with a column per item.

    Raises:
        InputError: with file and line, for anything that cannot be used.
    """
    with read_csv(path, (*OWN_COLUMNS, *questionnaire.items)) as table:
        reader = _AnswerReader(table, questionnaire)
        sheets = reader.sheets()
        unused = tuple(one for one in table.heading if one and one not in reader.used)
        if not sheets:
            raise table.refusal(
                f"answers to {questionnaire.name}", "none", "Add rows below the headings.", table.line
            )
    return AnswersTable(table.file, sheets, unused)


class _AnswerReader:
    """Reads one table for one questionnaire."""

    def __init__(self, table: CsvTable, questionnaire: QuestionnaireFile) -> None:
        self._table = table
        self._asked = questionnaire
        self._found: dict[tuple[str, str], AnswerSheet] = {}
        self._lines: dict[tuple[str, str, str], int] = {}
        self._is_long = {"item", "answer"} <= set(table.heading)
        self.used = (*OWN_COLUMNS, *(() if self._is_long else questionnaire.items))
        self._require_headings()

    def sheets(self) -> tuple[AnswerSheet, ...]:
        for count, row in enumerate(self._table.rows):
            if count == MOST_ROWS or len(self._found) > MOST_SHEETS:
                most = f"at most {MOST_ROWS} rows, of {MOST_SHEETS} sheets"
                raise self._table.refusal(most, "more", "Split the file.", row.line)
            if self._cell(row, "questionnaire") in ("", self._asked.name):
                self._take(row)
        return tuple(self._found.values())

    def _require_headings(self) -> None:
        table = self._table
        if twice := {one for one in self.used if table.heading.count(one) > 1}:
            raise table.refusal("each heading once", f"{min(twice)!r} again", "Remove one.", table.line)
        needed = ("participant",) if self._is_long else ("participant", *self._asked.items)
        missing = [one for one in needed if one not in table.heading]
        if missing:
            near = [one for one in table.heading if one not in self.used]
            raise table.refusal(
                f"a column {missing[0]!r}" + ("" if missing[0] == "participant" else " for the item"),
                "none",
                f"{closest(missing[0], near)} Or write a row for each answer, with the columns participant, "
                "condition, item and answer.",
                table.line,
            )

    def _take(self, row: Row) -> None:
        participant, condition = self._cell(row, "participant"), self._cell(row, "condition")
        if not participant:
            raise self._table.refusal(
                "a participant", "an empty cell", "Write the code, such as P07.", row.line
            )
        for item, cell in self._cells(row):
            self._require_once(row, participant, condition, item)
            sheet = self._found.setdefault((participant, condition), AnswerSheet(participant, condition))
            if cell not in MISSING:
                sheet.answers[item] = self._answer(row, item, cell)

    def _cells(self, row: Row) -> Iterator[tuple[str, str]]:
        """Items and cells of a row."""
        if not self._is_long:
            yield from ((item, self._cell(row, item)) for item in self._asked.items)
            return
        item = self._cell(row, "item")
        if item not in self._asked.items:
            raise self._table.refusal(
                f"an item of {self._asked.name}", short(item), closest(item, self._asked.items), row.line
            )
        yield item, self._cell(row, "answer")

    def _require_once(self, row: Row, participant: str, condition: str, item: str) -> None:
        key = (participant, condition, item)
        if key in self._lines:
            under = f" under {condition}" if condition else ""
            raise self._table.refusal(
                "each answer once",
                f"{participant}'s to {item}{under} again, after line {self._lines[key]}",
                "Remove one of the two, or name the conditions apart.",
                row.line,
            )
        self._lines[key] = row.line

    def _answer(self, row: Row, item: str, cell: str) -> float:
        scale = self._asked.scale_of(item)
        expected = f"a whole number from {scale} for {item}, or an empty cell"
        answer = self._table.number(cell, row.line, expected)
        if not scale.holds(answer):
            raise self._table.refusal(expected, short(cell), "Correct the cell.", row.line)
        return answer

    def _cell(self, row: Row, name: str) -> str:
        return row.cell(self._table.heading.index(name)) if name in self._table.heading else ""
