"""Integrals over many panels at once by Gauss and Kronrod's rule: 15 places, of which 7 estimate the error.

Kronrod, "Nodes and weights of quadrature formulas" (1965); the numbers as in QUADPACK (Piessens et al. 1983).
No place is an end of its panel, where an edge may be vertical.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_OUTER = np.array(
    [
        (0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0.0),
        (0.949107912342758524526189684047851, 0.063092092629978553290700663189204, 0.12948496616886969),
        (0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0.0),
        (0.741531185599394439863864773280788, 0.140653259715525918745189590510238, 0.27970539148927664),
        (0.586087235467691130294144838258730, 0.169004726639267902826583426598550, 0.0),
        (0.405845151377397166906606412076961, 0.190350578064785409913256402421014, 0.38183005050511892),
        (0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0.0),
    ]
)
"""Of the places above the middle of [-1, 1]: the place, Kronrod's weight and Gauss's."""

_MIDDLE = np.array([[0.0, 0.209482141084727828012999174891714, 0.41795918367346940]])
_ALL = np.vstack([-_OUTER * [1, -1, -1], _MIDDLE, _OUTER[::-1]])

NODES = _ALL[:, 0]
"""Ascending."""

_WEIGHTS = np.column_stack([_ALL[:, 1], _ALL[:, 1] * NODES, _ALL[:, 2], _ALL[:, 2] * NODES])
"""Of area and moment about the middle, by Kronrod and by Gauss."""


class Integrals(NamedTuple):
    """What is under a function in many panels."""

    area: Floats
    moment: Floats
    """About the origin."""
    error: Floats
    """Of area, and of moment as a part of the span: the larger one."""


def places_in(left: Floats, right: Floats) -> Floats:
    """The 15 places in each panel, in a new last axis."""
    middle, half = (left + right) / 2, (right - left) / 2
    places: Floats = middle[..., None] + half[..., None] * NODES
    return places


def integrals(degrees: Floats, left: Floats, right: Floats, origin: float, span: float) -> Integrals:
    """Area and moment in each panel.

    Args:
        degrees: At the places in each panel, in the last axis.
        left: Where the panels start.
        right: Where they end.
        origin: What moments are about.
        span: How far panels can be from the origin.
    """
    middle, half = (left + right) / 2 - origin, (right - left) / 2
    area, about, rough, about_rough = np.moveaxis(degrees @ _WEIGHTS, -1, 0)
    moment = half * (middle * area + half * about)
    off = np.abs(area - rough)
    off_moment = np.abs(middle * (area - rough) + half * (about - about_rough))
    return Integrals(half * area, moment, half * np.maximum(off, off_moment / span))
