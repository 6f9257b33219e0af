"""Terms of a variable for culture: any name that people give their culture, with or without a score."""

from __future__ import annotations

from typing import Any

from comity_fis.membership.function import Categories
from comity_fis.scores.iso3166 import NO_CODE
from comity_fis.variables.frozen import FrozenDict
from comity_fis.variables.own_words import CULTURE, in_own_words


class CultureTerms(FrozenDict[str, Categories]):
    """Declared terms, plus one for every other culture: a country by code or name, an ethnic group by name.

    Only the declared ones are listed by iteration.
    """

    __slots__ = ()

    remedy = NO_CODE
    """Remedy for a word that is not a culture."""

    def __contains__(self, word: object) -> bool:
        return dict.__contains__(self, word) or (
            isinstance(word, str) and in_own_words(CULTURE, word, ()) is not None
        )

    def __missing__(self, word: str) -> Categories:
        if (name := in_own_words(CULTURE, word, self)) is None:
            raise KeyError(word)
        return self[name] if dict.__contains__(self, name) else Categories(frozenset({name}))

    def __reduce__(self) -> tuple[Any, ...]:
        return CultureTerms, (dict(self),)
