"""The legend of a picture: one row per kind of mark on the map. All lengths in inches."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.planned_route import draw_planned
from comity_sim2d.pose import Pose

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW_IN, ABOVE_IN, BELOW_IN = 0.27, 0.24, 0.16
LEFT_IN, RIGHT_IN, WORDS_IN = 0.08, 0.48, 0.62
"""Start and end of the marks, and start of the text [in]."""
MIDDLE_IN = (LEFT_IN + RIGHT_IN) / 2

COLUMN_IN = 3.5

Mark = Callable[["Axes", float, float], None]
"""Draws a mark in a row that starts at x, at height y."""


@dataclass(frozen=True, slots=True)
class Legend:
    """The entries of a legend."""

    planned: bool = False
    visits: bool = False
    walkers: bool = False
    groups: bool = False
    met: bool = False
    """Whether a person has moved since the robot docked."""
    columns: int = 1
    """Number of columns of width `COLUMN_IN`, filled one after the other."""

    @property
    def height_in(self) -> float:
        """Its height."""
        return ABOVE_IN + ROW_IN * self._lines + BELOW_IN

    @property
    def _lines(self) -> int:
        """Number of rows."""
        return math.ceil(len(self._rows) / self.columns)

    def draw(self, ax: Axes, top: float) -> None:
        """Draw it below a height, on axes scaled in inches of the page."""
        for i, (words, mark) in enumerate(self._rows):
            column, line = divmod(i, self._lines)
            x, y = COLUMN_IN * column, top + ABOVE_IN + ROW_IN * line
            ax.text(x + WORDS_IN, y, words, size=9.5, color=d.INK, va="center")
            mark(ax, x, y)

    @property
    def _rows(self) -> list[tuple[str, Mark]]:
        rows: list[tuple[str, Mark]] = [("robot, where it ends", _robot), ("path that it drove", _way)]
        rows += [("route as planned", _planned)] if self.planned else []
        if self.visits:
            rows += [("target distance between the bodies", _wanted), ("actual distance", _reached)]
            rows += [("chosen side", _side)]
        rows += [("where they were as it docked", _met)] if self.met else []
        rows += [("path of a person who walks", _track)] if self.walkers else []
        rows += [("space that a group keeps open", _o_space)] if self.groups else []
        return rows


def _robot(ax: Axes, x: float, y: float) -> None:
    d.add_all(ax, d.robot_artists(Pose(x + MIDDLE_IN, y, 0.0), 0.10))


def _way(ax: Axes, x: float, y: float) -> None:
    ax.plot([x + LEFT_IN, x + RIGHT_IN], [y, y], color=d.ROBOT, lw=1.7, alpha=0.75)
    ax.plot(x + MIDDLE_IN, y, marker=">", ms=6, mfc=d.ROBOT, mec="#FFFFFF", mew=0.8)


def _planned(ax: Axes, x: float, y: float) -> None:
    draw_planned(ax, [(x + LEFT_IN, y), (x + RIGHT_IN, y)])


def _wanted(ax: Axes, x: float, y: float) -> None:
    ax.plot([x + LEFT_IN, x + RIGHT_IN], [y, y], color=d.GREY, lw=1.5, ls=d.DASHES)


def _reached(ax: Axes, x: float, y: float) -> None:
    ax.plot([x + LEFT_IN, x + RIGHT_IN], [y, y], color=d.GREY, lw=2.4)
    ax.plot(x + RIGHT_IN, y, marker="o", ms=6.5, mfc=d.GREY, mec="#FFFFFF", mew=1.2)


def _side(ax: Axes, x: float, y: float) -> None:
    from matplotlib.patches import Rectangle

    ax.add_patch(Rectangle((x + LEFT_IN, y - 0.08), RIGHT_IN - LEFT_IN, 0.16, fc=d.GREY, alpha=0.16))


def _met(ax: Axes, x: float, y: float) -> None:
    d.add_all(ax, d.robot_artists(Pose(x + MIDDLE_IN - 0.12, y, 0.0), 0.08, ghost=True))
    d.add_all(ax, d.person_artists(Pose(x + MIDDLE_IN + 0.12, y, math.pi), 0.07, d.GREY, ghost=True))


def _track(ax: Axes, x: float, y: float) -> None:
    d.draw_track(ax, np.array([(x + LEFT_IN, y), (x + RIGHT_IN, y)]), d.GREY)


def _o_space(ax: Axes, x: float, y: float) -> None:
    d.draw_o_space(ax, (x + MIDDLE_IN, y), 0.10)
