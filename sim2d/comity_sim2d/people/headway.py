"""Headway: in a stream, people walk no faster than the gap to the person ahead allows.

The time gap is that of the collision-free speed model (Tordeux, Chraibi and Seyfried 2016, "Collision-free
speed model for pedestrian dynamics", Traffic and Granular Flow '15, 225-232). With the social force alone,
people in a stream walk at full speed at densities at which real people slow down (Weidmann 1993,
"Transporttechnik der Fussgaenger").
"""

from __future__ import annotations

import numpy as np

from comity_sim2d.people.near import Near
from comity_sim2d.people.social_force import Vectors

TIME_GAP_S = 0.6
"""Minimum time to cover the gap ahead [s]. Fitted to Weidmann's diagram with bodies of 0.4 m, by
`tests/crowd_study.py`; Tordeux et al. take 1 s for bodies of 0.3 m, which no other force pushes."""


def within_headway(wanted: Vectors, facing: Vectors, near: Near) -> Vectors:
    """The target velocities, reduced behind people who walk in the same direction [m/s].

    A person is ahead if their body reaches into the strip that one's own body is about to cover. People who
    come the other way or stand do not count: others evade them.

    Args:
        wanted: Target velocities of all bodies [m/s], shape (n,); 0 for those who do not walk.
        facing: Unit vectors of the facing, shape (n,); 0 for those who stand.
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
