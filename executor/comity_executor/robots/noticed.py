"""Detects a person's reaction to the robot in front of them, from readings and speech.

Until something is noticed the robot stands still, so that every change of distance and bearing is the
person's own motion. The thresholds are our choice: well above the effect of 3 cm noise on a filtered reading,
well below a step.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from comity_executor.robots.bearing import bearing_error_deg
from comity_executor.robots.robot import Reading, Words
from comity_fis.learning.signals import WORDS, Signal

BACK_M, IN_M, TURNED_DEG = 0.09, 0.07, 25.0
"""Changes from the first reading that count as a step back [m], leaning in [m] or turning away [deg]."""


@dataclass(frozen=True, slots=True)
class Noticed:
    """A person's signal, as the robot understood it."""

    t: float
    """Time at which it was noticed [s]."""
    kind: Signal
    distance_m: float
    """Distance between the nearest points of the two bodies at that time [m]."""


def noticed(first: Reading, now: Reading, words: Iterable[Words], t: float) -> Noticed | None:
    """The signal that a person shows, or None.

    Args:
        first: The reading when the robot came to rest next to the person.
        now: The current reading; the robot has not moved since the first.
        words: What the person has said since.
        t: The current time [s].
    """
    kind = _heard(words) or _seen(first, now)
    return Noticed(t, kind, first.distance_m) if kind else None


def _heard(words: Iterable[Words]) -> Signal | None:
    """The first request; case is ignored in the phrases of the scenario's people."""
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
