"""One sheet for a parameter: its response to every input, and surfaces over pairs of numbers."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from comity.report.drawing import (
    BODY,
    FAINT,
    GREY,
    INK,
    LABEL,
    NOTE,
    PALE,
    TITLE,
    WIDTH_IN,
    bare,
    colour,
    folded,
    lines_in,
    picture,
    wrapped,
)
from comity.report.rulebooks.response import Response, Surface
from comity.report.text import words, words_of
from comity_fis import NominalParameter, NumericVariable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.report.rulebooks.response import Responses
    from comity_fis import Parameter

PANEL_IN, ROW_IN = 2.7, 0.26
"""Height of a panel, and of a row of words in one."""
MOST_ROWS = 12
SMALL = 9.5
BAND = "#D9DDE3"


def response_picture(shown: Responses, rulebook: str, form: str) -> bytes:
    """A sheet of curves and surfaces as the bytes of a `png` or `svg`."""
    return picture(lambda: _sheet(shown, rulebook), form)


def _sheet(shown: Responses, rulebook: str) -> Figure:
    """Title, what to see, two panels in a row, and a note; a last panel alone takes the whole row."""
    from matplotlib.figure import Figure

    panels: list[Response | Surface] = [*shown.curves, *shown.surfaces]
    rows = [panels[i : i + 2] for i in range(0, len(panels), 2)]
    heights = [max(_height_in(panel) for panel in row) for row in rows]
    parameter = shown.parameter
    title = folded(f"{words(parameter.name)} in {rulebook}", WIDTH_IN - 0.6, 1.15 * TITLE, 2)
    about, note = wrapped(_about(shown), BODY), wrapped(_note(shown), NOTE)
    head_in = 0.3 + lines_in(title, TITLE) + lines_in(about, BODY)
    foot_in = 0.3 + lines_in(note, NOTE)
    high_in = head_in + sum(heights) + foot_in
    figure = Figure(figsize=(WIDTH_IN, high_in), facecolor="white", layout="constrained")
    engine: Any = figure.get_layout_engine()
    engine.set(
        rect=(0.02, foot_in / high_in, 0.96, 1 - (head_in + foot_in) / high_in), wspace=0.06, hspace=0.06
    )
    left = 0.3 / WIDTH_IN
    figure.text(left, 1 - 0.2 / high_in, "\n".join(title), size=TITLE, weight="bold", color=INK, va="top")
    under = 1 - (0.24 + lines_in(title, TITLE)) / high_in
    figure.text(left, under, "\n".join(about), size=BODY, color=GREY, va="top", linespacing=1.35)
    figure.text(left, 0.16 / high_in, "\n".join(note), size=NOTE, color=GREY, linespacing=1.35)
    grid = figure.add_gridspec(len(rows), 2, height_ratios=heights)
    for i, row in enumerate(rows):
        for j, panel in enumerate(row):
            ax = bare(figure.add_subplot(grid[i, j] if len(row) == 2 else grid[i, :]))
            ax.tick_params(labelsize=SMALL)
            _draw(ax, panel, parameter)
    return figure


def _about(shown: Responses) -> str:
    held = ", ".join(f"{words(name)} {value}" for name, value in shown.held.items())
    others = any(len(curve.others) for curve in shown.curves)
    band = "Grey: what further facts can make of it." if others else ""
    return f"Line, dot: {held or 'nothing else'} disclosed. {band}"


def _note(shown: Responses) -> str:
    parts = []
    if not all(curve.complete for curve in shown.curves):
        parts.append("The grey comes from a sample of the further facts.")
    if shown.without_effect:
        parts.append(f"Read, and without effect here: {words_of(shown.without_effect)}.")
    if shown.left_out:
        parts.append(f"{shown.left_out} further pairs of inputs, with smaller effects, have no surface.")
    return " ".join(parts)


def _height_in(panel: Response | Surface) -> float:
    if isinstance(panel, Surface) or not isinstance(panel.places, tuple):
        return PANEL_IN
    return max(PANEL_IN, 0.9 + ROW_IN * len(_grouped(panel)[0]))


def _draw(ax: Axes, panel: Response | Surface, parameter: Parameter) -> None:
    if isinstance(panel, Surface):
        _draw_surface(ax, panel, parameter)
    elif not isinstance(panel.variable, NumericVariable):
        _draw_words(ax, panel, parameter)
    elif isinstance(parameter, NominalParameter):
        _draw_steps(ax, panel, parameter)
    else:
        _draw_curve(ax, panel, parameter)


def _with_unit(name: str, unit: str | None) -> str:
    return f"{words(name)} [{unit}]" if unit and unit != "1" else words(name)


def _named(parameter: Parameter) -> str:
    return _with_unit(parameter.name, getattr(parameter, "unit", None))


def _label(ax: Axes, across: str, up: str) -> None:
    ax.set_xlabel(folded(across, 3.4, SMALL, 1)[0], size=SMALL + 0.5, color=GREY)
    ax.set_ylabel(folded(up, 2.6, SMALL, 1)[0], size=SMALL + 0.5, color=GREY)


def _draw_curve(ax: Axes, curve: Response, parameter: Parameter) -> None:
    """A number over a number: what is disclosed as a line, the rest as a band."""
    xs: Any = curve.places
    every = np.vstack([curve.value, curve.others])
    ax.fill_between(xs, every.min(axis=0), every.max(axis=0), color=BAND, lw=0)
    for i, (category, values) in enumerate(curve.lines.items()):
        ax.plot(xs, values, color=colour(i), lw=2, label=words(category))
    if curve.lines:
        ax.plot(xs, curve.value, color=INK, lw=1.3, ls="--", label="not disclosed")
    else:
        ax.plot(xs, curve.value, color=INK, lw=2)
    if curve.lines:
        ax.legend(
            title=words(curve.by), title_fontsize=SMALL, fontsize=SMALL, frameon=False, handlelength=1.6
        )
    ax.set_xlim(xs[0], xs[-1])
    _label(ax, _with_unit(curve.variable.name, curve.variable.unit), _named(parameter))


def _draw_steps(ax: Axes, curve: Response, parameter: NominalParameter) -> None:
    """A word over a number: a piece of line for each stretch with the same word."""
    xs: Any = curve.places
    every = np.vstack([curve.value, curve.others])
    for place in range(len(parameter.terms)):
        for shade, width, held in (
            (BAND, 9.0, (every == place).any(axis=0)),
            (INK, 2.5, curve.value == place),
        ):
            ys = np.where(held, float(place), np.nan)
            ax.plot(xs, ys, color=shade, lw=width, solid_capstyle="butt")
    _word_axis(ax.set_yticks, parameter.terms)
    ax.set_ylim(-0.6, len(parameter.terms) - 0.4)
    ax.set_xlim(xs[0], xs[-1])
    _label(ax, _with_unit(curve.variable.name, curve.variable.unit), "")


def _draw_words(ax: Axes, curve: Response, parameter: Parameter) -> None:
    """A row for each category, or for categories that give the same."""
    rows, hidden = _grouped(curve)
    for y, (_, column) in enumerate(rows):
        every = np.append(curve.others[:, column], curve.value[column])
        if isinstance(parameter, NominalParameter):
            ax.plot(np.unique(every), np.full(len(np.unique(every)), y), "o", ms=9, color=BAND)
        else:
            ax.plot([every.min(), every.max()], [y, y], color=BAND, lw=7, solid_capstyle="butt")
        ax.plot([curve.value[column]], [y], "o", ms=6, color=INK)
    ax.set_yticks(range(len(rows)), [name for name, _ in rows], size=SMALL, color=INK)
    ax.set_ylim(len(rows) - 0.4, -0.6)
    if isinstance(parameter, NominalParameter):
        _word_axis(ax.set_xticks, parameter.terms)
        ax.set_xlim(-0.5, len(parameter.terms) - 0.5)
        if sum(map(len, parameter.terms)) > 30:
            for label in ax.get_xticklabels():
                label.set(rotation=30, ha="right", rotation_mode="anchor")
    more = f" ({hidden} more rows)" if hidden else ""
    _label(ax, "" if isinstance(parameter, NominalParameter) else _named(parameter), "")
    ax.set_title(words(curve.variable.name) + more, size=LABEL, color=INK, loc="left")
    ax.grid(axis="x", color=PALE)
    ax.set_axisbelow(True)


def _grouped(curve: Response) -> tuple[list[tuple[str, int]], int]:
    """Names of rows with a column each, and how many there is no room for."""
    places: Any = curve.places
    if len(places) <= MOST_ROWS:
        return [(words(place), i) for i, place in enumerate(places)], 0

    def answer(column: int) -> tuple[float, ...]:
        return (float(curve.value[column]), *curve.others[:, column].round(9).tolist())

    ordered = sorted(range(len(places)), key=answer)
    rows = []
    for _, members in groupby(ordered, answer):
        same = list(members)
        named = ", ".join(words(places[i]) for i in same[:3])
        rows.append((f"{named} and {len(same) - 3} more" if len(same) > 3 else named, same[0]))
    return rows[:MOST_ROWS], max(len(rows) - MOST_ROWS, 0)


def _draw_surface(ax: Axes, surface: Surface, parameter: Parameter) -> None:
    """Shades over two numbers, with a scale beside them; a colour for each word."""
    figure: Any = ax.figure
    if isinstance(parameter, NominalParameter):
        from matplotlib.colors import BoundaryNorm, ListedColormap

        count = len(parameter.terms)
        shades = ListedColormap([colour(i) for i in range(count)])
        mesh = ax.pcolormesh(
            surface.xs, surface.ys, surface.values, cmap=shades, alpha=0.75, rasterized=True,
            norm=BoundaryNorm(np.arange(count + 1) - 0.5, count), shading="nearest",
        )  # fmt: skip
        bar = figure.colorbar(mesh, ax=ax, ticks=range(count))
        bar.ax.set_yticklabels([words(term) for term in parameter.terms], size=SMALL, color=INK)
    else:
        mesh = ax.pcolormesh(
            surface.xs, surface.ys, surface.values, cmap="cividis", shading="gouraud", rasterized=True
        )
        if np.ptp(surface.values) > 0:
            ax.contour(surface.xs, surface.ys, surface.values, levels=8, colors="white", linewidths=0.7)
        bar = figure.colorbar(mesh, ax=ax)
        bar.set_label(folded(_named(parameter), 2.6, SMALL, 1)[0], size=SMALL + 0.5, color=GREY)
        bar.ax.tick_params(labelsize=SMALL, labelcolor=GREY, color=FAINT)
    bar.outline.set_visible(False)
    _label(
        ax,
        _with_unit(surface.across.name, surface.across.unit),
        _with_unit(surface.up.name, surface.up.unit),
    )


def _word_axis(set_ticks: Any, names: Sequence[str]) -> None:
    set_ticks(range(len(names)), [words(name) for name in names], size=SMALL, color=INK)
