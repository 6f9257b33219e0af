"""What was wanted and what was reached beside one person."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.kinds import require_kinds, require_numbers
from comity_sim2d.scene_error import FARTHEST_M, require_between, require_finite, require_text


@dataclass(frozen=True, slots=True)
class Ring:
    """One visit, as pictures show it."""

    person: str
    wanted_m: float
    """Between the nearest points of the two bodies."""
    reached_m: float | None = None
    """None where the robot did not get there."""
    bearing_deg: float = 0.0
    """The wanted bearing: it marks the chosen side."""
    label: str | None = None
    """Lines for the card, such as the person's profile and the reason for a deviation."""
    time_s: float | None = None
    """When the robot stood there; None: when its first act towards the person began, or at the end."""
    reached_bearing_deg: float | None = None
    """Where the robot stood then, as the person saw it; None: as the frames have it."""
    facing_error_deg: float | None = None
    """How far it looked past the person then, in [0, 180]; None: as the frames have it."""

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
