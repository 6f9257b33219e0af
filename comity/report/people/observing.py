"""Recorded observations of people, and the resulting distance of the robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from comity.answers.profile import ObservationAnswer, ObserveAnswer
from comity.people.consents import was_covered
from comity.report.text import number, words
from comity.report.values.inference import settled
from comity_fis.learning.signals import SAID

if TYPE_CHECKING:
    from collections.abc import Iterable
    from datetime import date

    from rich.console import RenderableType

    from comity.people.learnt_file import Observation
    from comity_fis import ParameterValue

Named = tuple[str, "Observation"]


def observe_answer(
    observed: Iterable[Named], undone: Iterable[Named], values: Mapping[str, ParameterValue]
) -> ObserveAnswer:
    """The answer of `comity profile observe --json`.

    Args:
        observed: Recorded observations, each with the person.
        undone: Withdrawn observations.
        values: Values from now on, by person.
    """
    observed = tuple(observed)
    return ObserveAnswer(
        notes=tuple(_notes(observed)),
        observed=tuple(_row(name, seen) for name, seen in observed),
        undone=tuple(_row(name, seen) for name, seen in undone),
        values={name: settled(value) for name, value in values.items()},
    )


def _notes(observed: Iterable[Named]) -> Iterator[str]:
    """For each person, the days before they consented to learning from meetings."""
    early: dict[str, set[date]] = {}
    for name, seen in observed:
        if not was_covered(name, "learn", seen.day):
            early.setdefault(name, set()).add(seen.day)
    for name, days in early.items():
        first, more = min(days), len(days) - 1
        on = f"{first}{f' and {more} more days' if more > 1 else ' and 1 more day' if more else ''}"
        yield (
            f"{name} had not agreed to learn on {on}: keep it if they agree to that, too; "
            f"`comity profile observe {name} --undo` takes it back."
        )


def observe_text(answer: ObserveAnswer) -> Iterator[RenderableType]:
    """A line for each observation, statements and sightings separately, then each person's distance."""
    for row in answer.observed:
        yield f"{row.how.capitalize():5} {_line(row)}"
    for row in answer.undone:
        yield f"Undone: {row.how}, {_line(row)}"
    yield from (f"Note: {note}" for note in answer.notes)
    for name, value in answer.values.items():
        yield f"{name} is met at {number(value.value, 'm', digits=2)} from now on:"
        for part in value.contributions:
            yield f"  {part.origin}  {number(part.value, 'm', digits=2)}  {words(part.text)}"


def _line(row: ObservationAnswer) -> str:
    situation = ", ".join(str(fact) for fact in row.situation.values())
    return f"{row.name} {SAID[row.signal]} at {row.distance_m:.2f} m ({situation}; {row.day})"


def _row(name: str, seen: Observation) -> ObservationAnswer:
    return ObservationAnswer(
        name=name,
        day=seen.day,
        situation=seen.situation,
        signal=seen.signal,
        how=seen.how,
        distance_m=seen.distance_m,
        model_m=seen.model_m,
    )
