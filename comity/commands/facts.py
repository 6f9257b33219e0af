"""What `infer` and `explain` share: a profile, facts on the command line, and the answer to them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.commands.options import pairs
from comity.profile import Profile, load_profile
from comity.values import Facts, infer_for
from comity_fis import InputError, NominalVariable, Where, closest, explain, load_rulebook

if TYPE_CHECKING:
    from comity_fis import Explanation, Inference, Rulebook


@dataclass(frozen=True, slots=True)
class Known:
    """A person as the command line describes them, and the rulebook that is to judge."""

    rulebook: Rulebook
    profile: Profile
    facts: Facts
    """From `--set`; they go before the profile."""

    def infer(self, mode: str) -> Inference:
        """The rulebook's answer; an error says where the fault was written."""
        try:
            return infer_for(self.profile, self.rulebook, situation=self.facts, mode=mode)
        except InputError as error:
            raise error.at(Where("--set" if self.facts else self.profile.name)) from None


def infer_from_words(profile: str | None, words: Iterable[str], rulebook: str, mode: str) -> Inference:
    """A rulebook's answer for a profile (nothing disclosed when None) and `VARIABLE=VALUE` words."""
    return _known(profile, words, rulebook).infer(mode)


def explain_from_words(
    parameter: str, profile: str | None, words: Iterable[str], rulebook: str
) -> Explanation:
    """The explanation of one parameter, for the same."""
    known = _known(profile, words, rulebook)
    return explain(known.rulebook, known.infer("exact").inputs, parameter, settings=known.profile.settings)


def _known(profile: str | None, words: Iterable[str], rulebook: str) -> Known:
    book = load_rulebook(rulebook)
    person = load_profile(profile) if profile else Profile(name="nobody in particular")
    facts = {name: _fact(book, name, value) for name, value in pairs(words, "--set", "gender=female").items()}
    return Known(book, person, facts)


def _fact(book: Rulebook, name: str, value: str) -> str | float | None:
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
        return value if isinstance(variable, NominalVariable) else float(value)
    except ValueError:
        raise InputError(
            expected=f"a number for {name}",
            got=repr(value),
            remedy="Write for example 38.",
            where=Where("--set"),
        ) from None
