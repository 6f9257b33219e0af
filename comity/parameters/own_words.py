"""Maps facts in people's own words to a rulebook's categories; unknown words are never an error."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity.parameters.used import used_facts
from comity.people.dated import OLDEST
from comity.people.language import iso639
from comity_fis import Interval, NominalVariable, NumericVariable
from comity_fis.listing import listed
from comity_fis.variables.own_words import in_own_words

if TYPE_CHECKING:
    from comity_fis import Rulebook


def own_words(facts: Mapping[str, Any], rulebook: Rulebook) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The facts that a rulebook accepts, and a note for each that it has no word for.

    Case is ignored: `Female` is the category `female`, and so is `woman`. A gender outside the categories is
    known, but no term applies to it. A language outside the categories counts as unknown. An age above the
    rulebook's maximum counts as the maximum.

    Args:
        facts: Facts by key of the profile.
        rulebook: The rulebook.
    """
    known = {name: in_the_rulebooks_case(fact, name, rulebook) for name, fact in facts.items()}
    notes = [*_gender(known, rulebook), *_language(known, rulebook), *_age(known, rulebook)]
    return known, tuple(notes)


def in_the_rulebooks_case(fact: Any, name: str, rulebook: Rulebook) -> Any:
    """A word with the capitalisation of the rulebook's category; other facts unchanged."""
    variable = rulebook.variables.get(name)
    if not isinstance(fact, str) or not isinstance(variable, NominalVariable) or fact in variable.categories:
        return fact
    alike = [category for category in variable.categories if category.casefold() == fact.casefold()]
    return alike[0] if len(alike) == 1 else fact


def _gender(known: dict[str, Any], rulebook: Rulebook) -> Iterator[str]:
    variable, said = rulebook.variables.get("gender"), known.get("gender")
    if not isinstance(variable, NominalVariable) or not isinstance(said, str):
        return
    word = in_own_words("gender", said, variable.categories)
    if word is None:
        return  # a typo, which the rulebook rejects
    known["gender"] = word
    if word not in variable.categories and "gender" in used_facts(rulebook):
        yield (
            f"gender {word}: no rule of {rulebook.name} speaks of it; its rules know "
            f"{listed(variable.categories)}."
        )


def _language(known: dict[str, Any], rulebook: Rulebook) -> Iterator[str]:
    """Sets the variable `language` to the preferred language that the rulebook knows."""
    languages, variable = known.pop("languages", ()), rulebook.variables.get("language")
    if isinstance(told := known.pop("language", None), str):
        languages = (told,)
    elif told is not None:
        known["language"] = told
    if not isinstance(variable, NominalVariable) or not languages:
        return
    categories = {iso639(category): category for category in variable.categories}
    spoken = [code for language in languages if (code := iso639(language)) in categories]
    if spoken:
        known["language"] = categories[spoken[0]]
    else:
        yield _note(", ".join(languages), rulebook, variable)


def _age(known: dict[str, Any], rulebook: Rulebook) -> Iterator[str]:
    variable, said = rulebook.variables.get("age"), known.get("age")
    if not isinstance(variable, NumericVariable) or not isinstance(said, float | int | Interval):
        return
    highest = variable.domain.high
    low, high = said.ends if isinstance(said, Interval) else (said, said)
    if not highest < high <= OLDEST:
        return
    known["age"] = Interval(low, highest) if low < highest else highest
    yield f"age {said}: the rules of {rulebook.name} know ages up to {highest:g}, and count it as that."


def _note(said: str, rulebook: Rulebook, variable: NominalVariable) -> str:
    return (
        f"language {said}: the rules of {rulebook.name} speak only of {', '.join(variable.categories)}, "
        "so that they count it as not told."
    )
