"""What `infer` and `explain` share: a profile, facts on the command line, and the answer to them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from comity.commands.options import pairs
from comity.profile import NOBODY, load_profile
from comity.values import infer_for
from comity_fis import InputError, Interval, NominalVariable, Where, closest, load_rulebook

if TYPE_CHECKING:
    from comity.values import Fact
    from comity_fis import Inference, Rulebook


def infer_from_words(profile: str | None, words: Iterable[str], rulebook: str, mode: str) -> Inference:
    """A rulebook's answer for a profile (nothing disclosed when None) and `VARIABLE=VALUE` words."""
    book = load_rulebook(rulebook)
    person = load_profile(profile) if profile else NOBODY
    facts = {name: _fact(book, name, value) for name, value in pairs(words, "--set", "gender=female").items()}
    try:
        return infer_for(person, book, situation=facts, mode=mode)
    except InputError as error:
        raise error.at(Where("--set")) from None


def _fact(book: Rulebook, name: str, value: str) -> Fact:
    variable = book.variables.get(name)
    if variable is None:
        raise InputError(
            expected=f"a variable of the rulebook {book.name}",
            got=repr(name),
            remedy=closest(name, book.variables),
            where=Where("--set"),
        )
    if value == "unknown":
        return None
    try:
        return value if isinstance(variable, NominalVariable) else _number(value)
    except ValueError:
        raise InputError(
            expected=f"a number for {name}",
            got=repr(value),
            remedy="Write for example 38, or 30..40 for anything between the two.",
            where=Where("--set"),
        ) from None


def _number(words: str) -> float | Interval:
    """`38`, or `30..40` where only that much is known.

    Raises:
        ValueError: if it is neither.
    """
    low, dots, high = words.partition("..")
    return Interval(float(low), float(high)) if dots else float(words)
