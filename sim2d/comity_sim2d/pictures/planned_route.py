"""The route that a plan was made with, as pictures show it next to the driven path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.pictures.drawing import FAINT_INK
from comity_sim2d.pose import XY
from comity_sim2d.scene_error import require_finite

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

DOTS = (0, (1.2, 2.2))


@dataclass(frozen=True, slots=True)
class PlannedRoute:
    """The route of one plan."""

    time_s: float
    """Start of its validity [s]."""
    points: tuple[XY, ...]
    """Its corner points [m]; empty if the plan leads nowhere."""

    def __post_init__(self) -> None:
        require_finite("planned route", time_s=self.time_s)


def draw_planned(ax: Axes, points: Sequence[XY]) -> Line2D:
    """Draw a dotted line below the driven path."""
    x, y = np.array(points, dtype=float).reshape(-1, 2).T
    (line,) = ax.plot(x, y, color=FAINT_INK, lw=2.2, ls=DOTS, dash_capstyle="round", zorder=4.4)
    return line


def planned_at(routes: Sequence[PlannedRoute], time_s: float) -> tuple[XY, ...]:
    """Corner points of the route in force at a time [m]."""
    return next((route.points for route in reversed(routes) if route.time_s <= time_s + 1e-9), ())
