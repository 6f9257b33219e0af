"""The social force model: attraction to a goal, and repulsion from one another and from walls.

Helbing and Molnar 1995, "Social force model for pedestrian dynamics", Physical Review E 51, 4282, with the
interaction that Moussaid et al. 2009 measured between people who evade one another ("Experimental study of
the behavioural mechanisms underlying self-organization in human crowds", Proceedings of the Royal Society B
276, 2755-2762). Places and velocities are complex numbers, x + iy, in arrays of any shape.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.complex128]
"""Places [m], velocities [m/s] or accelerations [m/s^2] in the plane, x + iy."""
Numbers = NDArray[np.float64]

RELAXATION_S = 0.54
"""In this time people take up the velocity that they want (Moussaid et al. 2009)."""
FASTEST = 1.3
"""Maximum speed as a multiple of a person's target speed (Helbing and Molnar 1995)."""
STRENGTH_M_S2, IMPORTANCE, REACH_M = 4.5, 2.0, 0.35
"""A, lambda and gamma of Moussaid et al. 2009: how strong, how much the velocities count, how far.
Lambda, gamma, n and n' are also those that libpedsim (`ped_agent.cpp`) takes from that paper, and those of
lightsfm (`sfm.hpp`), in which the people of HuNavSim walk; both have a factor of 2.1 in the place of A."""
TURNING, SLOWING = 2.0, 3.0
"""n and n': how narrow the field is in which people turn aside and slow down (Moussaid et al. 2009)."""
NARROWNESS = np.array([[SLOWING**2], [TURNING**2]])
BIAS = 0.005
"""epsilon: preference for one side where both are equally good. That there is a preference is what Moussaid
et al. 2009 measured; the number is our choice: enough to decide where both are equal."""
WALL_M_S2, WALL_REACH_M = 3.0, 0.1
"""How strong walls push, and how far: our choice; lightsfm takes 10 and 0.2 m (`sfm.hpp`)."""
SHOULDERS_M = 0.40
"""The interaction was measured between centres. Bodies that are together wider than two people of 0.20 m meet
earlier by the difference: our choice."""


def between(towards: Vectors, gap_m: Numbers, closing: Vectors, side: float = 1.0) -> Vectors:
    """What one person does about another; the other does the opposite.

    Args:
        towards: Unit vectors from the one to the other.
        gap_m: Between their bodies.
        closing: The velocity of the one less that of the other.
        side: 1 where people keep to the right, -1 to the left.

    Returns:
        The acceleration of the one.
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
    """What people do about walls, furniture and whatever else is a thing to them.

    Args:
        away: Unit vectors from the thing to the person.
        gap_m: Between the person's body and the thing.
    """
    return np.asarray(away * (WALL_M_S2 * np.exp(gap_m / -WALL_REACH_M)))


def towards_goal(wanted: Vectors, velocity: Vectors) -> Vectors:
    """How people take up the velocity that they want."""
    return np.asarray((wanted - velocity) * (1.0 / RELAXATION_S))
