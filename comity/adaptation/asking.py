"""Asking a person how near they like the robot, and the two ways to use their answer."""

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
"""A setting overrides everything but safety; an observation is weighed with what the person shows."""


@dataclass(frozen=True, slots=True)
class Question:
    """The person asked, and the situation in which the answer holds if it is an observation."""

    name: str
    judges: Books
    day: date
    situation: Mapping[str, Fact]

    def __post_init__(self) -> None:
        Store().require(self.name)

    def setting(self, said: str) -> float | None:
        """Store the answer as the person's setting; `unknown` removes it.

        Returns:
            The setting [m].

        Raises:
            InputError: The answer cannot be granted; nothing is changed.
        """
        words = {f"settings.{DISTANCE}": said}
        wish = keep_edited(self.name, words, self.judges).settings.get(DISTANCE)
        return None if wish is None else float(wish)

    def observation(self, said: str) -> float | None:
        """Store the answer as an observation; `unknown` removes all answers in this situation.

        Returns:
            The stated distance [m].

        Raises:
            InputError: The answer could not be granted as a setting either, or the person does not consent to
                learning; nothing is changed.
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
        """The value by culture and situation, without a setting."""
        without = _without_wish(load_profile(self.name))
        return met_at(without, self.judges.first, self.situation, self.day)

    def met_at(self) -> ParameterValue:
        """The distance that the robot now keeps in this situation, with its contributions."""
        return met_at(load_profile(self.name), self.judges.first, self.situation, self.day)


def ask_in(name: str, judges: Books, day: date, told: Mapping[str, Fact]) -> Question:
    """The question for a stored person, in their usual situation updated by the given facts.

    Raises:
        InputError: No person of that name is stored, or their profile is damaged.
    """
    Store().require(name)
    return Question(name, judges, day, {**usual_situation(load_profile(name), day), **told})


def _without_wish(declared: Declared) -> Declared:
    settings = {name: wish for name, wish in declared.profile.settings.items() if name != DISTANCE}
    return replace(declared, profile=declared.profile.model_copy(update={"settings": settings}))
