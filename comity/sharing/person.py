"""The privacy filter for one person, used by shared runs, exports and study tables.

The result is still personal data (GDPR, recital 26 and Article 4(5)): a reader who has the list of names, or
knows how the person moves, can identify them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING, Any

from comity.people.adulthood import ADULT, NO_ADULT
from comity.people.learnt_file import Observation, Stated
from comity.sharing.extra import Extra
from comity_fis import Interval

if TYPE_CHECKING:
    from comity.people.learnt_file import Learning
    from comity.people.profile import Profile

OLDEST_BAND = 90
"""Age from which all people share one band [years], as in the HIPAA Privacy Rule (45 CFR
164.514(b)(2)(i)(C))."""
BAND_YEARS = 10
"""Width of an age band [years] (our choice)."""
CLOSED: Mapping[str, frozenset[str]] = {
    "familiarity": frozenset({"stranger", "acquaintance", "close"}),
    "posture": frozenset({"standing", "seated", "lying"}),
    "robot_experience": frozenset({"low", "high"}),
    "formality": frozenset({"informal", "formal"}),
    "occasion": frozenset({"informal", "formal"}),
    "touch_consent": frozenset({"given", "withheld"}),
}
"""Shared facts, each with its closed vocabulary; any other word is the person's own and is removed."""


def pseudonyms(names: Iterable[str], kind: str = "person") -> dict[str, str]:
    """Pseudonyms `person_1`, `person_2` and so on, by name, in the order of the names.

    For a table of several runs, pass the names of all participants at once, so that each has one pseudonym.
    """
    return {name: f"{kind}_{i}" for i, name in enumerate(dict.fromkeys(names), start=1)}


def age_band(age: float | Interval) -> str:
    """Age band: `70 to 79`, `under 18`, `90 or more`; for an age known within a year, all possible bands.

    Args:
        age: Age [years].
    """
    low, high = (age.low, age.high) if isinstance(age, Interval) else (age, age)
    first, last = _band(low), _band(high)
    if first == last and first[0] == 0:
        return NO_ADULT
    if first[0] == OLDEST_BAND:
        return f"{OLDEST_BAND} or more"
    return f"{first[0]} to {last[1] - 1}" if last[0] < OLDEST_BAND else f"{first[0]} or more"


def _band(age: float) -> tuple[int, int]:
    """First year of a band, and of the next one."""
    if age < ADULT:
        return 0, ADULT
    if age >= OLDEST_BAND:
        return OLDEST_BAND, OLDEST_BAND + BAND_YEARS
    first = int(age) // BAND_YEARS * BAND_YEARS
    return max(first, ADULT), first + BAND_YEARS


@dataclass(frozen=True, slots=True)
class Filter:
    """Filter for shared data about people."""

    extras: frozenset[Extra] = frozenset()
    """Additional facts shared on request."""
    words: Collection[str] = frozenset()
    """Categories of the rulebook: a wish in these words is no free text."""

    def facts(self, profile: Profile, day: date | None) -> dict[str, Any]:
        """A person's facts on a date, by key, without names, dates, free text, and kinds not listed here.

        Args:
            profile: The person's declarations.
            day: Date, required if facts depend on it.
        """
        told = profile.facts(day)
        row: dict[str, Any] = {}
        if (age := told.get("age")) is not None:
            row["age_band"] = age_band(age)
        for name, words in CLOSED.items():
            if (word := str(told.get(name, "")).casefold()) in words:
                row[name] = word
        if Extra.GENDER in self.extras and told.get("gender"):
            row["gender"] = told["gender"]
        if Extra.CULTURE in self.extras and (cultures := profile.cultures(day)):
            row["culture"] = {one.words: one.weight for one in cultures}
        return row

    def wishes(self, profile: Profile) -> dict[str, float | str]:
        """A person's requests, as numbers and words of the rulebook."""
        return {name: wish for name, wish in profile.settings.items() if self._is_plain(name, wish)}

    def profile(self, profile: Profile, day: date | None, pseudonym: str) -> dict[str, Any]:
        """The filtered facts and wishes as a profile file, with a pseudonym; the age band is in `other`."""
        facts = self.facts(profile, day)
        other = {name: facts.pop(name) for name in ("age_band", "occasion") if name in facts}
        wishes = self.wishes(profile)
        return {
            "schema_version": 1,
            "name": pseudonym,
            **facts,
            **({"other": other} if other else {}),
            **({"settings": wishes} if wishes else {}),
        }

    def learnt(self, learnt: Iterable[Learning]) -> list[dict[str, Any]]:
        """What was learnt from meetings, by days since the first, with the situation in closed vocabulary."""
        ordered = sorted(learnt, key=lambda one: one.day)
        return [self._lesson(one, (one.day - ordered[0].day).days) for one in ordered]

    def _lesson(self, one: Learning, days: int) -> dict[str, Any]:
        situation = {
            name: fact
            for name, fact in one.situation.items()
            if isinstance(fact, str) and fact in CLOSED.get(name, frozenset())
        }
        common = {"days": days, "situation": situation, "model_m": one.model_m}
        if isinstance(one, Stated):
            return {**common, "likes_m": one.likes_m}
        assert isinstance(one, Observation)
        return {**common, "distance_m": one.distance_m, "signal": one.signal, "simulated": one.simulated}

    def _is_plain(self, name: str, wish: float | str) -> bool:
        return name in self.words and (not isinstance(wish, str) or wish in self.words)


def plain_words(*rulebooks: Any) -> frozenset[str]:
    """Names of the parameters of rulebooks, and of all their values."""
    return frozenset(
        word for book in rulebooks for name, one in book.parameters.items() for word in (name, *one.terms)
    )
