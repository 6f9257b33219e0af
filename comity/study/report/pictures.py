"""The figures of a study: each outcome by factor, and two levels side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from comity.report.drawing import BODY, COLOURS, FAINT, GREY, INK, LABEL, NOTE, WIDTH_IN, bare, folded
from comity.study.report.resampling import averaged

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.answers.study_report import EstimateAnswer
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.factors import StudyFactor
    from comity.study.report.outcomes import StudyOutcome
    from comity.study.report.pairs import VisitPairs
    from comity.study.report.resampling import Floats

ROW_IN, GAP_IN, FOOT_IN = 0.42, 0.5, 0.62
"""Height of a level, of the space above a panel, and of the axis below the last one [in]."""
LEFT_IN, RIGHT_IN = 2.1, 0.25
SQUARE_IN = 2.05
GOLDEN = (math.sqrt(5) - 1) / 2
SHAPES = "os^Dv<>p"
"""Marker shapes of groups, in addition to colours."""
FEW = 3000
"""Above this number, points are rasterised: a vector shape for each makes a page slow."""

Estimates = Sequence["EstimateAnswer | None"]


def outcome_figure(
    visits: StudyVisits,
    outcome: StudyOutcome,
    by_factor: Sequence[tuple[StudyFactor, Estimates]],
) -> Figure:
    """All points of an outcome by the levels of each factor, with means and intervals.

    A point is an individual in a room: the mean of its episodes at that level.

    Args:
        visits: The study's.
        outcome: The outcome.
        by_factor: Each factor with the estimate of each of its levels.
    """
    from matplotlib.figure import Figure

    heights = [ROW_IN * len(factor.levels) for factor, _ in by_factor]
    high_in = sum(heights) + GAP_IN * len(heights) + FOOT_IN
    figure = Figure(figsize=(WIDTH_IN, high_in), facecolor="none")
    top_in = high_in
    axes: list[Axes] = []
    for (factor, estimates), panel_in in zip(by_factor, heights, strict=True):
        top_in -= GAP_IN
        box = (
            LEFT_IN / WIDTH_IN, (top_in - panel_in) / high_in,
            (WIDTH_IN - LEFT_IN - RIGHT_IN) / WIDTH_IN, panel_in / high_in,
        )  # fmt: skip
        ax = bare(figure.add_axes(box, sharex=axes[0] if axes else None, facecolor="none"))
        _draw_levels(ax, visits, outcome, factor, estimates)
        axes.append(ax)
        top_in -= panel_in
    for ax in axes[:-1]:
        ax.tick_params(labelbottom=False)
    axes[-1].set_xlabel(folded(outcome.label, WIDTH_IN - LEFT_IN, BODY, 1)[0], size=BODY, color=GREY)
    return figure


def _draw_levels(
    ax: Axes, visits: StudyVisits, outcome: StudyOutcome, factor: StudyFactor, estimates: Estimates
) -> None:
    rows = range(len(factor.levels))
    for i in rows:
        chosen = np.where(factor.level_of == i, outcome.values, np.nan)
        points = averaged(chosen, visits.individuals, visits.rooms).ravel()
        points = np.sort(points[~np.isnan(points)])
        heights = i - 0.3 * ((np.arange(len(points)) * GOLDEN) % 1)  # even, deterministic jitter
        ax.plot(
            points, heights, "o", ms=4, mfc="none", mec=GREY, mew=0.8, alpha=0.6, ls="", zorder=2,
            rasterized=len(points) > FEW,
        )  # fmt: skip
        if (found := estimates[i]) is not None:
            _draw_mean(ax, found, i + 0.2)
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.set_yticks([*rows], [folded(level, LEFT_IN - 0.3, BODY, 1)[0] for level in factor.levels])
    ax.grid(axis="x", color=FAINT, lw=0.5, alpha=0.6)
    ax.set_axisbelow(True)
    ax.set_title(f"by {factor.name.replace('_', ' ')}", loc="left", size=LABEL, weight="bold", color=INK)
    ax.locator_params(axis="x", nbins=8)


def _draw_mean(ax: Axes, found: EstimateAnswer, height: float) -> None:
    if found.low is not None and found.high is not None:
        ax.plot([found.low, found.high], [height] * 2, color=INK, lw=2.2, solid_capstyle="butt", zorder=3)
    ax.plot(found.mean, height, "D", ms=7, mfc=COLOURS[0], mec=INK, mew=1, zorder=4)


def sides_figure(
    visits: StudyVisits,
    pairs: VisitPairs,
    levels: tuple[str, str],
    outcomes: Sequence[StudyOutcome],
) -> Figure:
    """Two levels against each other: one point per individual, x its mean at the first, y at the second.

    Above the diagonal the second level is larger, below it the first.
    """
    from matplotlib.figure import Figure

    across = 3
    down = math.ceil(len(outcomes) / across)
    groups = visits.words("group")
    names = [name for name in dict.fromkeys(groups.tolist()) if name]
    high_in = down * (SQUARE_IN + 0.8) + (0.4 if names else 0.1)
    figure = Figure(figsize=(WIDTH_IN, high_in), facecolor="none")
    for i, outcome in enumerate(outcomes):
        left_in = 0.72 + (i % across) * (WIDTH_IN - 0.2) / across
        bottom_in = high_in - (i // across + 1) * (SQUARE_IN + 0.8) + 0.5
        box = (
            left_in / WIDTH_IN, bottom_in / high_in,
            (SQUARE_IN - 0.2) / WIDTH_IN, (SQUARE_IN - 0.2) / high_in,
        )  # fmt: skip
        ax = bare(figure.add_axes(box, facecolor="none"))
        _draw_sides(ax, visits, pairs, outcome, names or [""])
        title = "\n".join(folded(outcome.label, SQUARE_IN, 1.15 * NOTE, 2))
        ax.set_title(title, loc="left", size=NOTE, weight="bold", color=INK)
        ax.set_xlabel(folded(levels[0], SQUARE_IN, NOTE, 1)[0], size=NOTE, color=GREY, labelpad=2)
        ax.set_ylabel(folded(levels[1], SQUARE_IN, NOTE, 1)[0], size=NOTE, color=GREY, labelpad=2)
    _name_groups(figure, names, high_in)
    return figure


def _draw_sides(
    ax: Axes, visits: StudyVisits, pairs: VisitPairs, outcome: StudyOutcome, names: Sequence[str]
) -> None:
    groups = visits.words("group")[pairs.first]
    both = ~np.isnan(outcome.values[pairs.first] + outcome.values[pairs.second])
    ends: list[Floats] = []
    for i, name in enumerate(names):
        chosen = both & (groups == name)
        sides = [_by_individual(visits, rows[chosen], outcome.values) for rows in (pairs.first, pairs.second)]
        ax.plot(
            *sides, SHAPES[i % len(SHAPES)], ms=5, mfc="none", mec=COLOURS[i % len(COLOURS)], mew=1.2, ls="",
            zorder=3, rasterized=len(sides[0]) > FEW,
        )  # fmt: skip
        ends += sides
    every = np.concatenate(ends)
    low, high = (float(every.min()), float(every.max())) if len(every) else (0.0, 1.0)
    margin = 0.08 * (high - low) or 0.5
    ax.plot([low - margin, high + margin], [low - margin, high + margin], color=INK, lw=0.9, zorder=1)
    ax.set_xlim(low - margin, high + margin)
    ax.set_ylim(low - margin, high + margin)
    ax.tick_params(labelsize=NOTE - 1.5)
    ax.locator_params(nbins=4)


def _by_individual(visits: StudyVisits, rows: Any, values: Floats) -> Floats:
    if not len(rows):
        return np.empty(0)
    means: Floats = np.nanmean(averaged(values[rows], visits.individuals[rows], visits.rooms[rows]), axis=1)
    return means


def _name_groups(figure: Figure, names: Sequence[str], high_in: float) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D(
            [], [], ls="", marker=SHAPES[i % len(SHAPES)], ms=6, mfc="none", mec=COLOURS[i % len(COLOURS)],
            mew=1.2, label=folded(name, 2.0, NOTE, 1)[0],
        )
        for i, name in enumerate(names)
    ]  # fmt: skip
    if handles:
        figure.legend(
            handles=handles, loc="lower left", bbox_to_anchor=(0.05, 0.0), ncols=4, frameon=False,
            fontsize=NOTE, labelcolor=GREY,
        )  # fmt: skip
