"""Figure of a factor by group: the difference between two levels of the factor within each group."""

from __future__ import annotations

import math
from itertools import groupby
from typing import TYPE_CHECKING

from comity.report.drawing import COLOURS, FAINT, GREY, INK, NOTE, WIDTH_IN, bare, folded
from comity.study.report.outcomes import label_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.answers.study_report import StudyCompareAnswer, StudyDifferenceAnswer

ACROSS = 3
ROW_IN, HEAD_IN, FOOT_IN = 0.26, 0.45, 0.35
"""Height of a group, of the text above a panel, and of the axis below it [in]."""
NAMES_IN, GAP_IN = 1.25, 0.2
"""Width of the group names, and gap between panels [in]."""


def groups_figure(compared: StudyCompareAnswer) -> Figure:
    """A panel for each outcome: a row for all visits, one for each group, with mean and interval.

    Args:
        compared: Two levels of a factor, in a study with groups.
    """
    from matplotlib.figure import Figure

    groups = list(dict.fromkeys(one.group for one in compared.differences))
    outcomes = [
        (label_of(*key), list(some))
        for key, some in groupby(compared.differences, key=lambda one: (one.outcome, one.unit))
    ]
    panel_in = ROW_IN * len(groups)
    row_in = HEAD_IN + panel_in + FOOT_IN
    high_in = row_in * math.ceil(len(outcomes) / ACROSS)
    wide_in = (WIDTH_IN - NAMES_IN - ACROSS * GAP_IN) / ACROSS
    figure = Figure(figsize=(WIDTH_IN, high_in), facecolor="none")
    for i, (label, some) in enumerate(outcomes):
        down, across = divmod(i, ACROSS)
        left_in = NAMES_IN + across * (wide_in + GAP_IN)
        bottom_in = high_in - down * row_in - HEAD_IN - panel_in
        box = (left_in / WIDTH_IN, bottom_in / high_in, wide_in / WIDTH_IN, panel_in / high_in)
        ax = bare(figure.add_axes(box, facecolor="none"))
        _draw_differences(ax, some, groups)
        names = [folded(one or "all", NAMES_IN, NOTE, 1)[0] for one in groups] if across == 0 else []
        ax.set_yticks(range(len(groups)), names or [""] * len(groups), size=NOTE)
        title = "\n".join(folded(label, wide_in, 1.15 * NOTE, 2))
        ax.set_title(title, loc="left", size=NOTE, weight="bold", color=INK)
    return figure


def _draw_differences(
    ax: Axes, differences: Sequence[StudyDifferenceAnswer], groups: Sequence[str | None]
) -> None:
    ax.axvline(0, color=INK, lw=0.9, zorder=1)
    for one in differences:
        height, found = groups.index(one.group), one.difference
        if found.low is not None and found.high is not None:
            ends = [found.low, found.high]
            ax.plot(ends, [height] * 2, color=GREY, lw=2.2, solid_capstyle="butt", zorder=2)
        shape, colour = ("D", INK) if one.group is None else ("o", COLOURS[0])
        ax.plot(found.mean, height, shape, ms=6, mfc=colour, mec=INK, mew=0.8, zorder=3)
    ax.set_ylim(len(groups) - 0.5, -0.5)
    ax.grid(axis="x", color=FAINT, lw=0.5, alpha=0.6)
    ax.set_axisbelow(True)
    ax.tick_params(axis="x", labelsize=NOTE - 1.5)
    ax.locator_params(axis="x", nbins=4)
