"""A page for a picture of a place: its scale, and its bytes, which are the same each time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING

from comity_sim2d.pictures.lettering import lettering

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = {"png": 120, "svg": 72}


@contextmanager
def own_page(words: Iterable[str]) -> Iterator[None]:
    """Draw with letters for these words, and in SVG with the same ids each time."""
    from matplotlib import rc_context

    with lettering(words), rc_context({"svg.hashsalt": "Comity", "svg.fonttype": "path"}):
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


def as_bytes(figure: Figure, form: str) -> bytes:
    """The content of a `png` or `svg` file."""
    buffer = BytesIO()
    known = {"Title": "Comity", "Date": None} if form == "svg" else {"Software": "Comity"}
    figure.savefig(buffer, format=form, dpi=DPI[form], metadata=known)
    return buffer.getvalue()
