"""How far the robot stops from somebody, against what was inferred for them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import ROUNDING, Amount, apart, differences_apart, told, told_apart
from comity.testing.metrics.standing import standing

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

PARAMETER = "conversational_distance"


@dataclass(frozen=True, slots=True)
class Distance:
    """Between the nearest points of the two bodies, when the robot has docked, with what was wanted then."""

    RULE: ClassVar[str] = "_DISTANCE [_TO NAME] _WITHIN amount (_OF (_CULTURE_DERIVED | _WANTED) _ONE?)?"
    EXAMPLE: ClassVar[str] = "distance to johanna within 5 cm of the culture-derived one"

    person: str | None
    """None for everybody before whom the robot stands."""
    within_m: float

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a name and an amount."""
        person, within = parts
        assert isinstance(within, Amount)
        return cls(person, within.size("m"))

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,) if self.person else ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Each person farther off than allowed, or never reached."""
        trial.require_goal(*self.people)
        for person in self.people or trial.approached:
            yield from self._judge(trial, person)

    def _judge(self, trial: Trial, person: str) -> Iterator[Finding]:
        visit, stood = trial.visit(person), standing(trial, person)
        docked_s = math.inf if visit is None or visit.docked_s is None else visit.docked_s
        wanted = trial.episode.values_at(person, docked_s)[PARAMETER].number
        if stood is None:
            expected = f"{told(wanted, 'm')} from {person}, within {apart(self.within_m, 'm')}"
            yield Finding(expected, "the robot never stopped there", tuple(causes.of_visit(trial, person)))
            return
        off = stood.distance_m - wanted
        if abs(off) > self.within_m + ROUNDING:
            side = "far" if off > 0 else "near"
            should, stands = told_apart((wanted, stood.distance_m), "m")
            within, too = differences_apart((self.within_m, off), "m")
            because = (
                *causes.of_node(trial, f"docked?({person})", "success", ended_s=stood.t),
                *causes.of_visit(trial, person),
                *causes.of_parameter(trial, PARAMETER, person, docked_s),
            )
            yield Finding(
                f"{should} from {person}, within {within}",
                f"{stands} at t={stood.t:.2f} s, {too} too {side}",
                because,
            )
