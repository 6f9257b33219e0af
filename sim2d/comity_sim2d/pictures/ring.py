"""The target and the actual pose next to one person."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.kinds import require_kinds, require_numbers
from comity_sim2d.scene_error import FARTHEST_M, require_between, require_finite, require_text


@dataclass(frozen=True, slots=True)
class Ring:
    """One visit, as pictures show it."""

    person: str
    wanted_m: float
    """Target distance between the nearest points of the two bodies [m]."""
    reached_m: float | None = None
    """Actual distance [m]; None if the robot did not get there."""
    bearing_deg: float = 0.0
    """Target bearing, which marks the chosen side [deg]."""
    label: str | None = None
    """Lines for the card, such as the person's profile and the reason for a deviation."""
    time_s: float | None = None
    """Time when the robot stood there [s]; None: when its first act towards the person began, or at the
    end."""
    reached_bearing_deg: float | None = None
    """Bearing of the robot then, as seen by the person [deg]; None: from the frames."""
    facing_error_deg: float | None = None
    """Error of the robot's facing then, in [0, 180] [deg]; None: from the frames."""

    def __post_init__(self) -> None:
        require_text("ring", "person", self.person)
        require_between(self.person, "wanted_m", self.wanted_m, 0.0, FARTHEST_M)
        require_finite(self.person, bearing_deg=self.bearing_deg)
        require_kinds(self.person, label=(self.label, str | None))
        require_numbers(
            self.person,
            reached_m=self.reached_m,
            time_s=self.time_s,
            reached_bearing_deg=self.reached_bearing_deg,
            facing_error_deg=self.facing_error_deg,
        )
