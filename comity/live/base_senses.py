"""What a robot says of its place and of people, as far as it can be believed.

A call that raises, and numbers that are none, count as silence: a robot that hears nothing for long stands.
"""

from __future__ import annotations

from contextlib import suppress
from math import isfinite
from numbers import Real
from typing import TYPE_CHECKING

from comity_sim2d import Person, wrap_angle

if TYPE_CHECKING:
    from comity_executor import Localisation, MapRobot, PersonTrack


def localisation_of(base: MapRobot) -> Localisation | None:
    """Where it is; None where it does not know, raises, or says what is no place."""
    with suppress(Exception):
        here = base.localisation()
        numbers = () if here is None else (here.x_m, here.y_m, here.heading_rad, here.speed_m_s, here.stamp_s)
        return here if _are_finite(*numbers) else None
    return None


def tracks_of(base: MapRobot) -> list[PersonTrack] | None:
    """Whom it sees; None where it raises or is silent. A track that is nowhere is left out."""
    with suppress(Exception):
        tracks = base.tracks()
        return None if tracks is None else [track for track in tracks if _is_somewhere(track)]
    return None


def stranger(track: PersonTrack) -> Person:
    """Somebody of whom nothing is known but where they are."""
    return Person(f"track {track.track}", track.x_m, track.y_m, wrap_angle(track.heading_rad or 0.0))


def _is_somewhere(track: PersonTrack) -> bool:
    numbers = (track.x_m, track.y_m, track.stamp_s, *track.velocity_m_s)
    return _are_finite(*numbers, 0.0 if track.heading_rad is None else track.heading_rad)


def _are_finite(*numbers: object) -> bool:
    return all(isinstance(number, Real) and isfinite(float(number)) for number in numbers)
