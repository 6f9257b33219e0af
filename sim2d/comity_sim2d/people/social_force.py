"""The social force model: attraction to a goal, repulsion from other people and from walls.

Helbing and Molnar 1995, "Social force model for pedestrian dynamics", Physical Review E 51, 4282, with the
interaction that Moussaid et al. 2009 measured between people who evade one another ("Experimental study of
the behavioural mechanisms underlying self-organization in human crowds", Proceedings of the Royal Society B
276, 2755-2762). Positions and velocities are complex numbers, x + iy, in arrays of any shape.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.complex128]
"""Positions [m], velocities [m/s] or accelerations [m/s^2] in the plane, x + iy."""
Numbers = NDArray[np.float64]

RELAXATION_S = 0.54
"""Relaxation time in which people reach their target velocity [s] (Moussaid et al. 2009)."""
FASTEST = 1.3
"""Maximum speed as a multiple of a person's target speed (Helbing and Molnar 1995)."""
STRENGTH_M_S2, IMPORTANCE, REACH_M = 4.5, 2.0, 0.35
"""A, lambda and gamma of Moussaid et al. 2009: strength [m/s^2], weight of the relative velocity, and range
[m]. Lambda, gamma, n and n' are also the values that libpedsim (`ped_agent.cpp`) takes from that paper, and
those of lightsfm (`sfm.hpp`), which HuNavSim uses; both have a factor of 2.1 in place of A."""
TURNING, SLOWING = 2.0, 3.0
"""n and n': angular widths of the fields in which people turn aside and slow down (Moussaid et al. 2009)."""
NARROWNESS = np.array([[SLOWING**2], [TURNING**2]])
BIAS = 0.005
"""epsilon: preference for one side if both are equally good. The preference was measured by Moussaid et al.
2009; the value is our choice: just enough to break ties."""
WALL_M_S2, WALL_REACH_M = 3.0, 0.1
"""Strength [m/s^2] and range [m] of the repulsion from walls: our choice; lightsfm takes 10 and 0.2 m
(`sfm.hpp`)."""
SHOULDERS_M = 0.40
"""Sum of two radii of 0.20 m [m]. The interaction was measured between centres; larger bodies interact
earlier by the difference (our choice)."""


def between(towards: Vectors, gap_m: Numbers, closing: Vectors, side: float = 1.0) -> Vectors:
    """The repulsion of one person by another; the other's is opposite.

    Args:
        towards: Unit vectors from the first person to the second.
        gap_m: Gap between their bodies [m].
        closing: Velocity of the first person relative to the second [m/s].
        side: 1 where people keep to the right, -1 to the left.

    Returns:
        The acceleration of the first person [m/s^2].
    """
    interaction = IMPORTANCE * closing + towards
    length = np.maximum(np.abs(interaction), 1e-9)
    along = interaction / length
    reach = REACH_M * length
    off = towards * along.conj()
    aside = np.where(off.imag == 0.0, side * 0.0, off.imag)  # straight behind, the sign of a zero decides
    spread = reach * (np.arctan2(aside, off.real) + (side * BIAS) * reach)
    fields = np.exp((gap_m + SHOULDERS_M) / -reach - NARROWNESS * (spread * spread))
    force = np.empty_like(along)
    force.real, force.imag = fields[0], np.copysign(fields[1], spread)
    return np.asarray(force * along * -STRENGTH_M_S2)


def from_wall(away: Vectors, gap_m: Numbers) -> Vectors:
    """The repulsion from walls, furniture and other objects [m/s^2].

    Args:
        away: Unit vectors from the object to the person.
        gap_m: Gap between the person's body and the object [m].
    """
    return np.asarray(away * (WALL_M_S2 * np.exp(gap_m / -WALL_REACH_M)))


def towards_goal(wanted: Vectors, velocity: Vectors) -> Vectors:
    """The acceleration towards the target velocity [m/s^2]."""
    return np.asarray((wanted - velocity) * (1.0 / RELAXATION_S))
