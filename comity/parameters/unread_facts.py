"""Facts of a person that no rule reads: a profile works with every rulebook, and a note names them."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TYPE_CHECKING

from comity.parameters.perception import WORDS_READ, hint_of, is_read
from comity.parameters.used import ADDRESS, reads_languages, used_facts

if TYPE_CHECKING:
    from comity_fis import Rulebook

TYPO = 0.8
"""Similarity of two names, in [0, 1], from which one may be a typo of the other. Our choice, such that
`mobility` is none of `familiarity`."""


def notes_of_unread_facts(told: Mapping[str, object], rulebook: Rulebook) -> tuple[str, ...]:
    """A note that names all facts which no rule that is on reads.

    Args:
        told: By a profile's keys; None is not disclosed.
        rulebook: The rules.
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
    """The same without names: a run keeps of a profile only what a rule or a wish used.

    Which words count for hearing and sight is said to everybody, lest it tell who said something of them.
    """
    count = len(unread_facts(told, rulebook))
    facts = "fact of the profile is" if count == 1 else "facts of the profile are"
    if not count:
        return ()
    return (f"{count} {facts} read by no rule here, and not kept in the run.{hint_of(WORDS_READ)}",)


def unread_facts(told: Mapping[str, object], rulebook: Rulebook) -> list[str]:
    """The names of the facts that are disclosed and that no rule which is on reads.

    That a person does not hear or see, and how they want to be addressed, is read without rules.
    """
    read = {*used_facts(rulebook), ADDRESS}
    read |= {"languages"} if reads_languages(rulebook) else set()
    return [
        name
        for name, fact in told.items()
        if fact is not None and name not in read and not is_read(name, fact)
    ]
