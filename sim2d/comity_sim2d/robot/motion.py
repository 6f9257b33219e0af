"""What a robot says of itself: how its motion goes, and what it reads of people."""

from __future__ import annotations

from typing import NamedTuple


class Reading(NamedTuple):
    """What the robot knows about one person: its sensors' filtered estimate."""

    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    person_facing_error_deg: float
    speed_m_s: float
    stamp_s: float


class Motion(NamedTuple):
    """How the last motion command goes."""

    state: str
    """`idle`, `moving`, `arrived` or `blocked`."""
    text: str = ""
    blocked_by: tuple[str, ...] = ()
    """The people in the way."""
