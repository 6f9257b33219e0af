"""The profiles of a scenario beside each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from comity.cast import cast_of
from comity.testing.trial import attempted

if TYPE_CHECKING:
    from comity.testing.case import Across, Case
    from comity.testing.trial import Trial
    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class Among:
    """What comparisons are held against; values need no episode."""

    across: Across

    @property
    def person(self) -> str:
        """Of those who have the profiles, the first."""
        return self.across.cases[0].people[0]

    def values(self, profile: str) -> Inference:
        """What a profile gives the person."""
        case = next((case for case in self.across.cases if case.profile_name == profile), None)
        return _values(case or self.across.cases[0], profile, self.person)

    def trials(self) -> Iterator[Trial]:
        """Every profile's episode."""
        return map(attempted, self.across.cases)


@lru_cache(maxsize=256)
def _values(case: Case, profile: str, person: str) -> Inference:
    written: Mapping[str, str] = case.profiles or {person: profile}
    if case.profile_name != profile:
        written = {person: profile}
    return cast_of(case.file, profiles=written, rulebook=case.rulebook, at=case.day).values()[person]
