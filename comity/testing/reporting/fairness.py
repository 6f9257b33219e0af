"""Differences between profiles, and which of them no parameter explains.

An episode is a consequence of the parameters: whoever gets the same ones is served alike. What may differ
between two profiles is therefore what hangs on a parameter that differs between them, and by a share that is
like that of the parameter: a hundredth of the distance is no reason for twice the time. Whether somebody is
served, and as near as they would have it, hangs on none: that is the design's law. Anything else is flagged,
but for what somebody's own settings bring about, which is told by itself: they asked for it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from comity.testing.reporting.answers import UnexplainedAnswer
from comity.testing.reporting.summary import by_case, comparable, served_alike

if TYPE_CHECKING:
    from comity.testing.judging.measured import Measured
    from comity.testing.runner.result import Result

PLACE = ("conversational_distance", "approach_direction")
"""What decides where the robot stops, and with it the way there and who of a group is greeted together."""
GREETING = (
    "greeting_modality",
    "greeting_gesture",
    "greeting_language",
    "formality",
    "rhetorical_style",
    "verbal_directness",
    "speech_rate",
    "gesture_amplitude",
)
SMALL_S, SMALL_M, SMALL_ERROR_M = 0.5, 0.25, 0.10
"""Differences that nobody would notice (our choice)."""
FINE = {"s": 1, "m": 2}
"""Digits behind the point."""
LEVERAGE = 5.0
"""So many times its own share a number may change what hangs on it (our choice); a word, by any amount."""


@dataclass(frozen=True, slots=True)
class Aspect:
    """One number of an episode, and the parameters that it may hang on."""

    what: str
    value: Callable[[Measured], float]
    hangs_on: Sequence[str]
    small: float
    unit: str
    of_course: bool = True
    """Whether it hangs on how many people were served: it is compared where they were as many."""


def told(value: float, unit: str) -> str:
    """A number of seconds, metres or heads, as finely as anybody would notice."""
    return f"{value:.{FINE.get(unit, 0)}f} {unit}".rstrip()


def _error_m(one: Measured) -> float:
    """The worst among those who were reached."""
    return max(
        (abs(got - wanted) for wanted, got in one.distances_m.values() if got is not None), default=0.0
    )


ASPECTS = (
    Aspect("people served", lambda one: one.served, (), 0.0, "", of_course=False),
    Aspect("distance off the wanted one", _error_m, (), SMALL_ERROR_M, "m", of_course=False),
    Aspect("time on the way", lambda one: one.phases_s["way"], PLACE, SMALL_S, "s"),
    Aspect(
        "time of coming near",
        lambda one: one.phases_s["coming near"],
        (*PLACE, "approach_speed"),
        SMALL_S,
        "s",
    ),
    Aspect("time of the greeting", lambda one: one.phases_s["greeting"], (*GREETING, *PLACE), SMALL_S, "s"),
    Aspect("time of attending", lambda one: one.phases_s["attending"], PLACE, SMALL_S, "s"),
    Aspect("intrusion", lambda one: one.intrusion_s, PLACE, SMALL_S, "s"),
    Aspect("detour", lambda one: one.detour_m, PLACE, SMALL_M, "m"),
)


def unexplained(results: Sequence[Result]) -> tuple[UnexplainedAnswer, ...]:
    """Every difference between two profiles in the same case that no parameter and no setting explains."""
    return tuple(one for one in differences(results) if not one.settings)


def differences(results: Sequence[Result]) -> tuple[UnexplainedAnswer, ...]:
    """Every difference that no parameter explains; also where somebody's own settings may be behind it."""
    return tuple(
        found
        for (_, case), group in by_case(results).items()
        for one, other in combinations(group, 2)
        if one.measured and other.measured
        for found in _between(case, one.measured, other.measured)
    )


@dataclass(frozen=True, slots=True)
class Reach:
    """How many of the tests of single profiles a comparison is about."""

    compared: int
    alone: int
    """Of whose case no other profile was measured."""
    unmeasured: int
    """Refused, or without a plan."""
    profiles: tuple[str, ...]
    """Those of which anything was measured."""


