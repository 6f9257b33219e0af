"""The profiles of a scenario side by side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING

from comity.parameters.cast import cast_of
from comity.testing.measuring.measured import Measured, measured
from comity.testing.trials.attempt import attempted
from comity.testing.trials.profiles import named

if TYPE_CHECKING:
    from comity.testing.trials.case import Across, Case
    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class ComparedProfiles:
    """The profiles that a comparison compares; inferring their parameters runs no episode.

    Args:
        across: The comparison and its cases.
        before: Results already measured in some of the cases, by the case's name.
    """

    across: Across
    before: Mapping[str, Measured] = field(default_factory=dict)

    @property
    def person(self) -> str:
        """The first of the people who have the matrix's profiles."""
        return self.across.cases[0].people[0]

    def values(self, profile: str) -> Inference:
        """The parameters inferred for the person with a profile."""
        case = next((case for case in self.across.cases if case.profile_name == profile), None)
        return _values(case or self.across.cases[0], profile, self.person)

    def measured(self) -> Iterator[Measured]:
        """The measured results of every profile's episode."""
        for case in self.across.cases:
            yield self.before.get(case.id) or measured(case, attempted(case))


@lru_cache(maxsize=256)
def _values(case: Case, profile: str, person: str) -> Inference:
    load = case.profile if case.profile_name == profile else named(case.file, profile)
    others = {} if load is None else dict.fromkeys(case.people, load)
    return cast_of(case.file, profiles=others, rulebook=case.rulebook, at=case.day).values()[person]
