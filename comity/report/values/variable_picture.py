"""Pictures of linguistic variables: every term over the values, with the level of measurement."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.drawing import (
    BODY,
    FAINT,
    GREY,
    INK,
    LABEL,
    LETTER,
    Label,
    colour,
    degrees_axis,
    scaled_axis,
    sheet,
)
from comity.report.text import words
from comity_fis.membership.function import Trapezoid

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity_fis import NominalVariable, NumericVariable, OrdinalVariable
    from comity_fis.membership.function import NumericMembership


def numeric_variable(variable: NumericVariable, *, about: str, note: str) -> Figure:
    """Terms over numbers."""
    figure, (ax,) = sheet(
        f"{words(variable.name).capitalize()}: {variable.measured}", about, [3.2], note=note
    )
    unit = f" [{variable.unit}]" if variable.unit else ""
    scaled_axis(ax, *variable.domain.ends, words(variable.name) + unit)
    draw_terms(ax, variable.terms)
    return figure


def worded_variable(variable: NominalVariable | OrdinalVariable, *, about: str, note: str) -> Figure:
    """Terms over words: each category is one, and groups stand for several."""
    title = f"{words(variable.name).capitalize()}: {variable.measured}"
    longest = max(len(category) for category in variable.categories)
    left_in = 0.9 + longest * LABEL * LETTER / 72
    figure, (ax,) = sheet(title, about, [0.42 * len(variable.categories) + 0.3], note=note, left_in=left_in)
    _draw_categories(ax, variable)
    return figure


def draw_terms(ax: Axes, terms: Mapping[str, NumericMembership]) -> None:
    """Every term as a line with its name above it."""
    import numpy as np

    low, high = ax.get_xlim()
    labels = []
    for i, (name, term) in enumerate(terms.items()):
        xs = np.unique([*np.linspace(low, high, 601), *(x for x in term.knots if low < x < high)])
        if isinstance(term, Trapezoid):
            xs = xs[(xs >= term.a) & (xs <= term.d)]
        degrees = [term(float(x)) for x in xs]
        ax.plot(xs, degrees, color=colour(i), lw=2.6, solid_joinstyle="round")
        ax.fill_between(xs, degrees, color=colour(i), alpha=0.10, lw=0)
        top = xs[np.array(degrees) >= max(degrees) - 1e-3]
        labels.append(Label(float(top.min() + top.max()) / 2, words(name), colour(i)))
    degrees_axis(ax, labels)


def _draw_categories(ax: Axes, variable: NominalVariable | OrdinalVariable) -> None:
    ordered = hasattr(variable, "numbered_from")
    first = getattr(variable, "numbered_from", None)
    count = len(variable.categories)
    rows = {category: i if ordered else count - 1 - i for i, category in enumerate(variable.categories)}
    shades = _shades(variable)
    for category, y in rows.items():
        ax.plot([0, 1], [y, y], color=shades[category], lw=2.4, solid_capstyle="butt")
        ax.plot([1], [y], "o", color=shades[category], ms=9)
    names = [words(c) if first is None else f"{words(c)}  {first + i}" for i, c in enumerate(rows)]
    ax.set_yticks(list(rows.values()), names, size=LABEL, color=INK)
    for name, group in variable.groups.items():
        ys = [rows[member] for member in group.members]
        ax.plot(
            [1.12, 1.12],
            [min(ys) - 0.3, max(ys) + 0.3],
            color=shades[next(iter(sorted(group.members)))],
            lw=4,
        )
        ax.text(
            1.16,
            sum(ys) / len(ys),
            words(name),
            size=LABEL,
            weight="bold",
            color=shades[next(iter(sorted(group.members)))],
            va="center",
        )
    ax.set_xlim(0, 1.45 if variable.groups else 1.12)
    ax.set_ylim(-0.6, count - 0.4)
    ax.set_xticks([0, 1], ["0", "1"])
    ax.set_xlabel("membership in the term of the same name", size=BODY, color=GREY)
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_color(FAINT)


def _shades(variable: NominalVariable) -> dict[str, str]:
    """A colour for each group, or for each category where there are no groups."""
    sets = list(variable.groups.values()) or [variable.terms[category] for category in variable.categories]
    return {
        category: next((colour(i) for i, members in enumerate(sets) if members(category)), INK)
        for category in variable.categories
    }
