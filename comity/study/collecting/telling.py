"""Text and JSON output about a session."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal

from comity.answers.study_with_people import StudyCollectAnswer
from comity.report.text import unbroken
from comity.study.collecting.collected import ANSWERS, DISTANCES
from comity.study.collecting.session import Collector
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from rich.console import RenderableType


def collect_answer(
    collector: Collector, status: Literal["done", "stopped", "refused", "withdrawn"], written: int
) -> StudyCollectAnswer:
    """How a session ended.

    Args:
        collector: The session.
        status: How it ended.
        written: Number of answers written or, if the participant withdrew, deleted.
    """
    paths = [collector.folder / name for name in (ANSWERS, DISTANCES)]
    return StudyCollectAnswer(
        study=collector.collection.written.name,
        participant=collector.session.participant,
        group=collector.session.group,
        conditions=collector.session.conditions,
        status=status,
        written=written,
        left=len(collector.left()),
        files=tuple(str(path) for path in paths if path.exists()),
    )


def collect_text(answer: StudyCollectAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    who, answers = answer.participant, counted(answer.written, "answer")
    yield {
        "done": f"{who}: done, {answers} written",
        "stopped": f"{who}: {answers} written, {answer.left} left; the same command goes on",
        "refused": f"{who} did not agree: nothing was stored",
        "withdrawn": f"{who} withdrew: {answers} deleted",
    }[answer.status]
    if answer.status != "refused":
        for file in answer.files:
            yield unbroken(f"  {file}")
