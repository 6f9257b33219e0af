"""Differences between profiles, and which of them no parameter explains.

An episode follows from the parameters: people with the same parameters are served equally. Two profiles may
therefore differ only in metrics that depend on a parameter that differs, and by a relative amount similar to
the parameter's: a distance larger by 1 % does not justify twice the time. Whether a person is served, and how
closely their preferred distance is met, depend on no parameter: that is a principle of the design. Any other
difference is flagged. Differences that a person's own settings may cause are reported separately, because the
person asked for them. A setting explains only metrics that depend on its parameter.
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
"""Parameters that decide where the robot stops, and so its path and who of a group is greeted together."""
ACTS = ("greeting_modality", "greeting_gesture", "greeting_language")
"""Parameters that decide whether the robot can greet at all; the others affect the duration of a greeting."""
GREETING = (
    *ACTS,
    "formality",
    "rhetorical_style",
    "verbal_directness",
    "speech_rate",
    "gesture_amplitude",
)
SMALL_S, SMALL_M, SMALL_ERROR_M = 0.5, 0.25, 0.10
"""Differences too small to notice [s], [m], [m] (our choice)."""
FINE = {"s": 1, "m": 2}
"""Decimals by unit."""
LEVERAGE = 5.0
"""Maximum ratio between the relative change of a metric and that of a parameter it depends on (our choice); a
nominal parameter explains any change."""


@dataclass(frozen=True, slots=True)
class Aspect:
    """One metric of an episode, and the parameters that it depends on."""

    what: str
    metric: str
    """Its name in `TESTED`."""
    bears: Sequence[str]
    """Parameters that affect it."""
    small: float
    owed: bool = False
    """Whether everybody is entitled to the same value: then no parameter explains a difference, except a
    setting that a person asked for. Other metrics are compared only where equally many people were served."""

    def value(self, one: Measured) -> float:
        """Value of the metric in an episode."""
        return float(getattr(one, self.metric))

    @property
    def unit(self) -> str:
        """Unit in sentences; empty for a count."""
        return TESTED[self.metric].unit.removeprefix("1")

    @property
    def hangs_on(self) -> Sequence[str]:
        """The parameters that explain a difference."""
        return () if self.owed else self.bears


def told(value: float, unit: str) -> str:
    """A number of seconds, metres or people, to a noticeable precision."""
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
    """Every difference that no parameter explains, including those that a person's own settings may cause."""
    return tuple(found for case, one, other in _pairs(results) for found in _between(case, one, other))


def too_small(results: Sequence[Result]) -> tuple[Aspect, ...]:
    """Metrics with unexplained differences that are omitted because they are small."""
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
    """Thresholds below which a difference in each metric is omitted, in words."""
    return ", ".join(f"{one.what} up to {told(one.small, one.unit)}" for one in aspects)


@dataclass(frozen=True, slots=True)
class Reach:
    """Coverage of a comparison: which tests of single profiles it includes."""

    compared: int
    alone: int
    """Number of tests without another measured profile in their case."""
    unmeasured: int
    """Number of tests that were refused, or had no plan."""
    profiles: tuple[str, ...]
    """Profiles with measured tests."""
    apart: tuple[tuple[str, str], ...]
    """Pairs of profiles that share no case, though each is compared with others."""


def reach(results: Sequence[Result]) -> Reach:
    """Which tests can be compared, and which are left out."""
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
    """Every pair of profiles in the same case, with the case's name."""
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
    """Settings that may cause a difference: those that differ and affect the metric."""
    for name in sorted({*one.settings, *other.settings}):
        if one.values.get(name) != other.values.get(name) and name in aspect.bears:
            yield name


def _unexplained(aspect: Aspect, one: Measured, other: Measured) -> float:
    """The part of a difference that the parameters do not explain."""
    mine, theirs = aspect.value(one), aspect.value(other)
    return abs(mine - theirs) - _explained(aspect, one, other) * max(mine, theirs)


def _explained(aspect: Aspect, one: Measured, other: Measured) -> float:
    """Relative difference that the parameters explain, from their own differences."""
    pairs = [(one.values.get(name), other.values.get(name)) for name in aspect.hangs_on]
    return LEVERAGE * sum(_apart(mine, theirs) for mine, theirs in pairs)


def _apart(mine: float | str | None, theirs: float | str | None) -> float:
    """Relative difference of two values: 0 if equal, 1 if nominal or otherwise incomparable."""
    if mine == theirs:
        return 0.0
    if isinstance(mine, float | int) and isinstance(theirs, float | int):
        return abs(mine - theirs) / max(abs(mine), abs(theirs))
    return 1.0


def asked_for(settings: Sequence[str]) -> str:
    """Note that a difference is due to a person's own settings."""
    return f"one of them asked for another {listed(settings)}"


def _because(aspect: Aspect, one: Measured, other: Measured, settings: Sequence[str]) -> str:
    if settings:
        return asked_for(settings)
    if not aspect.hangs_on:
        return "nobody's culture may decide that"
    apart = any(one.values.get(name) != other.values.get(name) for name in aspect.hangs_on)
    return f"it may hang on {', '.join(aspect.hangs_on)}, which {'hardly' if apart else 'do not'} differ"


def spread(results: Sequence[Result]) -> Mapping[str, tuple[str, str, float]]:
    """By metric, the profiles with the highest and lowest mean over shared cases, and the difference."""
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
