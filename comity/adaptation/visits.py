"""Repeated visits to one simulated person: each is an episode from which the robot learns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from datetime import date, timedelta
from typing import TYPE_CHECKING

from comity.live_episode import LiveEpisode
from comity.monitoring.nudging import FARTHEST_M
from comity.parameters.acquaintance import model_m, observation, situation_of
from comity.parameters.which_rulebook import which_rulebook
from comity.people.learnt_file import Learning, Observation, comfort_on, learnt_on
from comity.people.profile import load_profile
from comity.people.remembered import remembered
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import ComfortSpec, ScenarioFile, load_scenario
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, NumericParameter, Where, load_rulebook
from comity_fis.proxemics import PERSON_MARGIN_M

if TYPE_CHECKING:
    from comity_fis import Inference, Learnt, Rulebook
    from comity_fis.learning.signals import Signal

STAGE, PERSON = "acquaintance", "guest"
"""The shipped scenario for the visits, and the visited person in it."""


@dataclass(frozen=True, slots=True)
class VisitRecord:
    """One visit, and what was known before it."""

    days: int
    """Days since the first visit."""
    model_m: float
    """Distance by culture and situation [m]."""
    interval_m: tuple[float, float]
    """The robot's 90 % credible interval for the middle of the person's comfort interval, at least the safe
    distance [m]."""
    wanted_m: float
    """The robot's target distance [m]."""
    reached_m: float | None
    """The true distance at docking [m]."""
    shown: Signal | None
    """The person's true signal; None if the robot never reached them."""
    seen: Observation | None
    """The robot's observation."""


@dataclass(frozen=True, slots=True)
class Acquaintance:
    """A simulated person, and how often the robot visits."""

    profile: str
    """A shipped or stored name, or a file."""
    rulebook: str
    every_days: int
    begin: date
    seed: int
    """Seed for the comfort interval (if not given), the person's signals, and the sensors."""
    known: tuple[Learning, ...] = ()
    """Observations from earlier encounters."""

    def prepared(
        self, comfort: ComfortSpec | None = None, day: date | None = None, learnt: Learnt | None = None
    ) -> PlannedEpisode:
        """The scenario with this person, planned.

        Raises:
            InputError: The profile or the rulebook is invalid, or leaves nothing to learn.
        """
        _parameter(load_rulebook(self.rulebook))
        prepared = prepare(
            _with(load_scenario(STAGE), comfort),
            profiles={PERSON: self.profile},
            rulebook=self.rulebook,
            at=day or self.begin,
            learnt={PERSON: {DISTANCE: learnt}} if learnt else {},
        )
        _refuse_setting(prepared.values[PERSON], prepared.profiles[PERSON].name)
        return prepared


def acquainted(
    profile: str, rulebook: str | None, *, every_days: int, begin: date | None, seed: int
) -> tuple[Acquaintance, str | None]:
    """Set up repeated visits to a person, with what was learnt about them.

    Args:
        profile: A shipped or stored name, or a file.
        rulebook: A shipped name or a file; None: the suitable one for the person.
        every_days: Days between two visits.
        begin: Day of the first visit; None: today, or the day of the last stored simulated visit. Later
            observations are ignored.
        seed: Seed of all random numbers.

    Returns:
        The setup, and the person's name in the store; None if not stored.

    Raises:
        InputError: There is no such profile, or the learnt data are damaged.
    """
    declared = load_profile(profile)
    kept_as = declared.kept_as
    document = remembered(kept_as) if kept_as else None
    known = document.conversational_distance if document else ()
    simulated = (seen.day for seen in known if isinstance(seen, Observation) and seen.simulated)
    first = begin or max((date.today(), *simulated))
    until = tuple(seen for seen in known if seen.day <= first)
    decides = rulebook or which_rulebook([declared]).name
    return Acquaintance(profile, decides, every_days, first, seed, until), kept_as


def interval_in_words(words: str) -> ComfortSpec:
    """Parse `0.5..0.8` as the comfort interval of a simulated person.

    Raises:
        InputError: It is not an interval.
    """
    low, dots, high = words.partition("..")
    try:
        near_m, far_m = float(low), float(high)
        if dots and near_m >= 0.0 and near_m + 0.05 <= far_m <= FARTHEST_M:
            return ComfortSpec(wants_m=(near_m, far_m))
    except ValueError:
        pass
    raise InputError(
        expected=f"two distances up to {FARTHEST_M:g} m, at least 0.05 m apart",
        got=repr(words),
        remedy="Write for example --wants 0.5..0.8.",
        where=Where("--wants"),
    )


