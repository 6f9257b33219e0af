"""What a robot that stands before a person notices of how they take it: from its readings and its ears.

Until something is noticed the robot stands still, so that every change of the distance and the bearing is the
person's own doing. Thresholds are this project's own choice: well above what noise of 3 cm leaves in a
filtered reading, well below a step.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from comity_executor.robots.bearing import bearing_error_deg
from comity_executor.robots.robot import Reading, Words
from comity_fis.learning.signals import WORDS, Signal

BACK_M, IN_M, TURNED_DEG = 0.09, 0.07, 25.0
"""So much farther, nearer or turned than at first is a step back, a leaning in, or a turning away."""


@dataclass(frozen=True, slots=True)
class Noticed:
    """One signal of a person, as the robot understood it."""

    t: float
    """When it was noticed."""
    kind: Signal
    distance_m: float
    """Where the robot stood when it was shown, between the nearest points of the two bodies."""


def noticed(first: Reading, now: Reading, words: Iterable[Words], t: float) -> Noticed | None:
    """The signal that a person shows, if any.

    Args:
        first: What the robot read when it had come to rest before the person.
        now: What it reads now, having stood still since.
        words: What the person has said since.
        t: The time now.
    """
    kind = _heard(words) or _seen(first, now)
    return Noticed(t, kind, first.distance_m) if kind else None


def _heard(words: Iterable[Words]) -> Signal | None:
    """The first request; the words are those of the scenario's people, whatever their capitals."""
    requests: dict[str, Signal] = {text.casefold(): signal for signal, text in WORDS.items()}
    for said in words:
        if said.text.casefold() in requests:
            return requests[said.text.casefold()]
    return None


def _seen(first: Reading, now: Reading) -> Signal | None:
    moved_m = now.distance_m - first.distance_m
    if moved_m > BACK_M:
        return "step_back"
    if moved_m < -IN_M:
        return "lean_in"
    return "turn_away" if bearing_error_deg(now.bearing_deg, first.bearing_deg) > TURNED_DEG else None
