"""A page for a picture of a place: its scale, and reproducible bytes."""

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
"""File formats of pictures."""
POINTS_PER_IN = 72
DPI = {"png": 120, "svg": POINTS_PER_IN, "pdf": POINTS_PER_IN}
LINE_SPACING = 1.25
"""Line spacing of text on a map, relative to the font size."""
PDF_MARK = b"%Comity"
"""Mark at the end of our PDFs, whose metadata are not near the start."""


@contextmanager
def own_page(words: Iterable[str]) -> Iterator[None]:
    """Draw with fonts for these texts, keep text as text, and use reproducible ids."""
    with lettering(words), words_as_words():
        yield


@contextmanager
def words_as_words() -> Iterator[None]:
    """Keep text in SVG and PDF as text, to be searched and edited, with reproducible ids."""
    from matplotlib import rc_context

    with rc_context({"svg.hashsalt": "Comity", "svg.fonttype": "none", "pdf.fonttype": 42}):
        yield


def in_per_m(extent_m: tuple[float, float], usual: float, *, least_in: float, most_in: float) -> float:
    """The scale of a page [in/m]: the usual one, unless the page would be too narrow or too large.

    Args:
        extent_m: Width and height of the place [m].
        usual: Scale at which labels fit [in/m].
        least_in: Minimum width of the page [in].
        most_in: Maximum length of the longer side of the page [in].
    """
    wide, high = extent_m
    return min(max(usual, least_in / wide), most_in / max(wide, high))


def as_bytes(figure: Figure, form: str, dpi: float | None = None) -> bytes:
    """The bytes of a file in one of `FORMS`, reproducible: they contain no date.

    Args:
        figure: The figure, for vector formats at `POINTS_PER_IN`.
        form: File format.
        dpi: Pixels per inch; None: `DPI`.
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
    """Draw halos as outlines below their text: matplotlib turns text with an effect into paths."""
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
