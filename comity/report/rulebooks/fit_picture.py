"""Pictures of a fit: the scores, how many clusters they form, and the terms fitted to them."""

from __future__ import annotations

from collections import Counter
from itertools import groupby
from typing import TYPE_CHECKING

from comity.report.drawing import (
    BODY,
    COLOURS,
    FAINT,
    GREY,
    INK,
    LABEL,
    PLATE,
    Label,
    colour,
    degrees_axis,
    heading,
    held_inside,
    scaled_axis,
    sheet,
)
from comity_fis.variables.resolution import resolved

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.tables.fit import Fit

BINS = 100
"""Places along the axis where dots are piled up."""
HIGHEST_PILE = 14
"""More dots than that are drawn as a bar."""


def fit_picture(fit: Fit) -> Figure:
    """Everything about a fit on one sheet."""
    values, empty = fit.column.values, fit.column.empty
    about = f"{len(values)} values" + (f", {empty} empty or NA cells skipped" if empty else "") + ". "
    if fit.variable is None:
        about += f"They form one cluster at radius {fit.radius:g}: no terms."
        figure, axes = sheet(fit.column.name, about, [1.5, 1.7])
        for ax, draw, name in zip(axes, (draw_scores, draw_counts), ("Values", "Clusters"), strict=True):
            heading(ax, name)
            draw(ax, fit)
        return figure
    about += f"{len(fit.variable.terms)} clusters at radius {fit.radius:g}; {_coerced(fit)}"
    figure, (scores, curves, counts) = sheet(fit.column.name, about, [1.6, 2.9, 1.6], note=_note(fit))
    for ax, name in ((scores, "Values"), (curves, "Terms"), (counts, "Clusters by radius")):
        heading(ax, name)
    draw_scores(scores, fit)
    draw_fit(curves, fit)
    draw_counts(counts, fit)
    return figure


FIT_NOTE = (
    "Dots: degrees of membership by fuzzy c-means. Lines: two-term Gaussians fitted to them by least squares"
)


def _note(fit: Fit) -> str:
    """How the lines were found."""
    held = fit.variable.partition.held if fit.variable and fit.variable.partition else {}
    names = ", ".join(held)
    verb = "is" if len(held) == 1 else "are"
    return (
        f"{FIT_NOTE}; {names} {verb} held to one peak and to c-means between the values."
        if held
        else f"{FIT_NOTE}."
    )


def scores_picture(fit: Fit, *, title: str, about: str, note: str, marks: Sequence[Label] = ()) -> Figure:
    """The values alone."""
    figure, (ax,) = sheet(title, about, [2.2], note=note)
    draw_scores(ax, fit, marks)
    return figure


def terms_picture(fit: Fit, *, title: str, about: str, note: str) -> Figure:
    """Degrees and fitted terms alone."""
    figure, (ax,) = sheet(title, about, [3.4], note=note)
    draw_fit(ax, fit)
    return figure


def counts_picture(fit: Fit, *, title: str, about: str, note: str) -> Figure:
    """The number of clusters alone."""
    figure, (ax,) = sheet(title, about, [2.6], note=note)
    draw_counts(ax, fit)
    return figure


def draw_scores(ax: Axes, fit: Fit, marks: Sequence[Label] = ()) -> None:
    """Every value as a dot on a pile, in the colour of the cluster that it belongs to most."""
    low, high = _ends(fit)
    step = (high - low) / BINS
    piles = Counter(round((value - low) / step) for value in fit.column.values)
    tallest = max(piles.values())
    for place, height in sorted(piles.items()):
        x = low + place * step
        shade = _strongest(fit, x)
        if tallest > HIGHEST_PILE:
            ax.bar(x, height, width=step * 0.8, color=shade)
        else:
            ax.plot([x] * height, range(1, height + 1), "o", color=shade, ms=5.6, mew=0)
    roof = max(1.6 * tallest, tallest + 2.5) if fit.variable else 1.15 * tallest
    ax.set_ylim(0, roof)
    scaled_axis(ax, low, high, fit.column.name)
    _draw_centres(ax, fit, roof)
    for mark in marks:
        top = piles[round((mark.x - low) / step)]
        ax.annotate(
            mark.text, (mark.x, top + 0.4), (mark.x, tallest + 0.9), size=BODY, color=mark.colour,
            ha="center", bbox=PLATE,
            arrowprops={"arrowstyle": "-", "color": mark.colour, "lw": 0.8, "shrinkA": 1},
        )  # fmt: skip
    if tallest > HIGHEST_PILE:
        ax.set_ylabel("values", size=BODY, color=GREY)
    else:
        ax.set_yticks([])
        ax.spines["left"].set_visible(False)


