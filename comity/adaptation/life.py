"""A person's parameters over the years: inference repeated as the person changes.

Longitudinal adaptation (Bruno et al. 2017): the same person and rules on different days.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import date
from itertools import chain, pairwise
from typing import TYPE_CHECKING

from comity.parameters.values import infer_for
from comity.people.profile import Profile
from comity_fis import InputError, Where, country

if TYPE_CHECKING:
    from comity.people.profile import Declared
    from comity_fis import Inference, Rulebook

MOST_YEARS = 120


@dataclass(frozen=True, slots=True)
class Year:
    """The state at the end of a year."""

    day: date
    """31 December, so that it includes all changes of the year."""
    inference: Inference
    changed: tuple[str, ...]
    """Facts that changed within the year, in words; empty in the first year."""


def life(declared: Declared, rulebook: Rulebook, first: int, last: int) -> tuple[Year, ...]:
    """A person's parameters at the end of every year.

    Raises:
        InputError: A fact is invalid on one of the days.
    """
    days = [date(year, 12, 31) for year in range(first, last + 1)]
    answers = [infer_for(declared, rulebook, at=day) for day in days]
    changes = [tuple(_changes(declared.profile, *pair)) for pair in pairwise(days)]
    return tuple(map(Year, days, answers, chain([()], changes)))


def years_in_words(words: str) -> tuple[int, int]:
    """`2005..2025` as the first and the last year.

    Raises:
        InputError: It is not such a range, or the range is too long.
    """
    first, dots, last = words.partition("..")
    usable = dots and all(re.fullmatch("[0-9]{4}", year) and int(year) for year in (first, last))
    if usable and 0 <= int(last) - int(first) < MOST_YEARS:
        return int(first), int(last)
    raise InputError(
        expected=f"a first and a last year, at most {MOST_YEARS} in all",
        got=repr(words),
        remedy="Write for example 2005..2025.",
        where=Where("--years"),
    )


def _changes(profile: Profile, before: date, after: date) -> Iterator[str]:
    """The facts that changed, other than the age."""
    old, new = profile.facts(before), profile.facts(after)
    for name in sorted((old.keys() | new.keys()) - {"age"}):
        if old.get(name) != new.get(name):
            yield f"{name} {_told(new.get(name))}"
    was, is_ = (_cultures(profile, day) for day in (before, after))
    if was != is_:
        yield f"culture {is_ or 'not disclosed'}"


def _cultures(profile: Profile, day: date) -> str:
    counting = profile.cultures(day)
    total = sum(one.weight for one in counting)
    known = ((country(one.words), one) for one in counting)
    return ", ".join(f"{c.name if c else one.words} {one.weight / total:.0%}" for c, one in known)


def _told(fact: object) -> str:
    if fact is None:
        return "not disclosed"
    return ", ".join(map(str, fact)) if isinstance(fact, tuple) else str(fact)
