"""What the panels of an explanation's picture share: colours, curves with their corners, plain axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from comity_sim2d.pictures import colours

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

RULES = tuple(colours.PALETTE[i] for i in (0, 4, 2, 3, 1, 5))
"""Of rules, in the order in which the page of a run has them; black is for the value."""
MANY = "#999999"
"""Rules beyond the colours, and places that several own: no words are in it."""
INK, FAINT, GRID = colours.INK, colours.GREY, "#E4E4E4"


def plain(ax: Axes, grid: Literal["x", "y"] = "y") -> None:
    """An axis without a box, with faint lines across it."""
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    ax.tick_params(labelsize=9.5, colors=INK)
    ax.set_axisbelow(True)
    ax.grid(axis=grid, color=GRID, lw=0.8)


def places(corners: Sequence[float], low: float, high: float) -> list[float]:
    """Enough of them for a curve, and every corner, just beside it on both sides too (vertical edges)."""
    even = {low + (high - low) * k / 300 for k in range(301)}
    beside = {x + d * 1e-9 * (high - low) for x in corners for d in (-1, 0, 1)}
    return sorted(even | {x for x in beside if low <= x <= high})