def reach(results: Sequence[Result]) -> Reach:
    """What can be compared of tests, and what is left out."""
    groups = by_case(results).values()
    measured = {result.measured.profile for group in groups for result in group if result.measured}
    return Reach(
        compared=sum(len(group) for group in groups if len(group) > 1),
        alone=sum(len(group) for group in groups if len(group) == 1),
        unmeasured=sum(not result.measured and not result.compares for result in results),
        profiles=tuple(sorted(measured)),
    )


def _between(case: str, one: Measured, other: Measured) -> Iterator[UnexplainedAnswer]:
    as_many = one.served == other.served
    for aspect in ASPECTS:
        if aspect.of_course and not as_many:
            continue
        mine, theirs = aspect.value(one), aspect.value(other)
        if abs(mine - theirs) > aspect.small + _explained(aspect, one, other) * max(mine, theirs):
            settings = tuple(_asked_for(aspect, one, other))
            because = _because(aspect, one, other, settings)
            pair = " and ".join(
                f"{told(value, aspect.unit)} for {who.profile}"
                for value, who in ((mine, one), (theirs, other))
            )
            yield UnexplainedAnswer(
                scenario=one.scenario,
                case=case,
                what=aspect.what,
                unit=aspect.unit,
                profiles=(one.profile, other.profile),
                values=(mine, theirs),
                settings=settings,
                because=because,
                text=f"{one.scenario}: {aspect.what} {pair}; {because}",
            )


def _asked_for(aspect: Aspect, one: Measured, other: Measured) -> Iterator[str]:
    """The settings behind which a difference may stand: whether somebody is served hangs on all of them."""
    for name in sorted({*one.settings, *other.settings}):
        if one.values.get(name) != other.values.get(name) and name in (aspect.hangs_on or one.values):
            yield name


def _explained(aspect: Aspect, one: Measured, other: Measured) -> float:
    """The share of an aspect by which it may differ, as the parameters do on which it hangs."""
    pairs = [(one.values.get(name), other.values.get(name)) for name in aspect.hangs_on]
    return LEVERAGE * sum(_apart(mine, theirs) for mine, theirs in pairs)


def _apart(mine: float | str | None, theirs: float | str | None) -> float:
    """0 where they are the same, 1 where nothing more can be said than that they are not."""
    if mine == theirs:
        return 0.0
    if isinstance(mine, float | int) and isinstance(theirs, float | int):
        return abs(mine - theirs) / max(abs(mine), abs(theirs))
    return 1.0


def asked_for(settings: Sequence[str]) -> str:
    """That it is somebody's own doing."""
    return f"one of them asked for another {' and '.join(settings)}"


def _because(aspect: Aspect, one: Measured, other: Measured, settings: Sequence[str]) -> str:
    if settings:
        return asked_for(settings)
    if not aspect.hangs_on:
        return "nobody's culture may decide that"
    apart = any(one.values.get(name) != other.values.get(name) for name in aspect.hangs_on)
    return f"it may hang on {', '.join(aspect.hangs_on)}, which {'hardly' if apart else 'do not'} differ"


def spread(results: Sequence[Result]) -> Mapping[str, tuple[str, str, float]]:
    """By aspect, who has most and who has least on average over comparable cases, and how far apart."""
    compared = comparable(results)
    every, alike = (one.measured for one in compared if one.measured), served_alike(compared)
    of_all, of_alike = _by_profile(every), _by_profile(alike)
    found: dict[str, tuple[str, str, float]] = {}
    for aspect in ASPECTS:
        totals = of_alike if aspect.of_course else of_all
        means = {name: sum(map(aspect.value, all_)) / len(all_) for name, all_ in totals.items()}
        if means:
            most, least = max(means, key=lambda name: means[name]), min(means, key=lambda name: means[name])
            found[f"{aspect.what} {aspect.unit}".strip()] = (most, least, means[most] - means[least])
    return found


def _by_profile(found: Iterable[Measured]) -> Mapping[str, Sequence[Measured]]:
    profiles: dict[str, list[Measured]] = {}
    for one in found:
        profiles.setdefault(one.profile, []).append(one)
    return profiles
