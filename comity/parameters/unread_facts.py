"""Facts of a person that no rule can read: a profile works with every rulebook, and a note names them."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TYPE_CHECKING

from comity.parameters.consent import CONSENT

if TYPE_CHECKING:
    from comity_fis import Rulebook

TYPO = 0.8
"""Similarity of two names, in [0, 1], from which one may be a typo of the other. Our choice, such that
`mobility` is none of `familiarity`."""


def notes_of_unread_facts(told: Mapping[str, object], rulebook: Rulebook) -> tuple[str, ...]:
    """A note that names all facts which the rulebook has no variable for.

    Consent is not among them: it bars contact under every rulebook.

    Args:
        told: By a profile's keys; None is not disclosed.
        rulebook: The rules.
    """
    read = {*rulebook.facts, CONSENT} | ({"languages"} if "language" in rulebook.facts else set())
    unread = [name for name, fact in told.items() if fact is not None and name not in read]
    if not unread:
        return ()
    near = (get_close_matches(name, rulebook.facts, n=1, cutoff=TYPO) for name in unread)
    meant = "".join(f" Did you mean {names[0]!r}?" for names in near if names)
    it, changes = ("it", "it changes") if len(unread) == 1 else ("them", "they change")
    return (
        f"{', '.join(unread)}: the rulebook {rulebook.name} has no variable for {it}, so that {changes} "
        f"nothing here.{meant}",
    )
