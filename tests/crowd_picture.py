"""The picture of docs/reference/crowd.md: `python tests/crowd_picture.py` draws the page's two tables.

The tables come from `python tests/crowd_study.py`; so the picture shows what stands above it.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from crowd_study import SEYFRIED_S_M, weidmann_m_s

from comity.report.drawing import BODY, COLOURS, DPI, GREY, INK, LABEL, NOTE, WIDTH_IN, bare, picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DOCS = Path(__file__).parents[1] / "docs"
PAGE, PICTURE = DOCS / "reference" / "crowd.md", DOCS / "pictures" / "crowd.png"
HIGH_IN = 3.8
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


class StreamRow(NamedTuple):
    """A density, and mean speeds in it."""

    per_m2: float
    measured_m_s: float
    ours_m_s: float


class DoorRow(NamedTuple):
    """A door, and how many people pass it in a second."""

    width_m: float
    measured_s: float
    ours_s: float
    least_s: float
    most_s: float


def tables(text: str) -> tuple[list[StreamRow], list[DoorRow]]:
    """The rows of the page's tables."""
    rows = [line for line in text.splitlines() if re.match(r"\| \d", line)]
    numbers = [[float(number) for number in NUMBER.findall(row)] for row in rows]
    doors = ["of" in row for row in rows]
    streams = [StreamRow(*row[:3]) for row, door in zip(numbers, doors, strict=True) if not door]
    return streams, [DoorRow(*row[:5]) for row, door in zip(numbers, doors, strict=True) if door]


def crowd_figure(streams: list[StreamRow], doors: list[DoorRow]) -> Figure:
    """Speed over density and flow over width, each with what was measured as a line."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH_IN, HIGH_IN), dpi=DPI, facecolor="white")
    left, right = (bare(figure.add_axes((x, 0.17, 0.39, 0.66))) for x in (0.09, 0.59))
    dense = np.linspace(0.4, 3.2, 60)
    left.plot(dense, [weidmann_m_s(each) for each in dense], color=GREY, lw=1.8)
    left.plot([row.per_m2 for row in streams], [row.ours_m_s for row in streams], "o", color=COLOURS[0], ms=7)
    widths = np.array([doors[0].width_m, doors[-1].width_m])
    right.plot(widths, SEYFRIED_S_M * widths, color=GREY, lw=1.8)
    for row in doors:
        right.plot([row.width_m] * 2, [row.least_s, row.most_s], color=COLOURS[0], lw=2.2, alpha=0.45)
    right.plot([row.width_m for row in doors], [row.ours_s for row in doors], "o", color=COLOURS[0], ms=7)
    _label(left, "A stream in a corridor", "people per m²", "mean speed [m/s]")
    _label(right, "60 people leave by a door", "width of the door [m]", "people per second")
    left.text(1.25, 1.0, "Weidmann 1993", size=BODY, color=GREY)
    left.text(0.7, 0.62, "Comity", size=BODY, color=COLOURS[0], weight="bold")
    right.text(1.45, 3.1, "Seyfried 2009", size=BODY, color=GREY, ha="right")
    said = "Comity, mean and\nrange of 10 seeds"
    right.text(0.92, 0.95, said, size=BODY, color=COLOURS[0], va="top", weight="bold")
    return figure


def _label(ax: Axes, title: str, x: str, y: str) -> None:
    ax.set_title(title, size=LABEL, weight="bold", color=INK, loc="left", pad=10)
    ax.set_xlabel(x, size=BODY, color=GREY)
    ax.set_ylabel(y, size=BODY, color=GREY)
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.tick_params(labelsize=NOTE)


if __name__ == "__main__":
    found = tables(PAGE.read_text(encoding="utf-8"))
    PICTURE.write_bytes(picture(lambda: crowd_figure(*found), "png"))