def likes(acquaintance: Acquaintance) -> ComfortSpec:
    """A random comfort interval from the population described by the model's value and spread."""
    import numpy as np

    prepared = acquaintance.prepared()
    parameter = _parameter(prepared.rulebook)
    rng = np.random.Generator(np.random.PCG64([acquaintance.seed, 2]))
    half_m = float(parameter.spread * 0.5 * np.exp(0.4 * rng.standard_normal()))
    middle_m = model_m(prepared.values[PERSON][DISTANCE]) + float(parameter.spread * rng.standard_normal())
    middle_m = min(max(middle_m, PERSON_MARGIN_M + half_m), FARTHEST_M - half_m)
    return ComfortSpec(wants_m=(round(middle_m - half_m, 3), round(middle_m + half_m, 3)))


def meet(acquaintance: Acquaintance, comfort: ComfortSpec, times: int) -> Iterator[VisitRecord]:
    """Visit a person repeatedly.

    Args:
        acquaintance: The simulated person, and how often the robot visits.
        comfort: The person's true comfort interval, unknown to the robot.
        times: Number of visits.

    Raises:
        InputError: The last visit would be after the calendar's last day.
    """
    _require_days(acquaintance, times)
    person = load_scenario(STAGE).scenario.people[PERSON]
    known = tuple(seen for seen in acquaintance.known if seen.situation == situation_of(person))
    parameter = _parameter(load_rulebook(acquaintance.rulebook))
    for visit in range(times):
        meeting = _meet(acquaintance, comfort, visit, known, parameter)
        if meeting.seen is not None:
            known = (*known, meeting.seen)
        yield meeting


def _require_days(acquaintance: Acquaintance, times: int) -> None:
    days = (times - 1) * acquaintance.every_days
    if days > (date.max - acquaintance.begin).days:
        raise InputError(
            expected=f"a first day with {days} days after it",
            got=f"{acquaintance.begin}, and the calendar ends on {date.max}",
            remedy="Begin earlier with --at, or lower --times or --every.",
            where=Where("--at"),
        )


def _meet(
    acquaintance: Acquaintance,
    comfort: ComfortSpec,
    visit: int,
    known: tuple[Learning, ...],
    parameter: NumericParameter,
) -> VisitRecord:
    days = visit * acquaintance.every_days
    day = acquaintance.begin + timedelta(days=days)
    prepared = acquaintance.prepared(comfort, day, learnt_on(day, known, parameter.spread))
    value = prepared.values[PERSON][DISTANCE]
    belief, model = comfort_on(day, known, parameter.spread), model_m(value)
    low, high = belief.interval(nearest=parameter.safe.low - model)
    live = LiveEpisode(prepared, seed=1000 * acquaintance.seed + visit)
    live.run()
    episode = live.so_far()
    visits, stops = episode.visits, episode.metrics.stopping
    off_m = stops[PERSON].stop_distance_error_m if PERSON in stops else None
    situation = situation_of(prepared.file.scenario.people[PERSON])
    return VisitRecord(
        days=days,
        model_m=model,
        interval_m=(model + float(low), model + float(high)),
        wanted_m=value.number,
        reached_m=None if off_m is None else value.number + off_m,
        shown=next((shown.signal for shown in live.shown), None),
        seen=observation(visits[0], prepared.values[PERSON], situation, day) if visits else None,
    )


def _with(file: ScenarioFile, comfort: ComfortSpec | None) -> ScenarioFile:
    """The scenario, with a person of this comfort interval."""
    if comfort is None:
        return file
    person = file.scenario.people[PERSON].model_copy(update={"comfort": comfort})
    people = {**file.scenario.people, PERSON: person}
    return replace(file, scenario=file.scenario.model_copy(update={"people": people}))


def _parameter(rulebook: Rulebook) -> NumericParameter:
    """The parameter that is learnt.

    Raises:
        InputError: The rulebook does not have it.
    """
    parameter = rulebook.parameters.get(DISTANCE)
    if isinstance(parameter, NumericParameter):
        return parameter
    raise InputError(
        expected=f"a rulebook with the numeric parameter {DISTANCE}",
        got=rulebook.name,
        remedy="Name another one.",
        where=Where("--rulebook"),
    )


def _refuse_setting(values: Inference, profile: str) -> None:
    asked = values[DISTANCE].start
    if asked.origin == "setting":
        raise InputError(
            expected=f"a profile that leaves {DISTANCE} open",
            got=f"one that asks for {asked.value}",
            remedy="What a person asked for stands, and nothing is learnt about it.",
            where=Where(profile),
        )
