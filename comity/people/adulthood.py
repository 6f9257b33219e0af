"""Whether a person is an adult: no rule here was made for children or tested with them."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING

from comity_fis import Interval

if TYPE_CHECKING:
    from comity.people.profile import Profile

ADULT = 18
"""Years. The Convention on the Rights of the Child (1989), Article 1, calls whoever is younger a child."""
NOTE = f"under {ADULT}: no rule was made for children or tested with them"


def is_under_age(profile: Profile, day: date | None, told: object = None) -> bool | None:
    """Whether a person is a child; None where their age is not disclosed.

    Args:
        profile: What they declared.
        day: On which.
        told: Their age, where it is told here and now: it goes before the profile.
    """
    age = told if told is not None else profile.facts(day or date.today()).get("age")
    if isinstance(age, Interval):
        return age.low < ADULT
    return age < ADULT if isinstance(age, int | float) else None
