"""Whether a person is an adult: no rule here was made for or tested with children."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING

from comity_fis import InputError, Interval

if TYPE_CHECKING:
    from comity.people.profile import Profile

ADULT = 18
"""Age of adulthood [years]: the Convention on the Rights of the Child (1989), Article 1."""
AGE_BAND, NO_ADULT = "age_band", f"under {ADULT}"
"""Replaces a child's age in a run that is shared."""
NOTE = f"under {ADULT}: no rule was made for children or tested with them"


def is_under_age(profile: Profile, day: date | None, told: object = None) -> bool | None:
    """Whether a person is a child; None if their age is unknown.

    Args:
        profile: Their declared profile.
        day: The day in question.
        told: Their age, if given directly: it takes precedence over the profile.
    """
    age = told if told is not None else profile.facts(day or date.today()).get("age")
    if age is None and profile.other.get(AGE_BAND) == NO_ADULT:
        return True
    if isinstance(age, Interval):
        return age.low < ADULT
    return age < ADULT if isinstance(age, int | float) else None


def require_adult(profile: Profile, day: date | None = None) -> None:
    """Reject learning about a child.

    Args:
        profile: Their declared profile.
        day: The day in question; None: today.

    Raises:
        InputError: They are under 18 on that day.
    """
    if is_under_age(profile, day):
        raise InputError(
            expected=f"an adult: nothing is learnt about anybody under {ADULT}",
            got=profile.name,
            remedy="Ask them, or their guardian, for a wish, which `comity profile set` keeps.",
        )
