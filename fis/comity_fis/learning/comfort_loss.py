"""What it costs to stand in one place while a person would like another best.

Counted from the model's value, in spreads. Being off costs the distance, as absolute errors are counted. On
top comes harm: a person who is left noticeably worse than the model alone would have left them was better
not learnt about at all. Both are our own choice. Where people may mean the opposite of what they show, it is
this that keeps a robot from believing them too soon.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

HARM = 3.5
"""To leave a person worse costs as much as being off by so many spreads. Set in the study of learning, with
room to spare, so that at most one in twenty is left worse where one in ten means the opposite."""
NOTICED = 1.0 / 6.0
"""Worse by less is not noticed: 5 cm of a spread of 30 cm. Nobody is worse off for a move of so little."""
_TIE = 1e-6
"""Of two places that cost the same the one nearer to the model's value, then the one farther away."""


def losses(places: Floats, middles: Floats, harm: float = HARM) -> Floats:
    """What each place costs with each person, shape (places, middles).

    Args:
        places: Where to stand, shape (places,).
        middles: What a person would like best, shape (middles,).
        harm: What leaving them worse costs; nothing where they said themselves what they like.
    """
    error = np.abs(places[:, None] - middles)
    worse = error > np.abs(middles) + NOTICED
    return np.asarray(error + harm * worse + _TIE * (np.abs(places) - 1e-3 * places)[:, None])
