"""Cultures in a study without a score in a rulebook's table: often a typo, but never an error."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from comity.parameters.standing import standing
from comity.people.profile import declared_by

if TYPE_CHECKING:
    from datetime import date

    from comity_fis import Rulebook


def unscored_notes(
    people: Iterable[tuple[str, Mapping[str, Any], date | None]], books: Collection[Rulebook]
) -> tuple[str, ...]:
    """A note for each culture and table, with the first of the people who has it.

    Args:
        people: Name, profile as plain values, and date for dated facts of each person.
        books: The rulebooks of the study.
    """
    found: dict[str, str] = {}
    seen: set[str] = set()
    for called, profile, day in people:
        if (culture := repr((profile.get("culture"), profile.get("region"), day))) in seen:
            continue
        seen.add(culture)
        for one in declared_by(profile, called=called).profile.cultures(day):
            for book in books:
                for note in standing(one, book).notes:
                    found.setdefault(note, called)
    return tuple(f"{called}: {note}" for note, called in found.items())
