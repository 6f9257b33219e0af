"""A page for a picture of a place: its scale, and its bytes, which are the same each time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

from comity_sim2d.pictures.colours import HALO
from comity_sim2d.pictures.lettering import lettering

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMS = ("png", "svg", "pdf")
"""Endings of the files that pictures are written to."""
POINTS_PER_IN = 72
DPI = {"png": 120, "svg": POINTS_PER_IN, "pdf": POINTS_PER_IN}
LINE_SPACING = 1.25
"""Of words on a map, in the size of their letters."""
PDF_MARK = b"%Comity"
"""What ends a PDF of ours: its own facts stand nowhere near its start."""


@contextmanager
def own_page(words: Iterable[str]) -> Iterator[None]:
    """Draw with letters for these words, which stay words, and with the same ids each time."""
    with lettering(words), words_as_words():
        yield


@contextmanager
def words_as_words() -> Iterator[None]:
    """Keep words in SVG and PDF words, to be searched and edited, and ids the same each time."""
    from matplotlib import rc_context

    with rc_context({"svg.hashsalt": "Comity", "svg.fonttype": "none", "pdf.fonttype": 42}):
        yield


def in_per_m(extent_m: tuple[float, float], usual: float, *, least_in: float, most_in: float) -> float:
    """The scale of a page [in/m]: the usual one, unless the page were too narrow or too large with it.

    Args:
        extent_m: Width and height of the place.
        usual: The scale at which words fit.
        least_in: Width of the narrowest page.
        most_in: The longer side of the largest page.
    """
    wide, high = extent_m
    return min(max(usual, least_in / wide), most_in / max(wide, high))


def as_bytes(figure: Figure, form: str, dpi: float | None = None) -> bytes:
    """The content of a file in one of `FORMS`, the same each time: nothing in it tells the date.

    Args:
        figure: What is drawn, for vectors at `POINTS_PER_IN`.
        form: Ending of the file.
        dpi: Pixels to an inch; those of `DPI` without it.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    buffer = BytesIO()
    told: dict[str, dict[str, Any]] = {
        "png": {"Software": "Comity"},
        "svg": {"Title": "Comity", "Date": None},
        "pdf": {"Title": "Comity", "CreationDate": None},
    }
    if form != "png":
        _halos_apart(figure)
    canvas = FigureCanvasAgg(figure)
    canvas.print_figure(buffer, format=form, dpi=dpi or DPI[form], metadata=told[form])
    return buffer.getvalue() + (PDF_MARK + b"\n" if form == "pdf" else b"")


def _halos_apart(figure: Figure) -> None:
    """Draw halos as lines below their words: matplotlib makes outlines of words that have an effect."""
    from matplotlib.text import Text

    for word in figure.findobj(Text):
        effects = word.get_path_effects() if isinstance(word, Text) else None
        if effects and isinstance(word, Text) and word.axes is not None:
            halo = Text(*word.get_position(), word.get_text())
            halo.update_from(word)
            halo.set_rotation(word.get_rotation())
            halo.set_linespacing(LINE_SPACING)
            halo.set_zorder(word.get_zorder() - 1e-3)
            halo.set_color(HALO)
            word.set_path_effects([])
            word.axes.add_artist(halo)
