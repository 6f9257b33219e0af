"""Differences between profiles, and which of them no parameter explains.

An episode is a consequence of the parameters: people with the same ones are served alike. What may differ
between two profiles is therefore what hangs on a parameter that differs between them, and by a share that is
like that of the parameter: a hundredth of the distance is no reason for twice the time. Whether a person is
served, and as near as they would have it, hangs on none: that is the design's law. Anything else is flagged,
but for what a person's own settings may bring about, which is told by itself: they asked for it. A setting
brings about only what its parameter bears on.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from comity.testing.measuring.measured import TESTED
from comity.testing.reporting.answers import UnexplainedAnswer
from comity.testing.reporting.summary import by_case, served_alike, shared
from comity_fis.listing import listed

if TYPE_CHECKING:
    from comity.testing.measuring.measured import Measured
    from comity.testing.runner.result import Result

PLACE = ("conversational_distance", "approach_direction")
"""What decides where the robot stops, and with it the way there and who of a group is greeted together."""
ACTS = ("greeting_modality", "greeting_gesture", "greeting_language")
"""What decides whether the robot can greet at all; the rest of a greeting, how long that takes."""
GREETING = (
    *ACTS,
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
    """One number of an episode, and the parameters that bear on it."""

    what: str
    metric: str
    """Its name in `TESTED`."""
    bears: Sequence[str]
    """Parameters by which it may come out otherwise."""
    small: float
    owed: bool = False
    """Whether everybody is owed the same: then no parameter explains a difference, and only what a person
    asked for may be behind it. Anything else is compared where as many people were served."""

    def value(self, one: Measured) -> float:
        """Of an episode."""
        return float(getattr(one, self.metric))

    @property
    def unit(self) -> str:
        """As sentences have it: none of a count."""
        return TESTED[self.metric].unit.removeprefix("1")

    @property
    def hangs_on(self) -> Sequence[str]:
        """The parameters that explain a difference."""
        return () if self.owed else self.bears


def told(value: float, unit: str) -> str:
    """A number of seconds, metres or heads, as finely as anybody would notice."""
    return f"{value:.{FINE.get(unit, 0)}f} {unit}".rstrip()


ASPECTS = (
    Aspect("people served", "served", (*PLACE, *ACTS), 0.0, owed=True),
    Aspect("distance off the wanted one", "distance_error_m", PLACE, SMALL_ERROR_M, owed=True),
    Aspect("time on the way", "way_s", PLACE, SMALL_S),
    Aspect("time of coming near", "coming_near_s", (*PLACE, "approach_speed"), SMALL_S),
    Aspect("time of the greeting", "greeting_s", (*GREETING, *PLACE), SMALL_S),
    Aspect("time of attending", "attending_s", PLACE, SMALL_S),
    Aspect("intrusion", "intrusion_s", PLACE, SMALL_S),
    Aspect("detour", "detour_m", PLACE, SMALL_M),
)


def differences(results: Sequence[Result]) -> tuple[UnexplainedAnswer, ...]:
    """Every difference that no parameter explains; also where a person's own settings may be behind it."""
    return tuple(found for case, one, other in _pairs(results) for found in _between(case, one, other))


def too_small(results: Sequence[Result]) -> tuple[Aspect, ...]:
    """Of what there are differences that no parameter explains, and that are left out for being small."""
    pairs = [(one, other) for _, one, other in _pairs(results)]
    return tuple(
        aspect
        for aspect in ASPECTS
        if any(
            _comparable(aspect, *pair)
            and (excess := _unexplained(aspect, *pair)) <= aspect.small
            and round(excess, FINE.get(aspect.unit, 0)) > 0
            for pair in pairs
        )
    )


def thresholds(aspects: Iterable[Aspect]) -> str:
    """Up to what a difference in each is left out."""
    return ", ".join(f"{one.what} up to {told(one.small, one.unit)}" for one in aspects)


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
    apart: tuple[tuple[str, str], ...]
    """Profiles that are compared with others, and not with each other, as they share no case."""


def reach(results: Sequence[Result]) -> Reach:
    """What can be compared of tests, and what is left out."""
    groups = by_case(results).values()
    names = [sorted(result.measured.profile for result in group if result.measured) for group in groups]
    together = {pair for group in names for pair in combinations(group, 2)}
    beside = sorted({name for pair in together for name in pair})
    return Reach(
        compared=sum(len(group) for group in groups if len(group) > 1),
        alone=sum(len(group) for group in groups if len(group) == 1),
        unmeasured=sum(not result.measured and not result.compares for result in results),
        profiles=tuple(sorted({name for group in names for name in group})),
        apart=tuple(pair for pair in combinations(beside, 2) if pair not in together),
    )


def _pairs(results: Sequence[Result]) -> Iterator[tuple[str, Measured, Measured]]:
    """Every two profiles in the same case, with its name."""
    for (_, case), group in by_case(results).items():
        for one, other in combinations(group, 2):
            if one.measured and other.measured:
                yield case, one.measured, other.measured


def _comparable(aspect: Aspect, one: Measured, other: Measured) -> bool:
    return aspect.owed or one.served == other.served


def _between(case: str, one: Measured, other: Measured) -> Iterator[UnexplainedAnswer]:
    for aspect in ASPECTS:
        if _comparable(aspect, one, other) and _unexplained(aspect, one, other) > aspect.small:
            mine, theirs = aspect.value(one), aspect.value(other)
            settings = tuple(_asked_for(aspect, one, other))
            because = _because(aspect, one, other, settings)
            pair = listed(
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
    """The settings that may be behind a difference: those that differ, of what bears on it."""
    for name in sorted({*one.settings, *other.settings}):
        if one.values.get(name) != other.values.get(name) and name in aspect.bears:
            yield name


def _unexplained(aspect: Aspect, one: Measured, other: Measured) -> float:
    """By how much it differs beyond what the parameters explain."""
    mine, theirs = aspect.value(one), aspect.value(other)
    return abs(mine - theirs) - _explained(aspect, one, other) * max(mine, theirs)


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
    """That it is a person's own doing."""
    return f"one of them asked for another {listed(settings)}"


def _because(aspect: Aspect, one: Measured, other: Measured, settings: Sequence[str]) -> str:
    if settings:
        return asked_for(settings)
    if not aspect.hangs_on:
        return "nobody's culture may decide that"
    apart = any(one.values.get(name) != other.values.get(name) for name in aspect.hangs_on)
    return f"it may hang on {', '.join(aspect.hangs_on)}, which {'hardly' if apart else 'do not'} differ"


def spread(results: Sequence[Result]) -> Mapping[str, tuple[str, str, float]]:
    """By aspect, who has most and who has least on average over shared cases, and how far apart."""
    compared = shared(results).tests
    every, alike = (one.measured for one in compared if one.measured), served_alike(compared)
    of_all, of_alike = _by_profile(every), _by_profile(alike)
    found: dict[str, tuple[str, str, float]] = {}
    for aspect in ASPECTS:
        totals = of_all if aspect.owed else of_alike
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
