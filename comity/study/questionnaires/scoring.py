"""Subscale scores: the mean of the answers, with reversed items inverted."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np

from comity.output.csv_text import csv_text
from comity.study.questionnaires.answers_table import AnswersTable
from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
from comity.study.questionnaires.reliability import Reliability, reliability_of
from comity.study.report.resampling import Floats

SCORES_MARK = b"questionnaire,participant,condition,"
"""Beginning of a table of scores."""


@dataclass(frozen=True, slots=True)
class SubscaleScores:
    """Scores of one subscale for all sheets."""

    name: str
    items: tuple[str, ...]
    needed: int
    """Minimum number of answers on a sheet for a score."""
    answered: tuple[int, ...]
    """Number of answers on each sheet."""
    scores: tuple[float | None, ...]
    """Score of each sheet; None if too few items were answered."""
    reliability: Reliability

    @property
    def mean(self) -> float | None:
        """Mean of all scores; None without any."""
        there = [one for one in self.scores if one is not None]
        return sum(there) / len(there) if there else None


def scored(questionnaire: QuestionnaireFile, table: AnswersTable) -> tuple[SubscaleScores, ...]:
    """The scores of each subscale.

    A score is the mean of the answered items if these are at least the required share of the subscale's
    items: a missing answer counts as the mean of that person's other answers (the half rule of Fairclough and
    Cella, "Functional Assessment of Cancer Therapy (FACT-G): non-response to individual questions", Quality
    of Life Research 5(3), 1996). There is no total score over subscales.
    """
    matrix = keyed_answers(questionnaire, table)
    places = {item: i for i, item in enumerate(questionnaire.items)}
    participants = np.array([one.participant for one in table.sheets])
    found = []
    for name, items in questionnaire.subscales.items():
        block = matrix[:, [places[item] for item in items]]
        needed = ceil(round(questionnaire.answered_at_least * len(items), 9))
        answered = (~np.isnan(block)).sum(axis=1).tolist()
        means = (
            float(np.nanmean(row)) if count >= needed else None
            for row, count in zip(block, answered, strict=True)
        )
        reliability = reliability_of(block, participants)
        found.append(SubscaleScores(name, items, needed, tuple(answered), tuple(means), reliability))
    return tuple(found)


def keyed_answers(questionnaire: QuestionnaireFile, table: AnswersTable) -> Floats:
    """Array (sheets, items) with reversed items inverted; NaN for missing answers."""
    return np.array(
        [
            [
                questionnaire.keyed(item, sheet.answers[item]) if item in sheet.answers else np.nan
                for item in questionnaire.items
            ]
            for sheet in table.sheets
        ]
    )


def scores_csv(
    questionnaire: QuestionnaireFile, table: AnswersTable, found: tuple[SubscaleScores, ...]
) -> str:
    """CSV with a row for each participant and condition: subscale scores and numbers of answered items."""
    columns = [name for one in found for name in (one.name, f"{one.name}_answered")]
    rows = []
    for i, sheet in enumerate(table.sheets):
        cells = [cell for one in found for cell in (_text(one.scores[i]), one.answered[i])]
        rows.append((questionnaire.name, sheet.participant, sheet.condition, *cells))
    return csv_text(("questionnaire", "participant", "condition", *columns), rows)


def _text(score: float | None) -> str:
    return "" if score is None else f"{score:.6g}"
