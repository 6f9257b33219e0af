"""Whether a person is an adult: no rule here was made for children or tested with them."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING

from comity_fis import InputError, Interval

if TYPE_CHECKING:
    from comity.people.profile import Profile

ADULT = 18
"""Years. The Convention on the Rights of the Child (1989), Article 1, calls younger people children."""
AGE_BAND, NO_ADULT = "age_band", f"under {ADULT}"
"""What a run that is passed on says of a child in place of the age."""
NOTE = f"under {ADULT}: no rule was made for children or tested with them"


def is_under_age(profile: Profile, day: date | None, told: object = None) -> bool | None:
    """Whether a person is a child; None where their age is not disclosed.

    Args:
        profile: What they declared.
        day: On which.
        told: Their age, where it is told here and now: it goes before the profile.
    """
    age = told if told is not None else profile.facts(day or date.today()).get("age")
    if age is None and profile.other.get(AGE_BAND) == NO_ADULT:
        return True
    if isinstance(age, Interval):
        return age.low < ADULT
    return age < ADULT if isinstance(age, int | float) else None


def require_adult(profile: Profile, day: date | None = None) -> None:
    """Refuse to learn about a child.

    Args:
        profile: What they declared.
        day: On which; today where it is None.

    Raises:
        InputError: They are under 18 then.
    """
    if is_under_age(profile, day):
        raise InputError(
            expected=f"an adult: nothing is learnt about anybody under {ADULT}",
            got=profile.name,
            remedy="Ask them, or their guardian, for a wish, which `comity profile set` keeps.",
        )
