"""The picture of an explanation: what the rules gave, whose it is, and what was known."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from math import nan
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING

from comity.report.drawing import check_picture, folded, write_picture
from comity.report.text import number, stated, words, words_of
from comity.report.values.explanation_drawing import (
    FAINT,
    GRID,
    INK,
    MANY,
    RULES,
    places,
    plain,
)
from comity.report.values.explanation_words import fine, ordered_rules, speaking, steps
from comity.report.values.inference import outvoted_text
from comity.report.values.known_picture import draw_known
from comity_fis import Choice, NumericParameter, kept_back

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity_fis import Explanation, ParameterValue, RuleAccount

WIDTH_IN, DPI = 12.0, 100
ROWS = 6
"""Rules in the legend, and inputs in the second row."""
RULE, RULE_IN, LINE_IN, LINES = 10.5, 0.3, 0.17, 3
"""Letters of a rule in the legend [pt], its height, that of a further line [in], as many lines at most."""
SPIKE = 9
"""Width of a single place that a rule gives [pt]."""


def write_explanation(explanation: Explanation, path: Path) -> None:
    """Write a PNG, SVG or PDF, by the path's ending, that the user alone may read; a PNG is 1200 pixels wide.

    The same explanation gives the same bytes on the same matplotlib.

    Raises:
        InputError: if Comity did not write what is at `path`, or nothing can be written there.
    """
    check_picture(path)
    write_picture(path, _Drawing(explanation).figure, dpi=DPI, private=True)


@dataclass(frozen=True, slots=True)
class _Drawing:
    """One picture in the making."""

    explanation: Explanation

    def figure(self) -> Figure:
        """Title, output set or categories, the rules, and what was known."""
        from matplotlib.figure import Figure

        shown = [(account, self._said(account)) for account in ordered_rules(self.explanation)[:ROWS]]
        panels = [*self.explanation.variables, *self.explanation.reads][:ROWS]
        rules_in = 0.45 + sum(_tall(lines) for _, lines in shown) if shown else 0.1
        known_in = 2.7 if panels else 0.1
        main_in = 3.7
        height = 1.15 + main_in + 0.6 + rules_in + known_in
        figure = Figure(figsize=(WIDTH_IN, height), dpi=DPI, facecolor="white")
        self._title(figure, height)
        top = height - 1.15

        def axes(left: float, bottom: float, width: float, tall: float) -> Axes:
            return figure.add_axes((left / WIDTH_IN, bottom / height, width / WIDTH_IN, tall / height))

        main = axes(0.85 if self._numeric else 1.8, top - main_in, 10.8 if self._numeric else 9.6, main_in)
        if self._numeric:
            self._draw_output(main)
        else:
            self._draw_categories(main)
        self._draw_rules(axes(0.55, top - main_in - 0.55 - rules_in, 11.1, rules_in), shown)
        gap, left = 0.55, 0.85
        width = (WIDTH_IN - left - 0.35 - gap * (len(panels) - 1)) / max(len(panels), 1)
        width = min(width, 5.2)
        for i, panel in enumerate(panels):
            place = axes(left + i * (width + gap), 0.75, width, known_in - 1.35)
            draw_known(place, self.explanation, panel, width)
        return figure

    @property
    def _numeric(self) -> bool:
        return isinstance(self.explanation.parameter, NumericParameter)

    def colour(self, rule_number: int) -> str:
        """Of one rule: by its place among those that fired."""
        numbers = [account.rule.number for account in ordered_rules(self.explanation)]
        place = numbers.index(rule_number) if rule_number in numbers else len(RULES)
        return RULES[place] if place < len(RULES) else MANY

    def _title(self, figure: Figure, height: float) -> None:
        value = self.explanation.value
        headline = f"{words(value.name)}: {number(value.value, value.unit)}"
        figure.text(0.55 / WIDTH_IN, 1 - 0.42 / height, headline, size=19, weight="bold", color=INK)
        outvoted = outvoted_text(value, self.explanation.inputs)
        about = outvoted or value.note or value.contributions[-1].text
        known = ", ".join(
            f"{words(v.name)} {stated(fact, v.unit)}"
            for v, fact in ((v, self.explanation.inputs[v.name]) for v in self.explanation.variables)
            if fact is not None
        )
        line = f"{value.origin}: {about}" if value.origin != "neutral" else f"neutral value: {about}"
        if len(value.contributions) > 1:
            line = steps(value)
        if known:
            line += f".  Known: {known}."
        figure.text(
            0.55 / WIDTH_IN, 1 - 0.76 / height, shorten(line, 150, placeholder=" ..."), size=11.5, color=FAINT
        )

    def _draw_output(self, ax: Axes) -> None:
        parameter, value = self.explanation.parameter, self.explanation.value
        curve = value.desirability
        assert isinstance(parameter, NumericParameter)
        assert not isinstance(curve, Choice)
        low, high = curve.domain
        low = min(low, value.number, parameter.rules.low)
        high = max(high, value.number, parameter.rules.high)
        given = {term for account in self.explanation.rules for term in account.terms}
        pieces = self.explanation.attribution.pieces
        top = max([1.0, *(y for piece in pieces for _, y in piece.outline)])  # strengths may add up
        for name, term in parameter.terms.items():
            xs = places(term.knots, *parameter.rules.ends)
            ax.plot(xs, [term(x) for x in xs], color=FAINT if name in given else GRID, lw=1.2, zorder=2)
            peak = max(xs, key=lambda x: (round(term(x), 9), -abs(x - (low + high) / 2)))
            middle = [x for x in xs if term(x) >= 0.999 * term(peak)]
            place = (min(middle) + max(middle)) / 2
            ax.text(
                place, top + 0.035, words(name), ha="center", color=INK if name in given else FAINT, size=11
            )
        self._draw_owned(ax)
        self._draw_cuts(ax, parameter)
        if not self.explanation.rules:  # a setting, safety or the neutral value
            xs = places((value.number,), low, high)
            ax.plot(xs, [curve(x) for x in xs], color=INK, lw=1.8, zorder=5)
            ax.fill_between(xs, [curve(x) for x in xs], color=GRID, zorder=1.5)
        elif self._moved:
            ax.plot(*zip(*curve.outline, strict=True), color=INK, lw=1.3, ls=(0, (1, 1.5)), zorder=5)
        if self._moved:
            _draw_move(ax, value)
        _mark(ax, value.number, number(value.value, value.unit), low, high)
        unit = f" [{parameter.unit}]" if parameter.unit != "1" else ""
        ax.set(
            xlim=(low, high),
            ylim=(0, top + 0.13),
            xlabel=f"{words(parameter.name)}{unit}",
            ylabel="desirability",
        )
        plain(ax)

    @property
    def _moved(self) -> bool:
        """Whether the situation, what was learnt or a limit moved the value."""
        value = self.explanation.value
        return len(value.contributions) > 1 and value.start.value != value.value

    def _draw_owned(self, ax: Axes) -> None:
        """The aggregated set, each stretch in the colour of its owner; several owners as stripes."""
        edge: list[tuple[float, float]] = []
        for owners, together in groupby(self.explanation.attribution.pieces, key=lambda piece: piece.owners):
            stretch = list(together)
            outline = [point for piece in stretch for point in piece.outline]
            edge += outline
            colours = [self.colour(rule.number) for rule in owners]
            xs, ys = zip(*outline, strict=True)
            for piece in stretch:
                if piece.spike:
                    ax.vlines(
                        piece.left,
                        piece.outline[0][1],
                        piece.outline[1][1],
                        color=colours[0],
                        lw=SPIKE,
                        alpha=0.75,
                        zorder=3,
                    )
            if colours:
                ax.fill_between(xs, ys, color=colours[0], alpha=0.75, lw=0, zorder=3)
            if len(colours) > 1:
                ax.fill_between(xs, ys, fc="none", ec=colours[1], hatch="////", lw=0, zorder=3.1)
        if edge:
            ax.plot(*zip(*edge, strict=True), color=INK, lw=1.8, zorder=5, solid_joinstyle="round")

    def _draw_cuts(self, ax: Axes, parameter: NumericParameter) -> None:
        """Every fired term cut at its strength, also where another rule is above it."""
        for account in reversed(self.explanation.rules):
            for name in account.terms:
                term = parameter.terms[name]
                xs = places(_cut_corners(term.knots, account.strength), *parameter.rules.ends)
                ys = [min(term(x), account.strength) or nan for x in xs]
                ax.plot(xs, ys, color=self.colour(account.rule.number), lw=1.4, ls=(0, (4, 2)), zorder=4)

    def _draw_categories(self, ax: Axes) -> None:
        value = self.explanation.value
        memberships = getattr(value.desirability, "memberships", {})
        rows = self.explanation.categories
        names = [row.name for row in rows] or list(memberships)
        for place, name in enumerate(names):
            degree = memberships.get(name, 0.0)
            row = rows[place] if rows else None
            fired = row.fired if row else ()
            colour = self.colour(fired[0].rule.number) if fired else MANY
            ax.barh(place, degree, color=colour, height=0.62, alpha=0.45 if name == value.value else 0.25)
            because = speaking(fired, self.explanation, digits=2)
            text = f"{degree:.2f}  {because}" if because else f"{degree:.2f}"
            if row and not row.permitted:
                text = f"out: requires {words(str(row.requires))}" + (f"   [{because}]" if because else "")
                if fired:
                    ax.barh(place, fired[0].strength, height=0.62, fc="none", ec=colour, ls="--", lw=1.2)
            inside = degree > 0.7 or bool(row and not row.permitted and fired)
            ax.text(0.012 if inside else degree + 0.012, place, text, va="center", size=10.5, color=INK)
        ax.set_yticks(range(len(names)), [words(name) for name in names], size=11)
        for label, name in zip(ax.get_yticklabels(), names, strict=True):
            label.set_fontweight("bold" if name == value.value else "normal")
        ax.set(xlim=(0, 1.02), ylim=(len(names) - 0.5, -0.5), xlabel="how suitable (desirability)")
        plain(ax, grid="x")

    def _draw_rules(self, ax: Axes, shown: Sequence[tuple[RuleAccount, list[str]]]) -> None:
        """A legend that says what each rule did."""
        from matplotlib.patches import Rectangle

        ax.axis("off")
        if not shown:
            return
        unit = self.explanation.value.unit
        heads = ("strength", "share", "contributes") if self._numeric else ("strength",)
        columns = (8.7, 9.75, 11.1)[-len(heads) :]
        for right, text in zip(columns, heads, strict=True):
            ax.text(right, 0.2, text, va="center", ha="right", size=9, color=FAINT)
        y = 0.3
        for account, lines in shown:
            tall = _tall(lines)
            place, shade = y + tall / 2, self.colour(account.rule.number)
            ax.add_patch(Rectangle((0, y + 0.06), 0.3, tall - 0.12, color=shade, lw=0))
            ax.text(0.42, place, "\n".join(lines), va="center", size=RULE, color=INK, linespacing=1.15)
            for right, text in zip(columns, _did(account, unit), strict=True):
                ax.text(right, place, text, va="center", ha="right", size=RULE, color=INK)
            y += tall
        if hidden := len(self.explanation.rules) - len(shown):
            ax.text(11.1, y + 0.08, f"and {hidden} more", ha="right", va="center", size=9, color=FAINT)
        ax.set(xlim=(0, 11.1), ylim=(y + 0.15, 0))

    def _said(self, account: RuleAccount) -> list[str]:
        """A rule in words, after what of it nobody knows."""
        hidden = words_of(kept_back(account.rule, self.explanation.inputs))
        unknown = f" ({hidden} not disclosed)" if hidden else ""
        text = f"{account.rule.number}{unknown}. {words(account.rule.text)}"
        return folded(text, 7.6 if self._numeric else 9.9, RULE, LINES)


def _tall(lines: Sequence[str]) -> float:
    """Of a rule in the legend [in]."""
    return RULE_IN + LINE_IN * (len(lines) - 1)


def _draw_move(ax: Axes, value: ParameterValue) -> None:
    """From where the value set out, and the way to where it stands."""
    start = value.start.value
    assert isinstance(start, float | int)
    ax.plot([start, start], [0, 1], color=INK, lw=1.2, ls=(0, (4, 3)), zorder=6)
    arrow = {"arrowstyle": "->", "color": INK, "lw": 1.4}
    ax.annotate("", xy=(value.number, 0.2), xytext=(start, 0.2), arrowprops=arrow, zorder=7)
    side = "left" if start > value.number else "right"
    text = f" {value.start.origin} {number(start, value.unit)} "
    box = {"fc": "white", "ec": "none", "alpha": 0.85, "pad": 1.5}
    ax.text(start, 0.09, text, ha=side, va="center", size=10.5, color=INK, bbox=box, zorder=8)


def _did(account: RuleAccount, unit: str | None) -> tuple[str, ...]:
    """Strength, and for a number share and contribution."""
    strength = f"{account.strength:.3f}"
    if account.share is None or account.contribution is None:
        return (strength,)
    return strength, f"{100 * account.share:.1f} %", fine(account.contribution, unit)


def _mark(ax: Axes, x: float, text: str, low: float, high: float) -> None:
    ax.plot([x, x], [0, 1], color="black", lw=2, zorder=6)
    right = x > low + 0.82 * (high - low)
    ax.annotate(
        text,
        (x, 0.5),
        xytext=(-8 if right else 8, 0),
        textcoords="offset points",
        ha="right" if right else "left",
        va="center",
        size=13,
        weight="bold",
        zorder=7,
        bbox={"boxstyle": "round,pad=0.25", "fc": "white", "ec": "none"},
    )


def _cut_corners(knots: Sequence[float], strength: float) -> tuple[float, ...]:
    """A trapezoid's corners after the cut; other shapes have none to speak of."""
    if len(knots) != 4:
        return tuple(knots)
    a, b, c, d = knots
    return a, a + strength * (b - a), d - strength * (d - c), d
