"""Common drawing code of all figures: sheet layout with text, colours, and file formats."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from comity.system.own_files import refuse_foreign, write_whole
from comity_fis import InputError, Where
from comity_sim2d.pictures import colours
from comity_sim2d.pictures.page import FORMS, PDF_MARK, as_bytes, words_as_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS, INK, GREY = colours.PALETTE, colours.INK, colours.GREY
FAINT, PALE = "#C4C8CE", "#F3F1EC"
"""Colours of lines and backgrounds: too light for text."""

WIDTH_IN, DPI = 8.0, 150
"""Width of a sheet [in] and its resolution: 1200 pixels."""
LEFT_IN, RIGHT_IN = 0.85, 0.35
TITLE, LABEL, BODY, NOTE = 17.0, 13.0, 12.0, 10.5
"""Font sizes [pt]; readable at a third of the width."""
LINE = 1.35
"""Line height, relative to the font size."""
LETTER = 0.6
"""Mean width of a bold letter, relative to the font size; regular letters are a tenth narrower."""

PLATE = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
"""Background of text that a line would cross."""

MARK = b"Software\x00Comity"
"""Marker near the start of our PNG files."""
MARKS = {"png": MARK, "svg": b"<dc:title>Comity</dc:title>", "pdf": PDF_MARK}
"""Marker near the start or end of our picture files, by format."""


@dataclass(frozen=True, slots=True)
class Label:
    """A text label next to an object."""

    x: float
    text: str
    colour: str


def picture(draw: Callable[[], Figure], form: str, dpi: float = DPI) -> bytes:
    """A drawing as a file in one of `FORMS`, deterministic whatever the user's settings or the date.

    Args:
        draw: Function that creates the figure.
        form: `png`, `svg` or `pdf`.
        dpi: Resolution of a PNG [pixels/in].
    """
    with _own_style():
        return as_bytes(_settled(draw()), form, dpi if form == "png" else None)


def form_of(path: Path | None, option: str) -> str:
    """The format by the suffix of a picture's name: one of `FORMS`; `png` without a name.

    Raises:
        InputError: for another suffix, or none.
    """
    form = "png" if path is None else path.suffix.lower().removeprefix(".")
    if form not in FORMS:
        raise InputError(
            expected="a picture that ends with .png, .svg or .pdf",
            got=repr(str(path)),
            remedy="Name it so, and convert it afterwards." if form else f"Name it {path}.png, for example.",
            where=Where(option),
        )
    return form


def check_picture(path: Path | None, option: str = "--picture") -> None:
    """Check the path of a picture, if there is one, before anything is computed.

    Raises:
        InputError: for another suffix than a picture's, or an existing file not written by Comity.
    """
    if path is not None:
        refuse_foreign({path: MARKS[form_of(path, option)]})


def write_picture(path: Path, draw: Callable[[], Figure], *, dpi: float = DPI, private: bool = False) -> None:
    """Write a drawing in the format of the path's suffix.

    Args:
        path: Path of the picture, already checked.
        draw: Function that creates the figure.
        dpi: Resolution of a PNG [pixels/in].
        private: Whether it holds personal data, so that only the user may read it.
    """
    write_whole(path, picture(draw, form_of(path, "--picture"), dpi), private=private)


def _settled(figure: Figure) -> Figure:
    """Fix the positions found by a layout, rounded to a millionth: their last digits are not reproducible."""
    if figure.get_layout_engine() is not None:
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
        for ax in figure.axes:
            x, y, width, height = (round(part, 6) for part in ax.get_position().bounds)
            ax.set_position((x, y, width, height))
    return figure


def sheet(
    title: str, about: str, heights_in: Sequence[float], *, note: str = "", left_in: float = LEFT_IN
) -> tuple[Figure, list[Axes]]:
    """A figure with a title, a sentence, panels from top to bottom, and a note on where it comes from.

    Args:
        title: A short title.
        about: A sentence on what to see.
        heights_in: Heights of the panels [in].
        note: Source of numbers and shapes.
        left_in: Left margin for labels [in].
    """
    from matplotlib.figure import Figure

    above, below = wrapped(about, BODY), wrapped(note, NOTE)
    titles = folded(title, WIDTH_IN - 0.6, 1.15 * TITLE, 3)  # bold
    more_in = lines_in(titles[1:], TITLE) * 0.85
    head_in = 0.62 + more_in + lines_in(above, BODY) + (0.35 if len(heights_in) > 1 else 0)
    foot_in = 0.74 + lines_in(below, NOTE)
    gap_in = 0.95
    height_in = head_in + sum(heights_in) + gap_in * (len(heights_in) - 1) + foot_in
    figure = Figure(figsize=(WIDTH_IN, height_in), dpi=DPI, facecolor="white")
    margin = 0.3 / WIDTH_IN
    figure.text(
        margin, 1 - 0.2 / height_in, "\n".join(titles), size=TITLE, weight="bold", color=INK, va="top"
    )
    figure.text(
        margin, 1 - (0.56 + more_in) / height_in, "\n".join(above), size=BODY, color=GREY, va="top",
        linespacing=LINE,
    )  # fmt: skip
    figure.text(margin, 0.16 / height_in, "\n".join(below), size=NOTE, color=GREY, linespacing=LINE)
    axes, top_in = [], height_in - head_in
    for panel_in in heights_in:
        width = (WIDTH_IN - left_in - RIGHT_IN) / WIDTH_IN
        box = (left_in / WIDTH_IN, (top_in - panel_in) / height_in, width, panel_in / height_in)
        axes.append(bare(figure.add_axes(box)))
        top_in -= panel_in + gap_in
    return figure, axes


def degrees_axis(ax: Axes, labels: Iterable[Label]) -> None:
    """Set up the axis of memberships, with the terms' names above their shapes, in as many rows as needed."""
    low, high = ax.get_xlim()
    letter = LETTER * LABEL / 72 / _width_in(ax) * (high - low)
    ends: list[float] = []
    for label in sorted(labels, key=lambda label: label.x):
        half = len(label.text) * letter / 2
        x = min(max(label.x, low + half), high - half) if 2 * half < high - low else label.x
        row = next((i for i, end in enumerate(ends) if end < x - half), len(ends))
        ends[row : row + 1] = [x + half + letter]
        y = 1.05 + row * _row(ax)
        ax.text(
            x, y, label.text, size=LABEL, weight="bold", color=label.colour, ha="center", va="bottom",
            bbox=PLATE,
        )  # fmt: skip
        if row:
            ax.plot([x, x], [1.02, y], color=label.colour, lw=0.8)
    ax.set_ylim(0, 1.08 + max(len(ends), 1) * _row(ax))
    ax.spines["left"].set_bounds(0, 1)
    ax.set_yticks([0, 0.5, 1], ["0", "0.5", "1"])
    ax.set_ylabel("membership", size=BODY, color=GREY, y=0.5 / ax.get_ylim()[1])


