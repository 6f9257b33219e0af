"""Differences between profiles, and which of them no parameter explains.

An episode is a consequence of the parameters: whoever gets the same ones is served alike. What may differ
between two profiles is therefore what hangs on a parameter that differs between them. Whether somebody is
served hangs on none: that is the design's law. Anything else is flagged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from comity.testing.answers import UnexplainedAnswer
from comity.testing.summary import comparable

if TYPE_CHECKING:
    from comity.testing.measured import Measured
    from comity.testing.result import Result

PLACE = ("conversational_distance", "approach_direction")
"""What decides where the robot stops, and with it the way there."""
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
SMALL_S, SMALL_M = 0.5, 0.25
"""Differences that nobody would notice (our choice)."""


@dataclass(frozen=True, slots=True)
class Aspect:
    """One number of an episode, and the parameters that it may hang on."""

    what: str
    value: Callable[[Measured], float]
    hangs_on: Sequence[str]
    small: float
    unit: str


ASPECTS = (
    Aspect("people served", lambda one: one.served, (), 0.0, ""),
    Aspect("time on the way", lambda one: one.phases_s["way"], PLACE, SMALL_S, "s"),
    Aspect(
        "time of coming near",
        lambda one: one.phases_s["coming near"],
        (*PLACE, "approach_speed"),
        SMALL_S,
        "s",
    ),
    Aspect("time of the greeting", lambda one: one.phases_s["greeting"], GREETING, SMALL_S, "s"),
    Aspect("time of attending", lambda one: one.phases_s["attending"], PLACE, SMALL_S, "s"),
    Aspect("intrusion", lambda one: one.intrusion_s, PLACE, SMALL_S, "s"),
    Aspect("detour", lambda one: one.detour_m, PLACE, SMALL_M, "m"),
)


def unexplained(results: Sequence[Result]) -> tuple[UnexplainedAnswer, ...]:
    """Every difference between two profiles in the same case that no parameter explains."""
    groups: dict[tuple[str, str], list[Measured]] = {}
    for result in results:
        if result.measured:
            rest = result.id.replace(f"[{result.measured.profile}-", "[", 1)
            groups.setdefault((str(result.path), rest), []).append(result.measured)
    return tuple(
        found
        for group in groups.values()
        for one, other in combinations(group, 2)
        for found in _between(one, other)
    )


def _between(one: Measured, other: Measured) -> Iterator[UnexplainedAnswer]:
    differing = {name for name in one.values if one.values[name] != other.values.get(name)}
    for aspect in ASPECTS:
        mine, theirs = aspect.value(one), aspect.value(other)
        if abs(mine - theirs) > aspect.small and not differing & set(aspect.hangs_on):
            yield UnexplainedAnswer(
                scenario=one.scenario,
                what=aspect.what,
                profiles=(one.profile, other.profile),
                values=(mine, theirs),
                text=_text(aspect, one, other),
            )


def _text(aspect: Aspect, one: Measured, other: Measured) -> str:
    mine, theirs = (f"{aspect.value(each):g} {aspect.unit}".strip() for each in (one, other))
    because = "nobody's culture may decide that"
    if aspect.hangs_on:
        because = f"it may hang on {', '.join(aspect.hangs_on)}, which do not differ"
    return (
        f"{one.scenario}: {aspect.what} {mine} for {one.profile} and {theirs} for {other.profile}; {because}"
    )


def spread(results: Sequence[Result]) -> Mapping[str, tuple[str, str, float]]:
    """By aspect, who has most and who has least on average over comparable cases, and how far apart."""
    totals: dict[str, list[Measured]] = {}
    for result in comparable(results):
        if result.measured:
            totals.setdefault(result.measured.profile, []).append(result.measured)
    found: dict[str, tuple[str, str, float]] = {}
    for aspect in ASPECTS:
        means = {name: sum(map(aspect.value, all_)) / len(all_) for name, all_ in totals.items()}
        if means:
            most, least = max(means, key=lambda name: means[name]), min(means, key=lambda name: means[name])
            found[f"{aspect.what} {aspect.unit}".strip()] = (most, least, means[most] - means[least])
    return found
