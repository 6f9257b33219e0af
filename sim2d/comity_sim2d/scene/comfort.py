"""A person's preferred distances, and their signals of discomfort: hidden from the robot."""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.learning.signals import SIGNALS, Signal
from comity_sim2d.scene_error import SceneError, require_between, require_tuple

NEAREST_M, FARTHEST_M = (0.0, 10.0), 20.0
"""Range of the near end of an interval, and maximum of its far end [m] (our choice)."""
NARROWEST_M = 0.05
"""Minimum width of an interval [m]: the sway of standing would leave a narrower one (our choice)."""
SEATED: tuple[Signal, ...] = ("ask_farther", "turn_away", "ask_closer")
"""Signals of a seated person, who does not step."""


@dataclass(frozen=True, slots=True)
class Comfort:
    """The distances at which a person is at ease, between the nearest points of the two bodies."""

    near_m: float
    """Smaller distances are too close [m]."""
    far_m: float
    """Larger distances are too far [m]."""
    shows: tuple[Signal, ...] = SIGNALS[:-1]
    """Signals that this person gives; no reaction to a discomfort without a matching signal."""
    chance: float = 1.0
    """Probability of reacting to a discomfort at all, in [0, 1]."""

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
