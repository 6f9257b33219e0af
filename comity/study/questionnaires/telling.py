"""Text and JSON output about scores."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity.answers.study_with_people import SheetScoresAnswer, StudyScoreAnswer, SubscaleAnswer
from comity.report.text import number, table, unbroken
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.study.questionnaires.answers_table import AnswersTable
    from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
    from comity.study.questionnaires.scoring import SubscaleScores


def score_answer(
    questionnaire: QuestionnaireFile,
    answers: AnswersTable,
    found: tuple[SubscaleScores, ...],
    files: tuple[str, ...],
) -> StudyScoreAnswer:
    """All scores of a table of answers.

    Args:
        questionnaire: The questionnaire.
        answers: The scored answers.
        found: Scores of its subscales.
        files: Written files.
    """
    return StudyScoreAnswer(
        questionnaire=questionnaire.name,
        source=questionnaire.source,
        answers=answers.file,
        participants=len(answers.participants),
        conditions=answers.conditions,
        missing=sum(len(questionnaire.items) - len(sheet.answers) for sheet in answers.sheets),
        subscales=tuple(map(_subscale, found)),
        sheets=tuple(
            SheetScoresAnswer(
                participant=sheet.participant,
                condition=sheet.condition,
                scores=tuple(one.scores[i] for one in found),
                answered=tuple(one.answered[i] for one in found),
            )
            for i, sheet in enumerate(answers.sheets)
        ),
        unused=answers.unused,
        files=files,
    )


def _subscale(one: SubscaleScores) -> SubscaleAnswer:
    return SubscaleAnswer(
        subscale=one.name,
        items=one.items,
        needed=one.needed,
        scored=sum(score is not None for score in one.scores),
        mean=one.mean,
        alpha=one.reliability.alpha,
        alpha_low=one.reliability.low,
        alpha_high=one.reliability.high,
        sheets=one.reliability.sheets,
        participants=one.reliability.participants,
    )


HEAD = ("subscale", "items", "scored", "mean", "alpha", "95 % interval", "complete sheets")


def score_text(answer: StudyScoreAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    under = f", {counted(len(answer.conditions), 'condition')}" if answer.conditions else ""
    sheets = counted(len(answer.sheets), "sheet")
    yield (
        f"{answer.questionnaire}: {sheets} of {counted(answer.participants, 'participant')}{under}, "
        f"{counted(answer.missing, 'missing answer')}"
    )
    yield table([_row(one) for one in answer.subscales], head=HEAD)
    needed = ", ".join(f"{one.needed} of {len(one.items)} ({one.subscale})" for one in answer.subscales)
    yield f"  A score is the mean of the answered items, and needs {needed}."
    yield "  Alpha is taken from complete sheets; its interval resamples participants."
    for one in answer.subscales:
        if one.alpha is not None and one.alpha < 0:
            yield f"  Alpha of {one.subscale} is below 0: check which of its items are `reversed`."
    if answer.unused:
        yield f"  Columns that were not used: {', '.join(answer.unused)}"
    for file in answer.files:
        yield unbroken(f"Scores  {file}")


def _row(one: SubscaleAnswer) -> tuple[str, ...]:
    interval = "-" if one.alpha_low is None else f"{number(one.alpha_low)} to {number(one.alpha_high)}"
    complete = f"{one.sheets} of {counted(one.participants, 'participant')}"
    return (
        one.subscale,
        str(len(one.items)),
        str(one.scored),
        number(one.mean),
        number(one.alpha),
        interval,
        complete,
    )
