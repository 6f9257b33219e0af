"""Facts in people's own words: a word outside the categories is a known value to which no term applies."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches

from comity_fis.scores.iso3166 import culture_name

CULTURE = "culture"
"""The fact that states a person's culture."""
GENDERS = (("female", "woman", "f"), ("male", "man", "m"))
"""Synonyms for genders: a rulebook has one of each as a category."""

TYPO = 0.8
"""Similarity of a word and a category, in [0, 1], above which the word counts as a typo. Our choice: `femal`
is one, `transfemale` is not."""


def in_own_words(fact: str, word: str, categories: Collection[str]) -> str | None:
    """A person's word as a value of a variable: a category, or the word itself if no category matches.

    Args:
        fact: The fact: gender, culture, or another one.
        word: The person's word, in any case.
        categories: Categories of the variable.

    Returns:
        None if the variable accepts only its categories, or if the word is a typo of a gender or an unused
        country code.
    """
    if fact == CULTURE:
        return _culture(word, categories)
    return _gender(word.strip(), categories) if fact == "gender" else None


def _culture(word: str, categories: Collection[str]) -> str | None:
    name = culture_name(word)
    same = name and next(
        (category for category in categories if category.casefold() == name.casefold()), None
    )
    return same or name


def _gender(word: str, categories: Collection[str]) -> str | None:
    said = word.casefold()
    same = next((words for words in GENDERS if said in words), (said,))
    if known := [category for category in categories if category.casefold() in same]:
        return known[0]
    typo = get_close_matches(said, [category.casefold() for category in categories], n=1, cutoff=TYPO)
    return word if word and not typo else None
