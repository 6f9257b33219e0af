"""One value of a person, explained: at once, or in each of several cultures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity.answers.explanation import ExplainAnswer, ExplainedPartAnswer
from comity.report.text import number, table, words
from comity.report.values.explanation import explain_text
from comity.report.values.explanation_answer import explain_answer
from comity.report.values.inference import inputs_answer, value_fields
from comity.report.values.wordings import wording_answers, wordings_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity_executor import Wording
    from comity_fis import Explanation, Inference, ParameterValue


@dataclass(frozen=True, slots=True)
class Explained:
    """A value with its explanation in every culture that makes a difference."""

    inference: Inference
    value: ParameterValue
    parts: tuple[tuple[str, float, Explanation], ...]
    """What each culture is called, its share, and the account; one without a name where there is one."""
    wordings: tuple[Wording, ...] = ()
    """Of a parameter of the words: what the robot says to such a person."""

    @property
    def alone(self) -> Explanation | None:
        """The explanation where there is one."""
        return self.parts[0][2] if len(self.parts) == 1 else None


def explained_answer(explained: Explained) -> ExplainAnswer:
    """The answer of `comity explain --json`."""
    notes, wordings = explained.inference.notes, wording_answers(explained.wordings)
    if explained.alone:
        return replace(explain_answer(explained.alone), notes=notes, wordings=wordings)
    return ExplainAnswer(
        **value_fields(explained.value),
        rulebook=explained.inference.rulebook,
        parameter=explained.value.name,
        inputs=inputs_answer(explained.inference.inputs),
        leading=(),
        rules=(),
        off=(),
        categories=(),
        reads=(),
        derivatives=(),
        alternatives=(),
        flips=(),
        without_setting=None,
        notes=notes,
        wordings=wordings,
        by_culture=tuple(
            ExplainedPartAnswer(name=name, share=share, explanation=explain_answer(part))
            for name, share, part in explained.parts
        ),
    )


def explained_text(explained: Explained) -> Iterator[RenderableType]:
    """The value and how it came about; with several cultures, then each by itself."""
    yield from (f"Note: {note}" for note in explained.inference.notes)
    yield from _explained(explained)
    yield from wordings_text(wording_answers(explained.wordings))


def _explained(explained: Explained) -> Iterator[RenderableType]:
    if explained.alone:
        yield from explain_text(explained.alone)
        return
    value = explained.value
    spread = f" (people vary by ± {number(value.spread, value.unit)})" if value.spread is not None else ""
    yield f"{words(value.name)}: {number(value.value, value.unit)}{spread}"
    yield from ([f"  {words(value.note)}"] if value.note else [])
    yield f"\nHow it came about, by the rulebook {explained.inference.rulebook}"
    yield table([(c.origin, number(c.value, value.unit), words(c.text)) for c in value.contributions])
    yield "\nWhat each culture alone would give"
    yield table(
        [
            (name, f"{share:.0%}", number(part.value.value, value.unit))
            for name, share, part in explained.parts
        ]
    )
    for name, share, part in explained.parts:
        yield f"\n{name} ({share:.0%})\n{'─' * (len(name) + 6)}"
        yield from explain_text(part)
