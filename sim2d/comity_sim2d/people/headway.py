"""Headway: in a stream, people go no faster than the gap to the person ahead allows.

The time gap is that of the collision-free speed model (Tordeux, Chraibi and Seyfried 2016, "Collision-free
speed model for pedestrian dynamics", Traffic and Granular Flow '15, 225-232). The social force alone lets a
stream of people go at full speed at densities at which real people walk more slowly (Weidmann 1993,
"Transporttechnik der Fussgaenger").
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.near import Near
from comity_sim2d.people.social_force import Vectors

TIME_GAP_S = 0.6
"""The gap ahead is covered in no less time. Fitted to Weidmann's diagram with bodies of 0.4 m, by
`tests/crowd_study.py`; Tordeux et al. take 1 s for bodies of 0.3 m, which no other force pushes."""


def within_headway(wanted: Vectors, facing: Vectors, near: Near) -> Vectors:
    """The velocities that people want, slowed down behind those who go the same way.

    A person is ahead whose body reaches into the strip that one's own body is about to cover. People who come
    the other way or stand do not count: people evade them.

    Args:
        wanted: Of all bodies, shape (n,); 0 of those who do not walk.
        facing: Unit vectors of the facings, shape (n,); 0 of those who stand.
        near: The pairs of near bodies.
    """
    pace = np.abs(wanted)
    direction = wanted / np.maximum(pace, 1e-9)
    most_m_s = np.full(len(wanted), np.inf)
    for who, other, there in ((near.one, near.other, near.towards), (near.other, near.one, -near.towards)):
        along = there * direction[who].conj()
        is_ahead = (along.real > 0.0) & (np.abs(along.imag) * (near.gap_m + near.width_m) <= near.width_m)
        is_ahead &= (direction[who] * facing[other].conj()).real > 0.0
        np.minimum.at(most_m_s, who[is_ahead], np.maximum(near.gap_m[is_ahead], 0.0) / TIME_GAP_S)
    return np.asarray(direction * np.minimum(pace, most_m_s))
