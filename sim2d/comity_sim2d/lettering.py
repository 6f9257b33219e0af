"""Letters of every script that a picture can show: fonts one after the other, and silence about the rest."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache

FIRST = "DejaVu Sans"
"""Comes with matplotlib."""
FURTHER = (
    "Noto Sans CJK JP",
    "Noto Sans CJK SC",
    "Noto Sans JP",
    "Noto Sans SC",
    "Source Han Sans",
    "WenQuanYi Zen Hei",
    "WenQuanYi Micro Hei",
    "IPAGothic",
    "Hiragino Sans",
    "PingFang SC",
    "Yu Gothic",
    "Microsoft YaHei",
    "MS Gothic",
    "Malgun Gothic",
    "Arial Unicode MS",
)
"""Of other scripts, where they are installed; asked in this order for letters that the first one lacks."""


@contextmanager
def lettering() -> Iterator[None]:
    """Draw with every font there is; a letter that none has becomes a box, without a warning.

    Words are users' own: a dollar in them is a dollar, and begins no formula.
    """
    from matplotlib import rc_context

    with warnings.catch_warnings(), rc_context({"font.family": fonts(), "text.parse_math": False}):
        warnings.filterwarnings("ignore", message=r"Glyph .* missing from", category=UserWarning)
        yield


@cache
def fonts() -> list[str]:
    """The font of all pictures, then those installed that have further letters."""
    from matplotlib.font_manager import fontManager

    installed = set(fontManager.get_font_names())
    return [FIRST, *(name for name in FURTHER if name in installed)]