def draw_fit(ax: Axes, fit: Fit) -> None:
    """Each value's degrees as dots, each term as the curve fitted to them."""
    import numpy as np

    from comity_fis.variables.clustering import memberships_of

    variable = fit.variable
    if variable is None or variable.partition is None:
        raise ValueError("one cluster has no terms to draw")
    low, high = _ends(fit)
    scaled_axis(ax, low, high, fit.column.name)
    data = np.array(sorted(set(fit.column.values)))
    degrees = memberships_of(data, np.array(variable.partition.centres))
    xs = np.linspace(low, high, 801)
    labels = []
    for i, (name, term) in enumerate(variable.terms.items()):
        ax.plot(data, degrees[i], "o", color=colour(i), ms=4.5, mew=0, alpha=0.45)
        curve = [term(float(x)) for x in xs]
        ax.plot(xs, curve, color=colour(i), lw=2.4)
        labels.append(Label(float(variable.partition.centres[i]), name, colour(i)))
    degrees_axis(ax, labels)


def draw_counts(ax: Axes, fit: Fit) -> None:
    """How many clusters the data form at each radius; the plateau that is used stands out."""
    radii, most = list(fit.counts), max(2, *fit.counts.values())
    scaled_axis(ax, 0, max(1.0, *radii), "radius of influence, as a fraction of the data's range")
    for count, run in groupby(radii, key=lambda radius: fit.counts[radius]):
        _draw_plateau(ax, count, list(run), used=fit.counts[fit.radius] == count)
    right = fit.radius > radii[-1] / 2
    clusters = fit.counts[fit.radius]
    ax.axvline(fit.radius, color=INK, lw=0.8, ls=(0, (4, 3)), zorder=0)
    ax.annotate(
        f"radius {fit.radius:g}: {clusters} cluster{'s' if clusters > 1 else ''}", (fit.radius, 1.58 * most),
        (-6 if right else 6, 0), textcoords="offset points", size=BODY, color=INK, va="top",
        ha="right" if right else "left",
    )  # fmt: skip
    ax.set_ylim(0, 1.6 * most)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)


def _draw_plateau(ax: Axes, count: int, radii: Sequence[float], *, used: bool) -> None:
    """Neighbouring radii that give the same number of clusters."""
    ax.plot(radii, [count] * len(radii), "-o", color=COLOURS[0] if used else FAINT, lw=2.4, ms=6)
    ax.annotate(
        str(count), ((radii[0] + radii[-1]) / 2, count), (0, 8), textcoords="offset points", size=LABEL,
        ha="center", color=COLOURS[0] if used else GREY, weight="bold" if used else "normal", bbox=PLATE,
    )  # fmt: skip


def _draw_centres(ax: Axes, fit: Fit, roof: float) -> None:
    """Where the clusters lie; with figures as long as there is room for them."""
    if fit.variable is None or fit.variable.partition is None:
        return
    centres = fit.variable.partition.centres
    for i, (name, centre) in enumerate(zip(fit.variable.terms, centres, strict=True)):
        words = f"{name}, centre {resolved(centre, _span(fit), 4)}" if len(centres) < 4 else name
        ax.axvline(centre, ymax=0.84, color=colour(i), lw=1.2, ls=(0, (4, 3)), zorder=0)
        ax.text(
            held_inside(ax, centre, words, LABEL),
            0.86 * roof,
            words,
            size=LABEL,
            weight="bold",
            color=colour(i),
            ha="center",
            va="bottom",
        )


def _strongest(fit: Fit, x: float) -> str:
    if fit.variable is None or fit.variable.partition is None:
        return GREY
    centres = fit.variable.partition.centres
    return colour(min(range(len(centres)), key=lambda i: abs(centres[i] - x)))


def _ends(fit: Fit) -> tuple[float, float]:
    if fit.variable is not None:
        return fit.variable.domain.ends
    return min(fit.column.values), max(fit.column.values)


def _span(fit: Fit) -> float:
    return max(fit.column.values) - min(fit.column.values)


def _coerced(fit: Fit) -> str:
    assert fit.variable is not None
    return f"{fit.variable.measured} level."