def scaled_axis(ax: Axes, low: float, high: float, name: str) -> None:
    """Set up the axis of a variable's values."""
    margin = 0.01 * (high - low)
    ax.set_xlim(low - margin, high + margin)
    ax.set_xlabel(folded(name, WIDTH_IN - LEFT_IN - RIGHT_IN, BODY, 1)[0], size=BODY, color=GREY)


def held_inside(ax: Axes, x: float, text: str, size: float) -> float:
    """Centre of a text above `x` that keeps the text inside the panel."""
    low, high = ax.get_xlim()
    half = len(text) * LETTER * size / 72 / _width_in(ax) * (high - low) / 2
    return min(max(x, low + half), high - half) if 2 * half < high - low else (low + high) / 2


def folded(text: str, width_in: float, size: float, lines: int) -> list[str]:
    """A text wrapped to a number of lines; if too long, cut in the middle, as its end is distinctive.

    Args:
        text: The text.
        width_in: Width of a line [in].
        size: Font size [pt].
        lines: Maximum number of lines.
    """
    room = max(int(width_in * 72 / (size * LETTER * 0.93)), 8)
    whole = wrap(text, room) or [text]
    if len(whole) <= lines:
        return whole
    if lines == 1:
        half = (room - 5) // 2
        return [f"{text[:half].rpartition(' ')[0] or text[:half]} ... {_end(text, half)}"]
    return [*whole[: lines - 1], f"... {_end(text, room - 4)}"]


def _end(text: str, room: int) -> str:
    """The last whole words that fit; letters if a word is too long."""
    return text[-room:].partition(" ")[2] or text[-room:]


def heading(ax: Axes, text: str) -> None:
    """Title of one of several panels."""
    ax.text(
        -0.55 / _width_in(ax),
        1.0 + 0.14 / _height_in(ax),
        text,
        size=LABEL,
        weight="bold",
        color=INK,
        transform=ax.transAxes,
    )


def colour(i: int) -> str:
    """Colour of the i-th object; colours repeat."""
    return COLOURS[i % len(COLOURS)]


@contextmanager
def _own_style() -> Iterator[None]:
    from matplotlib import style

    own = {
        "font.family": "DejaVu Sans",
        "axes.unicode_minus": True,
        "text.parse_math": False,  # a dollar sign in a user's text is literal
    }
    with style.context(["default", own]), words_as_words():
        yield


def bare(ax: Axes) -> Axes:
    """Remove the box of the axes, and use the sheet's colours."""
    ax.spines[["top", "right"]].set_visible(False)
    ax.spines[["left", "bottom"]].set_color(FAINT)
    ax.tick_params(labelsize=BODY, labelcolor=GREY, color=FAINT)
    return ax


def wrapped(text: str, size: float) -> list[str]:
    """A text wrapped to the width of the sheet; `size` is the font size [pt]."""
    return wrap(text, int((WIDTH_IN - 0.6) * 72 / (size * LETTER * 0.9)))


def lines_in(lines: Sequence[str], size: float) -> float:
    """Height of lines of text [in]; `size` is the font size [pt]."""
    return len(lines) * size * LINE * 1.2 / 72


def _row(ax: Axes) -> float:
    """Height of one row of labels, in units of membership, so that three rows leave most of the panel."""
    return 0.24 / _height_in(ax) * 1.3


def _width_in(ax: Axes) -> float:
    return float(ax.get_position().width) * WIDTH_IN


def _height_in(ax: Axes) -> float:
    figure = ax.get_figure(root=True)
    assert figure is not None
    return float(ax.get_position().height * figure.get_size_inches()[1])
