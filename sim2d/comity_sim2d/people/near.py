"""Pairs of nearby bodies, and of bodies and nearby lines; in arrays."""

from __future__ import annotations

from typing import NamedTuple

from comity_sim2d.people.neighbours import Indices
from comity_sim2d.people.social_force import Numbers, Vectors


class Near(NamedTuple):
    """One row for each of the k pairs of bodies, and for each of the m pairs of a body and a line."""

    one: Indices
    other: Indices
    towards: Vectors
    """Unit vectors from the first body to the second, shape (k,)."""
    gap_m: Numbers
    """Gap between the two bodies [m], shape (k,)."""
    width_m: Numbers
    """Sum of the radii [m], shape (k,)."""
    who: Indices
    away: Vectors
    """Unit vectors from the line to the body's centre, shape (m,)."""
    wall_gap_m: Numbers
    """Gap between the body and the line [m], shape (m,)."""
