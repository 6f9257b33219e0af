"""The picture of an evaluation: what studies measured, and what the rulebook says of the same people."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.drawing import BODY, COLOURS, FAINT, GREY, INK, colour, heading, scaled_axis, sheet
from comity.report.text import stated, words
from comity.tables.evaluation import by_study
from comity_fis import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from comity.tables.evaluation import Evaluation, Numbers, Predicted

MOST_LINES = 40
"""Rows of one parameter that have a line of their own; more become points over the measured value."""
ROW_IN, CLOUD_IN = 0.34, 4.2
"""Heights of one row, and of the panel where there are too many."""
NAMES_IN = 3.0
"""Room for studies and people."""
MOST_LETTERS = 34


def evaluation_picture(evaluation: Evaluation) -> Figure:
    """A panel for each numeric parameter.

    Raises:
        InputError: if there is none.
    """
    if not evaluation.numbers:
        raise InputError(
            expected="a numeric parameter to draw",
            got=f"only words in {evaluation.measurements.file}",
            remedy="Leave --picture out.",
        )
    panels = list(evaluation.numbers.items())
    heights = [
        max(1.2, ROW_IN * len(numbers.rows)) if len(numbers.rows) <= MOST_LINES else CLOUD_IN
        for _, numbers in panels
    ]
    figure, axes = sheet(
        f"{evaluation.rulebook} against {evaluation.measurements.file}",
        _legend(evaluation),
        heights,
        note="Compare inside one study only: studies measure in different ways.",
        left_in=NAMES_IN,
    )
    for ax, (name, numbers) in zip(axes, panels, strict=True):
        if len(panels) > 1:
            heading(ax, words(name))
        (draw_rows if len(numbers.rows) <= MOST_LINES else draw_cloud)(ax, name, numbers)
    return figure


def _legend(evaluation: Evaluation) -> str:
    sentences = []
    rows = [numbers for numbers in evaluation.numbers.values() if len(numbers.rows) <= MOST_LINES]
    if any("centre" in numbers.errors for numbers in rows):
        sentences.append(
            "Filled: what was measured, read as the rulebook measures distances. Hollow: the same, read the "
            "other way (between surfaces, between centres)."
        )
    elif rows:
        sentences.append("Dot: what was measured.")
    if rows:
        sentences.append("Bar: what the rulebook says of the same people.")
    if len(rows) < len(evaluation.numbers):
        sentences.append("Many rows are points; on the dashed line the rulebook says what was measured.")
    return " ".join(sentences)


def draw_rows(ax: Axes, name: str, numbers: Numbers) -> None:
    """One line for each row, in the file's order from the top."""
    studies = list(dict.fromkeys(one.row.study for one in numbers.rows))
    shown = [[float(one.value), *_measured(numbers, i)] for i, one in enumerate(numbers.rows)]
    flat = [value for values in shown for value in values]
    margin = 0.04 * (max(flat) - min(flat) or 1)
    for i, one in enumerate(numbers.rows):
        y, shade = -i, colour(studies.index(one.row.study))
        measured = _measured(numbers, i)
        ax.plot([min(shown[i]), max(shown[i])], [y, y], color=FAINT, lw=1.2, zorder=1)
        ax.plot(one.value, y, "|", color=INK, ms=17, mew=2.6, zorder=2)
        ax.plot(measured[0], y, "o", color=shade, ms=8.5, mew=0, zorder=3)
        for other in measured[1:]:
            ax.plot(other, y, "o", mfc="white", mec=shade, ms=8, mew=1.8, zorder=3)
    ax.set_yticks([-i for i in range(len(numbers.rows))], [_name(one) for one in numbers.rows])
    ax.set_ylim(-len(numbers.rows) + 0.4, 0.6)
    ax.spines["left"].set_visible(False)
    ax.tick_params(axis="y", length=0)
    scaled_axis(ax, min(flat) - margin, max(flat) + margin, f"{words(name)} [{numbers.parameter.unit}]")


def draw_cloud(ax: Axes, name: str, numbers: Numbers) -> None:
    """The rulebook's value over the measured one, studies by colour; along the line the two are equal."""
    measured = [_measured(numbers, i)[0] for i in range(len(numbers.rows))]
    predicted = [float(one.value) for one in numbers.rows]
    low, high = min(measured + predicted), max(measured + predicted)
    ax.plot([low, high], [low, high], color=GREY, lw=1, ls=(0, (4, 3)), zorder=0)
    studies = by_study(numbers.rows)
    for i, (study, places) in enumerate(studies.items()):
        x, y = [measured[place] for place in places], [predicted[place] for place in places]
        ax.plot(x, y, "o", color=colour(i), ms=4.5, mew=0, alpha=0.5, label=f" {study}")
    if len(studies) <= len(COLOURS):
        ax.legend(fontsize=BODY, labelcolor=GREY, frameon=False, loc="upper left")
    unit = numbers.parameter.unit
    ax.set_ylabel(f"rulebook [{unit}]", size=BODY, color=GREY)
    scaled_axis(ax, low, high, f"measured {words(name)} [{unit}]")


def _measured(numbers: Numbers, place: int) -> list[float]:
    """The measured value in the rulebook's convention, one for each reading that differs, its own first."""
    value = float(numbers.rows[place].value)
    readings = sorted(numbers.errors, key=lambda reading: reading != numbers.parameter.measured)
    return list(dict.fromkeys(round(value - numbers.errors[reading][place], 9) for reading in readings))


def _name(one: Predicted) -> str:
    people = ", ".join(stated(fact) for fact in one.row.facts.values()) or "nothing known"
    text = f"{one.row.study}  {people}"
    return text if len(text) <= MOST_LETTERS else f"{text[: MOST_LETTERS - 1]}…"
