"""Wordings and their facts, as text for people and as answers for programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from comity.answers.wording import WordingAnswer
from comity.report.text import table, words

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity_executor import Wording


def wording_answers(wordings: Iterable[Wording]) -> tuple[WordingAnswer, ...]:
    """Each with its facts."""
    return tuple(
        WordingAnswer(
            use=one.use,
            language=one.language,
            script=one.script,
            register=one.register,
            occasion=one.occasion,
            text=one.text,
            latin=one.latin,
            reviewed_by=one.reviewed_by,
            reviewed_on=one.reviewed_on,
        )
        for one in wordings
    )


def review_text(one: WordingAnswer) -> str:
    """Who reviewed a wording and when, or that nobody has."""
    return f"{one.reviewed_by}, {one.reviewed_on}" if one.reviewed_by else "not reviewed"


def wordings_text(wordings: Iterable[WordingAnswer]) -> Iterator[RenderableType]:
    """A table of wordings and their facts."""
    rows = [
        (
            words(one.use),
            one.language,
            one.register + (", first meeting only" if one.occasion else ""),
            " = ".join(filter(None, (one.text, one.latin))),
            review_text(one),
        )
        for one in wordings
    ]
    if rows:
        yield "\nWhat the robot says, {name} being how the person is addressed"
        yield table(rows, head=("to", "language", "register", "words", "reviewed by"))


def unreviewed_text(wordings: Iterable[WordingAnswer]) -> str:
    """In which languages something was said that nobody has reviewed; empty where all was, or was plain."""
    said = {one.language for one in wordings if one.reviewed_by is None and one.register != "plain"}
    return (
        f"  Words that nobody who speaks the language has reviewed: {', '.join(sorted(said))}" if said else ""
    )
