"""What `infer` and `explain` share: a profile, facts on the command line, and the answer to them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity.commands.options import pairs
from comity.parameters.acquaintance import learnt_here
from comity.parameters.own_words import in_the_rulebooks_case
from comity.parameters.unread import noting_unread
from comity.parameters.values import Fact, cases_of, infer_for
from comity.parameters.which_rulebook import which_rulebook
from comity.people.dated import UNKNOWN
from comity.people.profile import NOBODY, PERSONAL, Declared, day_for, load_profile
from comity.report.values.explained import Explained
from comity_domain.problem.bound_parameters import ABOUT_WORDS, GREETING_LANGUAGE
from comity_fis import InputError, Interval, NominalVariable, Where, closest, explain, load_rulebook
from comity_fis.validation.csv_table import NUMBER

if TYPE_CHECKING:
    from datetime import date

    from comity_executor import Wording
    from comity_fis import Inference, Learnt, Rulebook


@dataclass(frozen=True, slots=True)
class PersonFacts:
    """A person as the command line describes them, and the rulebook that is to judge."""

    rulebook: Rulebook
    declared: Declared
    facts: Mapping[str, Fact]
    """From `--set`; they go before the profile."""
    day: date | None
    """On which the facts are taken; None where none depends on it."""

    def infer(self, mode: str) -> Inference:
        """The rulebook's answer, with notes of what no action reads; an error names the place."""
        return noting_unread(self._inferred(mode), self.rulebook)

    def _inferred(self, mode: str) -> Inference:
        try:
            return infer_for(
                self.declared,
                self.rulebook,
                situation=self.facts,
                mode=mode,
                at=self.day,
                learnt=self.learnt,
            )
        except InputError as error:
            raise error.at(Where("--set")) from None

    @property
    def learnt(self) -> Mapping[str, Learnt]:
        """What meetings taught in the situation that `--set` tells; without it, in the usual one."""
        return learnt_here(self.declared, self.rulebook, self.facts, self.day)

    def explain(self, parameter: str) -> Explained:
        """One parameter, in each of the person's cultures."""
        inference = self._inferred("exact")
        cases = cases_of(self.declared, self.rulebook, situation=self.facts, at=self.day)
        accounts = [
            explain(self.rulebook, case.inputs, parameter, case.settings, self.learnt) for case in cases
        ]
        value, wordings = inference[parameter], _wordings(parameter, inference)
        if not value.parts:
            account = replace(accounts[0], value=value) if parameter == GREETING_LANGUAGE else accounts[0]
            return Explained(inference, value, (("", 1.0, account),), wordings)
        parts = [(part.name, part.share) for part in value.parts]
        named = zip(parts, accounts, strict=True)
        explained = tuple((name, share, account) for (name, share), account in named)
        return Explained(inference, value, explained, wordings)


def _wordings(parameter: str, inference: Inference) -> tuple[Wording, ...]:
    """What the robot says to such a person, where the parameter chooses words; none it has no words for."""
    if parameter not in ABOUT_WORDS:
        return ()
    from comity_executor import Speaker

    try:
        return Speaker().wordings_of(inference)
    except InputError:
        return ()  # a run refuses the rulebook


def told_in_words(
    profile: str | None, words: Iterable[str], rulebook: str | None, at: date | None = None
) -> PersonFacts:
    """A profile (nothing disclosed when None) with `VARIABLE=VALUE` words, and a rulebook.

    Args:
        profile: A shipped or stored name, or a file.
        words: What else is known.
        rulebook: A shipped name or a file; without it the right one for the person.
        at: The day of the facts.
    """
    person = load_profile(profile) if profile else NOBODY
    book = load_rulebook(rulebook or which_rulebook([person]).name)
    facts = {name: _fact(book, name, value) for name, value in pairs(words, "--set", "gender=female").items()}
    return PersonFacts(book, person, facts, day_for(at, person.profile))


def precise_facts_in_words(words: Iterable[str], book: Rulebook) -> dict[str, float | str]:
    """`VARIABLE=VALUE` words as facts that are known precisely.

    Raises:
        InputError: for an unknown variable, a value outside its domain, or a range of values.
    """
    told: dict[str, float | str] = {}
    for name, value in pairs(words, "--set", "gender=female").items():
        fact = _fact(book, name, value)
        if not isinstance(fact, float | str):
            raise InputError(
                expected=f"one value for {name}",
                got=repr(value),
                remedy="Leave it out: then it is varied.",
                where=Where("--set"),
            )
        try:
            if name in book.variables:
                told[name] = book.variables[name].check(fact)
        except InputError as error:
            raise error.at(Where("--set")) from None
    return told


def _fact(book: Rulebook, name: str, value: str) -> Fact:
    variable = book.variables.get(name)
    if variable is None and name in {*PERSONAL, *book.facts}:
        return None if value == UNKNOWN else value
    if variable is None:
        is_output = name in book.parameters
        raise InputError(
            expected=f"a variable of the rulebook {book.name}",
            got=f"{name!r}, a parameter: the rules decide it" if is_output else repr(name),
            remedy=f"What a person asked for is a wish in their profile: `settings: {{{name}: {value}}}`."
            if is_output
            else closest(name, book.variables),
            where=Where("--set"),
        )
    if value == UNKNOWN:
        return None
    if name == "culture" and value[:1] in ("{", "["):
        raise InputError(
            expected="one culture",
            got=repr(value),
            remedy=f"Write `culture: {value}` into a profile and name that, or keep it: "
            f"`comity profile set NAME culture='{value}'`.",
            where=Where("--set"),
        )
    try:
        if isinstance(variable, NominalVariable):
            return str(in_the_rulebooks_case(value, name, book))
        return _number(value)
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
    return Interval(_plain(low), _plain(high)) if dots else _plain(words)


def _plain(word: str) -> float:
    """A number without Python's underscores, and without a negative zero."""
    if not NUMBER.fullmatch(word):
        raise ValueError(word)
    return float(word) + 0.0
