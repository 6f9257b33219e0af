"""Meeting one person again and again: every visit is an episode in the world, and teaches something."""

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
"""The shipped scenario in which people are met, and who is met there."""


@dataclass(frozen=True, slots=True)
class VisitRecord:
    """One visit, and what was known before it."""

    days: int
    """Since the first."""
    model_m: float
    """What culture and situation gave."""
    interval_m: tuple[float, float]
    """Where the middle of the person's comfort interval lay with 90 % probability, as the robot saw it; no
    nearer than safety allows."""
    wanted_m: float
    """Where the robot wanted to stop."""
    reached_m: float | None
    """Where it stood in truth when it docked."""
    shown: Signal | None
    """What the person truly did; None where the robot never came to stand before them."""
    seen: Observation | None
    """What the robot made of it."""


@dataclass(frozen=True, slots=True)
class Acquaintance:
    """A simulated person and how often the robot goes there."""

    profile: str
    """A shipped or kept name, or a file."""
    rulebook: str
    every_days: int
    begin: date
    seed: int
    """For what the person likes, where that is not given, for what they show, and for the sensors."""
    known: tuple[Learning, ...] = ()
    """From earlier meetings."""

    def prepared(
        self, comfort: ComfortSpec | None = None, day: date | None = None, learnt: Learnt | None = None
    ) -> PlannedEpisode:
        """The scenario with this person in it, planned.

        Raises:
            InputError: if the profile or the rulebook cannot be used, or leaves nothing to learn.
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
    """How a person is going to be met, with what is remembered of them.

    Args:
        profile: A shipped or kept name, or a file.
        rulebook: A shipped name or a file; without it the right one for the person.
        every_days: Between two visits.
        begin: Of the first visit; when None, today or the day of the last
            simulated one that is kept. What is remembered of later days is left out.
        seed: For all that is drawn.

    Returns:
        That, and the name under which the person is kept on this machine; None where they are not.

    Raises:
        InputError: if there is no such profile, or what is remembered was damaged.
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
    """`0.5..0.8` as the comfort interval of a simulated person.

    Raises:
        InputError: if it is none.
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
    """The comfort interval of one of the many people whom the model's value and spread describe."""
    import numpy as np

    prepared = acquaintance.prepared()
    parameter = _parameter(prepared.rulebook)
    rng = np.random.Generator(np.random.PCG64([acquaintance.seed, 2]))
    half_m = float(parameter.spread * 0.5 * np.exp(0.4 * rng.standard_normal()))
    middle_m = model_m(prepared.values[PERSON][DISTANCE]) + float(parameter.spread * rng.standard_normal())
    middle_m = min(max(middle_m, PERSON_MARGIN_M + half_m), FARTHEST_M - half_m)
    return ComfortSpec(wants_m=(round(middle_m - half_m, 3), round(middle_m + half_m, 3)))


def meet(acquaintance: Acquaintance, comfort: ComfortSpec, times: int) -> Iterator[VisitRecord]:
    """Visit a person again and again.

    Args:
        acquaintance: The people met, and how often.
        comfort: What the person likes; the robot does not know it.
        times: How many visits.

    Raises:
        InputError: if the last visit would be after the last day of the calendar.
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
    """The stage, with a person who likes just that."""
    if comfort is None:
        return file
    person = file.scenario.people[PERSON].model_copy(update={"comfort": comfort})
    people = {**file.scenario.people, PERSON: person}
    return replace(file, scenario=file.scenario.model_copy(update={"people": people}))


def _parameter(rulebook: Rulebook) -> NumericParameter:
    """What is learnt about.

    Raises:
        InputError: if the rulebook does not have it.
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
