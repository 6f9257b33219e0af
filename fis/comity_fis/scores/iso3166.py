"""The countries of ISO 3166-1, and Kosovo, and what else people may call their culture.

A table of 250 lines, where a library of countries would bring subdivisions and translations of 21 MB.
`data/countries.csv` names the source.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True, slots=True)
class Country:
    """A country or territory."""

    alpha3: str
    """Its ISO 3166-1 code of three letters, the key of every table here."""
    alpha2: str
    name: str
    """In English."""
    also: tuple[str, ...] = ()
    """What else people write."""

    @property
    def spellings(self) -> tuple[str, ...]:
        """Everything that stands for it."""
        return self.name, self.alpha3, self.alpha2, *self.also


@cache
def countries() -> tuple[Country, ...]:
    """All 250, by code."""
    text = files("comity_fis").joinpath("data/countries.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return tuple(
        Country(row["alpha3"], row["alpha2"], row["name"], tuple(filter(None, row["also"].split("|"))))
        for row in rows
    )


def country(words: str) -> Country | None:
    """The country that a person writes by code or by name, in whatever case; None where it is none."""
    return _by_spelling().get(words.strip().casefold())


CODE = re.compile(r"[A-Z]{2,3}")
"""The shape of a country's code. A name of a people so short is written as a name: Ewe, Han."""
NO_CODE = "Write a country by ISO 3166 code or English name, a region, or what people call their culture."
"""The remedy for a code that no country has; no people is a typo of another, so that none is proposed."""


def culture_name(words: str) -> str | None:
    """A culture as tables and rules know it: the code of a country, else the words themselves.

    None for no words at all, and for what has the shape of a code that no country has.
    """
    if (known := country(words)) is not None:
        return known.alpha3
    words = words.strip()
    return None if not words or CODE.fullmatch(words) else words


@cache
def _by_spelling() -> Mapping[str, Country]:
    return {words.casefold(): one for one in countries() for words in one.spellings}
