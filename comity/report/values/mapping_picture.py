"""Pictures of a parameter: its terms, and the mapping from inputs to it with the paper's numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.report.drawing import BODY, FAINT, GREY, INK, LABEL, PALE, scaled_axis, sheet
from comity.report.text import words
from comity.report.values.paper import distance_cm
from comity.report.values.variable_picture import draw_terms

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.report.values.paper import Printed
    from comity_fis import NumericParameter, Rulebook

NON_DECREASING = (15, 80)
"""Scores between which more individualism never means a smaller distance, but for 8e-6 m from 15 to 15.82
where gender is not disclosed; the fitted curves fall off beyond."""


@dataclass(frozen=True, slots=True)
class Line:
    """One line of a mapping: who it is for, and the paper's numbers for them."""

    name: str
    gender: str | None
    colour: str
    printed: tuple[Printed, ...] = ()
    above: bool = False
    """Whether there is more room above the line's first number than below it."""


def parameter_picture(parameter: NumericParameter, *, title: str, about: str, note: str) -> Figure:
    """A parameter's terms over the range that rules can give."""
    figure, (ax,) = sheet(title, about, [3.0], note=note)
    scaled_axis(ax, *parameter.rules.ends, f"{words(parameter.name)} [{parameter.unit}]")
    draw_terms(ax, parameter.terms)
    return figure


def mapping_picture(
    rulebook: Rulebook, lines: Sequence[Line], *, title: str, about: str, note: str
) -> Figure:
    """The distance over individualism, exactly computed, with the paper's numbers as rings."""
    figure, (ax,) = sheet(title, about, [4.3], note=note)
    scaled_axis(ax, 0, 100, "individualism")
    ax.set_ylim(45, 120)
    ax.set_ylabel("conversational distance [cm]", size=BODY, color=GREY)
    _shade_ends(ax)
    for line in lines:
        _draw_line(ax, rulebook, line)
    return figure


def _draw_line(ax: Axes, rulebook: Rulebook, line: Line) -> None:
    xs = [x / 2 for x in range(201)]
    ys = [distance_cm(rulebook, x, line.gender) for x in xs]
    aside = line.colour == GREY
    ax.plot(xs, ys, color=line.colour, lw=1.6 if aside else 2.6, ls=(0, (4, 3)) if aside else "-")
    if line.name:
        ax.annotate(
            line.name, (99, ys[198]), (0, 7), textcoords="offset points", size=LABEL, weight="bold",
            color=line.colour, ha="right",
        )  # fmt: skip
    for i, point in enumerate(line.printed):
        ours_cm = distance_cm(rulebook, point.individualism, line.gender)
        _draw_printed(ax, point, ours_cm, line.colour, above=line.above and i == 0)


def _draw_printed(ax: Axes, point: Printed, ours_cm: float, shade: str, *, above: bool) -> None:
    """The paper's number as a ring, with ours below it."""
    at = (point.individualism, point.distance_cm)
    ax.plot([at[0]], [at[1]], "o", ms=10, mfc="white", mec=shade, mew=2.2)
    x, y, side = (-6, 27, "right") if above else (11, -19, "left")
    for text, size, ink, down in (
        (f"paper {point.distance_cm:g}", LABEL, INK, 0),
        (f"here {ours_cm:.2f}", BODY, GREY, 15),
    ):
        ax.annotate(text, at, (x, y - down), textcoords="offset points", size=size, color=ink, ha=side)


def _shade_ends(ax: Axes) -> None:
    low, high = NON_DECREASING
    for start, end in ((ax.get_xlim()[0], low), (high, ax.get_xlim()[1])):
        ax.axvspan(start, end, color=PALE, lw=0, zorder=0)
    for edge in NON_DECREASING:
        ax.axvline(edge, color=FAINT, lw=0.8, zorder=0)
