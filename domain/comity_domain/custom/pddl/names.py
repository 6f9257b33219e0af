"""What may be a name, and that each is given once."""

from __future__ import annotations

from collections.abc import Iterable

from comity_domain.custom.pddl.form import Item, Word, complaint

MOST_NAMES = 3_000
"""Objects, or types, or actions: unified-planning looks each new one up among all others."""


def each_once(words: Iterable[Word], what: str) -> None:
    """Refuse a name that is declared twice, and more names than can be read in seconds.

    Raises:
        InputError: at the second one, or the first one too many.
    """
    seen: dict[str, Word] = {}
    for word in words:
        if len(seen) == MOST_NAMES:
            raise complaint(
                word.where, f"at most {MOST_NAMES} {what}s", "more", "Leave out what no plan needs."
            )
        if word.text in seen:
            raise complaint(
                word.where,
                f"each {what} once",
                f"'{word}' again (first at {seen[word.text].where})",
                "Remove or rename one of them.",
            )
        seen[word.text] = word


NOT_NAMES = frozenset(
    [
        "and",
        "or",
        "not",
        "imply",
        "exists",
        "forall",
        "when",
        "either",
        "assign",
        "increase",
        "decrease",
        "scale-up",
        "scale-down",
        "define",
        "preference",
    ]
)
"""Words of the language itself, which no predicate, function or action may bear."""


def an(noun: str) -> str:
    """A noun with its article."""
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def name_of(item: Item, what: str) -> Word:
    """A word that can name something.

    Raises:
        InputError: if it is none.
    """
    if isinstance(item, Word) and item.is_name and (item.text not in NOT_NAMES):
        return item
    raise complaint(
        item.where, f"the name of {an(what)}", f"'{item}'", "Use a plain word that PDDL does not use."
    )
