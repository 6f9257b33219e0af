"""Fonts for every script: used in order of preference, without warnings about missing letters."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache

FIRST = "DejaVu Sans"
"""The default font, shipped with matplotlib."""
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
"""Fonts of other scripts, if installed, in order of preference for letters that the first one lacks."""
NO_LETTERS = ("Last Resort", "STIX", "Noto Color", "Apple Color", "cm")
"""Name prefixes of fonts that draw boxes or symbols for letters, or pixels that matplotlib cannot draw."""
INVISIBLE = frozenset(" \t\n\r\u200b\u200c\u200d\ufe0e\ufe0f")
"""Characters that need no glyph: spaces, joiners, and emoji variation selectors."""


@contextmanager
def lettering(words: Iterable[str] = ()) -> Iterator[None]:
    """Use all available fonts; a letter that none has becomes a box, without a warning.

    Texts come from users: a dollar sign is printed and starts no formula.

    Args:
        words: The texts to be written: fonts for their letters are searched among all installed ones.
    """
    from matplotlib import rc_context

    families = list(dict.fromkeys((*fonts(), *_that_have(_letters(words)))))
    with warnings.catch_warnings(), rc_context({"font.family": families, "text.parse_math": False}):
        warnings.filterwarnings("ignore", message=r"Glyph .* missing from", category=UserWarning)
        yield


def lacking(text: str) -> str:
    """The letters of a text that no available font has, each once."""
    return "".join(letter for letter in _letters([text]) if _family_with(letter) is None)


@cache
def fonts() -> list[str]:
    """The default font, then installed ones with further letters."""
    from matplotlib.font_manager import fontManager

    installed = set(fontManager.get_font_names())
    return [FIRST, *(name for name in FURTHER if name in installed)]


def _letters(words: Iterable[str]) -> list[str]:
    return [letter for letter in dict.fromkeys("".join(words)) if letter not in INVISIBLE]


def _that_have(letters: Iterable[str]) -> list[str]:
    return [family for letter in letters if (family := _family_with(letter)) is not None]


@cache
def _family_with(letter: str) -> str | None:
    """The first font family that has a letter, in alphabetical order."""
    from matplotlib.font_manager import fontManager

    others = sorted({entry.name for entry in fontManager.ttflist} - set(fonts()))
    families = [*fonts(), *(name for name in others if not name.startswith(NO_LETTERS))]
    return next((name for name in families if ord(letter) in _code_points(name)), None)


@cache
def _code_points(family: str) -> frozenset[int]:
    from matplotlib.font_manager import fontManager, get_font

    files = sorted(entry.fname for entry in fontManager.ttflist if entry.name == family)
    try:
        return frozenset(get_font(files[0]).get_charmap()) if files else frozenset()
    except (OSError, RuntimeError, ValueError):  # a listed font that is missing or broken
        return frozenset()
