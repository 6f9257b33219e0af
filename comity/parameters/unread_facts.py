"""Notes on a person's facts that no rule reads: every profile works with every rulebook."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TYPE_CHECKING

from comity.parameters.perception import WORDS_READ, hint_of, is_read
from comity.parameters.used import ADDRESS, reads_languages, used_facts

if TYPE_CHECKING:
    from comity_fis import Rulebook

TYPO = 0.8
"""Similarity of two names, in [0, 1], above which one may be a typo of the other. Our choice: `mobility` does
not match `familiarity`."""


def notes_of_unread_facts(told: Mapping[str, object], rulebook: Rulebook) -> tuple[str, ...]:
    """A note that names all facts which no enabled rule reads.

    Args:
        told: Facts by key of the profile; None is unknown.
        rulebook: The rulebook.
    """
    unread = unread_facts(told, rulebook)
    if not unread:
        return ()
    near = (get_close_matches(name, rulebook.facts - {name}, n=1, cutoff=TYPO) for name in unread)
    meant = "".join(f" Did you mean {names[0]!r}?" for names in near if names)
    it, changes = ("it", "it changes") if len(unread) == 1 else ("them", "they change")
    return (
        f"{', '.join(unread)}: no rule of {rulebook.name} that is on reads {it}, so that {changes} "
        f"nothing here.{meant}{hint_of(unread)}",
    )


def notes_for_a_run(told: Mapping[str, object], rulebook: Rulebook) -> tuple[str, ...]:
    """The note without names of facts: a run stores only profile data that a rule or setting used.

    It always lists the words with an effect for hearing and sight, so as not to reveal who stated any.
    """
    count = len(unread_facts(told, rulebook))
    facts = "fact of the profile is" if count == 1 else "facts of the profile are"
    if not count:
        return ()
    return (f"{count} {facts} read by no rule here, and not kept in the run.{hint_of(WORDS_READ)}",)


def unread_facts(told: Mapping[str, object], rulebook: Rulebook) -> list[str]:
    """Names of the known facts that no enabled rule reads.

    Missing hearing or sight, and the form of address, are read without rules.
    """
    read = {*used_facts(rulebook), ADDRESS}
    read |= {"languages"} if reads_languages(rulebook) else set()
    return [
        name
        for name, fact in told.items()
        if fact is not None and name not in read and not is_read(name, fact)
    ]
