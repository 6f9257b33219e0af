"""Loss of standing at one place while a person would like another best.

In spreads, from the model's value. The loss is the absolute error plus a penalty for harm: a person left
noticeably worse than by the model alone would have been better off without learning. Both are our own choice.
If people may mean the opposite of what they show, the penalty keeps a robot from believing them too soon.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

HARM = 3.5
"""Loss of leaving a person worse off [spreads]. Set in the study of learning, with a margin, so that at most
one in twenty is worse off if one in ten means the opposite."""
NOTICED = 1.0 / 6.0
"""Change that is not noticed [spreads]: 5 cm with a spread of 30 cm."""
_TIE = 1e-6
"""Tie-break between places of equal loss: nearer to the model's value first, then farther away."""


def losses(places: Floats, middles: Floats, harm: float = HARM) -> Floats:
    """Loss of each place for each person, shape (places, middles).

    Args:
        places: Candidate offsets, shape (places,).
        middles: Preferred offsets of people, shape (middles,).
        harm: Loss of leaving them worse off; 0 if they stated what they like.
    """
    error = np.abs(places[:, None] - middles)
    worse = error > np.abs(middles) + NOTICED
    return np.asarray(error + harm * worse + _TIE * (np.abs(places) - 1e-3 * places)[:, None])
