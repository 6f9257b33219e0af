"""Result of the person's answer to the single question."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING

from comity.answers.profile import AskAnswer
from comity.report.text import number, unbroken, words
from comity.report.values.inference import settled

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.adaptation.asking import CountsAs, Question
    from comity_fis import ParameterValue


def ask_answer(
    question: Question, answer_m: float | None, counts_as: CountsAs | None, value: ParameterValue | None
) -> AskAnswer:
    """The answer of `comity profile ask --json`."""
    return AskAnswer(
        name=question.name,
        parameter="conversational_distance",
        answer_m=answer_m,
        counts_as=counts_as,
        at=question.day,
        situation=question.situation,
        value=settled(value) if value else None,
    )


def ask_text(
    question: Question, answer_m: float | None, counts_as: CountsAs | None, value: ParameterValue | None
) -> Iterator[RenderableType]:
    """The value from now on, and the resulting distance of the robot."""
    if counts_as is None or value is None:
        yield "Left open: nothing is changed."
        return
    if counts_as == "setting":
        yield _of_setting(question.name, answer_m)
    else:
        yield _of_observation(question, answer_m)
    yield f"{question.name} is met at {number(value.value, 'm', digits=2)} from now on:"
    for part in value.contributions:
        yield f"  {part.origin}  {number(part.value, 'm', digits=2)}  {words(part.text)}"
    if counts_as == "observation" and value.start.origin == "setting":
        yield unbroken(
            f"A wish goes before it. `comity profile set {question.name} "
            "settings.conversational_distance=unknown` takes the wish back."
        )


def _of_setting(name: str, answer_m: float | None) -> str:
    if answer_m is None:
        return f"{name} asks for no distance any more: it is left to the rules, and to what was learnt."
    return f"{name} asks for {answer_m:g} m, which goes before everything but safety."


def _of_observation(question: Question, answer_m: float | None) -> str:
    where = ", ".join(str(fact) for fact in question.situation.values())
    if answer_m is None:
        return f"What {question.name} said ({where}) is forgotten."
    later = " It counts from that day on." if question.day > date.today() else ""
    said = f"{question.name} likes {answer_m:g} m ({where}), as said on {question.day}"
    return f"{said}: one more observation.{later}"
