"""The one question to a person, and the two ways in which their answer may count."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING, Literal

from comity.adaptation.editing import Books, checked, edited, keep_edited
from comity.parameters.acquaintance import met_at, model_m, usual_situation
from comity.people.adulthood import require_adult
from comity.people.consents import require_consent
from comity.people.learnt_file import Stated
from comity.people.profile import load_profile
from comity.people.remembered import forget_answers, remember_answer
from comity.people.store import Store
from comity_domain.problem.bound_parameters import DISTANCE

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity.people.profile import Declared
    from comity_fis import ParameterValue

CountsAs = Literal["setting", "observation"]
"""A setting goes before everything but safety; an observation is weighed with what the person shows."""


@dataclass(frozen=True, slots=True)
class Question:
    """Who is asked, and in which situation the answer holds, should it be an observation."""

    name: str
    judges: Books
    day: date
    situation: Mapping[str, Fact]

    def __post_init__(self) -> None:
        Store().require(self.name)

    def setting(self, said: str) -> float | None:
        """Keep the answer as the person's wish; `unknown` takes a wish back.

        Returns:
            The wish [m].

        Raises:
            InputError: for an answer that cannot be granted; nothing is changed.
        """
        words = {f"settings.{DISTANCE}": said}
        wish = keep_edited(self.name, words, self.judges).settings.get(DISTANCE)
        return None if wish is None else float(wish)

    def observation(self, said: str) -> float | None:
        """Keep the answer beside what meetings taught; `unknown` forgets all answers in this situation.

        Returns:
            What they named [m].

        Raises:
            InputError: for an answer that could not be granted as a wish either, or of a person who did not
                agree that meetings teach about them; nothing is changed.
        """
        document = edited({"name": self.name}, {f"settings.{DISTANCE}": said}, self.judges)
        wish = checked(document, self.judges, self.day).settings.get(DISTANCE)
        if wish is None:
            forget_answers(self.name, self.situation)
            return None
        require_consent(self.name, "learn")
        require_adult(load_profile(self.name).profile, self.day)
        stated = Stated(
            day=self.day,
            situation=dict(self.situation),
            model_m=round(model_m(self._prior()), 4),
            likes_m=float(wish),
        )
        remember_answer(self.name, stated)
        return stated.likes_m

    def _prior(self) -> ParameterValue:
        """What culture and situation give, without a wish."""
        without = _without_wish(load_profile(self.name))
        return met_at(without, self.judges.first, self.situation, self.day)

    def met_at(self) -> ParameterValue:
        """How near the robot comes in this situation from now on, with what that is made of."""
        return met_at(load_profile(self.name), self.judges.first, self.situation, self.day)


def ask_in(name: str, judges: Books, day: date, told: Mapping[str, Fact]) -> Question:
    """The question to a person who is kept, in their usual situation but for what is told of it.

    Raises:
        InputError: if nobody of that name is kept, or their profile is damaged.
    """
    Store().require(name)
    return Question(name, judges, day, {**usual_situation(load_profile(name), day), **told})


def _without_wish(declared: Declared) -> Declared:
    settings = {name: wish for name, wish in declared.profile.settings.items() if name != DISTANCE}
    return replace(declared, profile=declared.profile.model_copy(update={"settings": settings}))
