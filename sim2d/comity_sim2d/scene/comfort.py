"""A person's preferred distances, and their signals of discomfort: hidden from the robot."""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.learning.signals import SIGNALS, Signal
from comity_sim2d.scene_error import SceneError, require_between, require_tuple

NEAREST_M, FARTHEST_M = (0.0, 10.0), 20.0
"""Where the nearer end of an interval can be, and how far out the farther one (our choice)."""
NARROWEST_M = 0.05
"""No interval is narrower: it would be left by the noise of standing (our choice)."""
SEATED: tuple[Signal, ...] = ("ask_farther", "turn_away", "ask_closer")
"""Signals of a seated person, who does not step."""


@dataclass(frozen=True, slots=True)
class Comfort:
    """The distances at which a person is at ease, between the nearest points of the two bodies."""

    near_m: float
    """Nearer is too close."""
    far_m: float
    """Farther is too far."""
    shows: tuple[Signal, ...] = SIGNALS[:-1]
    """What this person does about a discomfort; nothing for one of which none of these speaks."""
    chance: float = 1.0
    """Of doing anything about a discomfort at all, in [0, 1]."""

    def __post_init__(self) -> None:
        require_between("comfort", "near_m", self.near_m, *NEAREST_M)
        require_between("comfort", "far_m", self.far_m, self.near_m + NARROWEST_M, FARTHEST_M)
        require_between("comfort", "chance", self.chance, 0.0, 1.0)
        require_tuple("comfort", "shows", self.shows, str, "signals")
        for signal in self.shows:
            if signal not in SIGNALS:
                raise SceneError(
                    entity="comfort",
                    field="shows",
                    expected=f"signals out of {', '.join(SIGNALS)}",
                    got=repr(signal),
                    remedy="Choose among them.",
                )
