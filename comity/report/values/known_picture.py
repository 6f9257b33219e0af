"""The panels of what was known: each fact over its variable's terms, and each value that the rules read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.drawing import folded
from comity.report.text import number, stated, words
from comity.report.values.explanation_drawing import FAINT, GRID, INK, places, plain
from comity_fis import Choice, Interval, NominalVariable, NumericVariable, ParameterValue
from comity_fis.inference.rough import RoughNumber, RoughWord
from comity_sim2d.pictures.colours import PALETTE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.axes import Axes

    from comity_fis import Explanation, Known, Variable

STYLES = ("-", "--", "-.", ":", (0, (6, 1.5, 1, 1.5, 1, 1.5)), (0, (1, 3)))
"""Of an input's terms, in declared order."""
FLIP = PALETTE[1]
SHOWN = 3
"""Categories of a panel."""
TITLE = 11.5


def draw_known(ax: Axes, explanation: Explanation, shown: Variable | ParameterValue, width_in: float) -> None:
    """One panel.

    Args:
        ax: Of the panel.
        explanation: That it is part of.
        shown: A variable that can change the value, or another parameter that its rules read.
        width_in: Of the panel [in].
    """
    if isinstance(shown, ParameterValue):
        _title(ax, f"{words(shown.name)}: {number(shown.value, shown.unit)} ({shown.origin})", width_in)
        _draw_read(ax, shown)
        return
    fact = explanation.inputs[shown.name]
    _title(ax, f"{words(shown.name)}: {_said(fact, shown)}", width_in)
    if isinstance(shown, NumericVariable):
        _draw_terms(ax, shown, fact, [flip.to for flip in explanation.flips if flip.input == shown.name])
    else:
        assert isinstance(shown, NominalVariable)
        _draw_words(ax, shown.categories, _degrees(fact, shown.categories), fact is not None)


def _said(fact: Known | None, variable: Variable) -> str:
    match fact:
        case None:
            return "not disclosed"
        case RoughNumber(given) if not isinstance(given, Interval):
            return "roughly, shaded"
        case RoughWord():
            return "roughly, by degrees"
    return stated(fact, variable.unit)


def _title(ax: Axes, text: str, width_in: float) -> None:
    ax.set_title("\n".join(folded(text, width_in, TITLE, 2)), size=TITLE, color=INK, loc="left")


def _draw_terms(ax: Axes, variable: NumericVariable, fact: Known | None, flips: Sequence[float]) -> None:
    low, high = variable.domain.ends
    labels = []
    for i, (name, term) in enumerate(variable.terms.items()):
        xs = places(term.knots, low, high)
        style = STYLES[i % len(STYLES)]
        (line,) = ax.plot(xs, [term(x) for x in xs], color=INK, lw=1.3, ls=style, label=words(name))
        labels.append(line)
        if isinstance(fact, float):
            ax.plot(fact, term(fact), "o", ms=5, color=INK)
    _draw_fact(ax, fact, low, high)
    for to in flips:
        ax.plot([to, to], [0, 1], color=FLIP, lw=1, ls=(0, (2, 2)))
        ax.text(to, 1.04, "flips", size=8.5, color=FLIP, ha="center")
    ax.set(xlim=(low, high), ylim=(0, 1.18))
    ax.legend(
        handles=labels,
        fontsize=8.5,
        frameon=False,
        ncols=min(len(labels), 3),
        loc="upper left",
        bbox_to_anchor=(0, -0.16),
        borderaxespad=0,
        handlelength=1.8,
        columnspacing=1.0,
    )
    plain(ax)


def _draw_fact(ax: Axes, fact: Known | None, low: float, high: float) -> None:
    """A line at a number; shade over all that is possible where it is known roughly or not at all."""
    if isinstance(fact, float):
        ax.axvline(fact, color=INK, lw=1)
    elif not isinstance(fact, RoughNumber):
        ax.axhspan(0, 1, color=GRID, zorder=0)
    elif isinstance(fact.given, Interval):
        ax.axvspan(fact.given.low, fact.given.high, color=GRID, zorder=0)
        for end in fact.given.ends:
            ax.axvline(end, color=INK, lw=1)
    else:
        xs = places(fact.given.knots, low, high)
        ax.fill_between(xs, [fact.given(x) for x in xs], color=GRID, zorder=0)


def _draw_read(ax: Axes, read: ParameterValue) -> None:
    """What another parameter's rules gave, and the value that was read of it."""
    curve = read.desirability
    if isinstance(curve, Choice):
        _draw_words(ax, tuple(curve.memberships), curve.memberships, known=True)
        return
    low, high = min(curve.domain[0], read.number), max(curve.domain[1], read.number)
    xs = places((read.number,), low, high)
    ax.fill_between(xs, [curve(x) for x in xs], color=GRID, zorder=0)
    ax.plot(xs, [curve(x) for x in xs], color=FAINT, lw=1.2)
    ax.axvline(read.number, color=INK, lw=1)
    ax.set(xlim=(low, high), ylim=(0, 1.18))
    ax.set_xlabel(
        "what its own rules gave" if read.fired else "what stands", size=8.5, color=FAINT, loc="left"
    )
    plain(ax)


def _degrees(fact: Known | None, categories: Sequence[str]) -> Mapping[str, float]:
    """To which degree each category is possible."""
    if isinstance(fact, RoughWord):
        return fact.given
    return {category: 1.0 for category in categories if fact in (None, category)}


def _draw_words(ax: Axes, categories: Sequence[str], degrees: Mapping[str, float], known: bool) -> None:
    """The likeliest categories, in declared order; all of them alike where nothing is known."""
    likeliest = sorted(categories, key=lambda category: -degrees.get(category, 0.0))[:SHOWN]
    shown = [category for category in categories if category in likeliest]
    hidden = len(categories) - len(shown)
    for place, category in enumerate(shown):
        degree = degrees.get(category, 0.0)
        certain = known and degree == 1
        ax.barh(place, degree, color=INK if certain else GRID, height=0.55, alpha=0.8)
        ax.text(0.03, place, words(category), va="center", size=10, color="white" if certain else INK)
    if hidden:
        ax.text(0.03, len(shown), f"and {hidden} more", va="center", size=9, color=FAINT)
    ax.set(xlim=(0, 1), ylim=(max(len(shown), 3) + 0.2 - 0.5 * (not hidden), -0.6))
    ax.set_yticks([])
    ax.set_xticks([])
    for spine in ax.spines.values():
        spine.set_visible(False)
