"""A person's parameters over the years, as a picture: each that changes, and what changed it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.drawing import BODY, COLOURS, FAINT, GREY, INK, NOTE, heading, sheet
from comity.report.people.life import changing
from comity.report.text import words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.adaptation.life import Year

NUMBER_IN, WORD_IN = 1.9, 0.9
"""Heights of numeric and of nominal panels [in]."""


def life_picture(name: str, years: Sequence[Year]) -> Figure:
    """Numbers as lines with the spread between individuals, categories as steps, changed facts as rules."""
    varying = changing(years) or list(years[0].inference.parameters)[:1]
    numeric = {one for one in varying if not isinstance(years[0].inference[one].value, str)}
    events = [(year.day.year, change) for year in years for change in year.changed]
    figure, (top, *axes) = sheet(
        f"{name}, {years[0].day.year} to {years[-1].day.year}",
        f"Rulebook {years[0].inference.rulebook}, facts at the end of each year. The pale band is how far "
        "people vary around a value: one person's own wish goes before all of it.",
        [0.26 * max(len(events), 1), *(NUMBER_IN if one in numeric else WORD_IN for one in varying)],
        left_in=1.35,
    )
    heading(top, "What changed")
    _events(top, events, years)
    for ax, one in zip(axes, varying, strict=True):
        unit = years[0].inference[one].unit
        heading(ax, words(one) + (f" [{unit}]" if unit else ""))
        (_number if one in numeric else _word)(ax, one, years)
        for when in {when for when, _ in events}:
            ax.axvline(when, color=FAINT, lw=0.9, zorder=0)
        _years(ax, years)
    return figure


def _events(ax: Axes, events: Sequence[tuple[int, str]], years: Sequence[Year]) -> None:
    """Label changes of facts, each on its own line, on the side with more space."""
    first, last = years[0].day.year, years[-1].day.year
    for row, (when, change) in enumerate(events or [(years[0].day.year, "nothing")]):
        late = when - first > 0.6 * (last - first)
        ax.plot([when], [-row], "o", color=COLOURS[1], ms=6)
        ax.annotate(
            words(change),
            (when, -row),
            (-9 if late else 9, 0),
            textcoords="offset points",
            size=NOTE,
            color=INK,
            ha="right" if late else "left",
            va="center",
        )
    ax.set_ylim(-max(len(events), 1) + 0.5, 0.5)
    ax.set_yticks([])
    ax.spines["left"].set_visible(False)
    _years(ax, years)


def _number(ax: Axes, name: str, years: Sequence[Year]) -> None:
    at = [year.day.year for year in years]
    values = [year.inference[name] for year in years]
    spread = [value.spread or 0.0 for value in values]
    low = [value.number - by for value, by in zip(values, spread, strict=True)]
    high = [value.number + by for value, by in zip(values, spread, strict=True)]
    ax.fill_between(at, low, high, color=COLOURS[0], alpha=0.13, lw=0)
    ax.plot(at, [value.number for value in values], color=COLOURS[0], lw=2.2, marker="o", ms=4)


def _word(ax: Axes, name: str, years: Sequence[Year]) -> None:
    taken = list(dict.fromkeys(year.inference[name].word for year in years))
    places = [taken.index(year.inference[name].word) for year in years]
    ax.step([year.day.year for year in years], places, where="mid", color=COLOURS[2], lw=2.2)
    ax.set_yticks(range(len(taken)), [words(word) for word in taken])
    ax.set_ylim(-0.5, len(taken) - 0.5)
    ax.tick_params(axis="y", labelsize=BODY, labelcolor=GREY)


def _years(ax: Axes, years: Sequence[Year]) -> None:
    from matplotlib.ticker import MaxNLocator

    ax.set_xlim(years[0].day.year - 0.5, years[-1].day.year + 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
