"""Observations from real encounters: validated, and weighed like those of a robot."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from comity.adaptation.observers_words import distance, situation_told
from comity.parameters.acquaintance import met_at, model_m, usual_situation
from comity.people.adulthood import require_adult
from comity.people.consents import require_consent
from comity.people.learnt_file import Observation
from comity.people.profile import load_profile
from comity.people.remembered import write_down
from comity.people.store import Store
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, NumericParameter, Where
from comity_fis.learning.signals import Signal

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity_fis import Rulebook


@dataclass(frozen=True, slots=True)
class ObservedSignal:
    """One observed signal of a person."""

    name: str
    signal: Signal
    distance_m: float
    """Distance of the robot, between the nearest points of the bodies [m]."""
    day: date | None = None
    """Day of the observation; None: today."""
    situation: Mapping[str, Fact] | None = None
    """Situation, by variable; missing variables are as in the person's usual situation."""
    where: Where | None = None
    """Location of the row."""


def observe(sights: Iterable[ObservedSignal], rulebook: Rulebook) -> tuple[Observation, ...]:
    """Store observations of people, all or none; for each person they can be undone together.

    Args:
        sights: The observations, in any order.
        rulebook: Gives the values by culture and situation alone.

    Raises:
        InputError: A person does not consent, has a setting for the distance, or is a child, or a situation
            is invalid; nothing is written.
    """
    checked = [(sight.name, _observation(sight, rulebook)) for sight in sights]
    for name in dict.fromkeys(name for name, _ in checked):
        write_down(name, [seen for other, seen in checked if other == name])
    return tuple(seen for _, seen in checked)


def _observation(sight: ObservedSignal, rulebook: Rulebook) -> Observation:
    try:
        return _checked(sight, rulebook)
    except InputError as error:
        if sight.where is None:
            raise
        raise error.at(sight.where) from None


def _checked(sight: ObservedSignal, rulebook: Rulebook) -> Observation:
    Store().require(sight.name)
    require_consent(sight.name, "learn")
    declared, day = load_profile(sight.name), sight.day or date.today()
    _refuse_impossible(sight, day, rulebook)
    require_adult(declared.profile, day)
    situation = {**usual_situation(declared, day), **situation_told(sight.situation or {}, rulebook)}
    value = met_at(declared, rulebook, situation, day)
    if value.start.origin == "setting":
        raise InputError(
            expected="somebody who leaves the distance open",
            got=f"{sight.name}, who asks for {value.start.value:g} m",
            remedy="What a person asked for stands, and nothing is learnt about it; "
            f"`comity profile set {sight.name} distance=unknown` takes the wish back.",
        )
    return Observation(
        day=day,
        situation=situation,
        model_m=round(model_m(value), 4),
        distance_m=round(sight.distance_m, 4),
        signal=sight.signal,
    )


def _refuse_impossible(sight: ObservedSignal, day: date, rulebook: Rulebook) -> None:
    if day > date.today():
        raise InputError(
            expected="a meeting that has been",
            got=f"one on {day}, in the future",
            remedy="Check the date.",
        )
    distance(sight.distance_m, sight.where)
    if not isinstance(rulebook.parameters.get(DISTANCE), NumericParameter):
        raise InputError(
            expected=f"a rulebook with the numeric parameter {DISTANCE}",
            got=rulebook.name,
            remedy="Name another one.",
            where=Where("--rulebook"),
        )
