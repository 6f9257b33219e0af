"""Validates language tags and scripts of wordings."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping

from comity_fis.errors import WrongValueError, closest

TAG = re.compile(
    r"""(?:[a-z]{2,3}(?:-[a-z]{3}){0,3}|[a-z]{4}|[a-z]{5,8})  # ISO 639, or longer
    (?:-[a-z]{4})?                                            # script: ISO 15924
    (?:-(?:[a-z]{2}|[0-9]{3}))?                               # region: ISO 3166-1 or UN M.49
    (?P<variants>(?:-(?:[a-z0-9]{5,8}|[0-9][a-z0-9]{3}))*)
    (?P<extensions>(?:-[a-wyz0-9](?:-[a-z0-9]{2,8})+)*)
    (?:-x(?:-[a-z0-9]{1,8})+)?                                # private use
    """,
    re.VERBOSE | re.IGNORECASE,
)
"""A `langtag` of RFC 5646 (BCP 47), section 2.1."""

LATIN = "Latn"
SCRIPTS: Mapping[str, tuple[str, ...]] = {
    LATIN: ("LATIN",),
    "Arab": ("ARABIC",),
    "Armn": ("ARMENIAN",),
    "Beng": ("BENGALI",),
    "Cyrl": ("CYRILLIC",),
    "Deva": ("DEVANAGARI",),
    "Ethi": ("ETHIOPIC",),
    "Geor": ("GEORGIAN",),
    "Grek": ("GREEK",),
    "Gujr": ("GUJARATI",),
    "Guru": ("GURMUKHI",),
    "Hang": ("HANGUL",),
    "Hans": ("CJK",),
    "Hant": ("CJK",),
    "Hebr": ("HEBREW",),
    "Jpan": ("HIRAGANA", "KATAKANA", "CJK"),
    "Khmr": ("KHMER",),
    "Knda": ("KANNADA",),
    "Kore": ("HANGUL", "CJK"),
    "Laoo": ("LAO",),
    "Mlym": ("MALAYALAM",),
    "Mymr": ("MYANMAR",),
    "Orya": ("ORIYA",),
    "Sinh": ("SINHALA",),
    "Taml": ("TAMIL",),
    "Telu": ("TELUGU",),
    "Thai": ("THAI",),
    "Tibt": ("TIBETAN",),
}
"""ISO 15924 codes of scripts, each with the prefixes of its letters' Unicode names."""


def read_tag(words: str) -> str:
    """Check that a language tag is well-formed by BCP 47, not that its parts are registered.

    Raises:
        WrongValueError: It is not well-formed, or repeats a variant or an extension.
    """
    found = TAG.fullmatch(words)
    if found:
        variants = found["variants"].casefold().split("-")[1:]
        singletons = re.findall(r"-([a-z0-9])(?=-)", found["extensions"].casefold())
        if len({*variants}) == len(variants) and len({*singletons}) == len(singletons):
            return words
    raise WrongValueError(
        expected="a language by its BCP 47 tag",
        got=repr(words),
        remedy="Write for example ar, sv, de-AT or zh-Hant-TW.",
    )


def read_script(words: str) -> str:
    """Check the code of a script.

    Raises:
        WrongValueError: It is not a script in `SCRIPTS`.
    """
    if words in SCRIPTS:
        return words
    raise WrongValueError(
        expected=f"a script by its ISO 15924 code: {', '.join(SCRIPTS)}",
        got=repr(words),
        remedy=closest(words, SCRIPTS),
    )


def require_script(text: str, script: str, what: str) -> None:
    """Reject letters of another script.

    Args:
        text: The text; only its letters are checked.
        script: A code of `SCRIPTS`.
        what: Name of the text in messages.

    Raises:
        WrongValueError: The text has such letters.
    """
    foreign = [one for one in text if unicodedata.category(one)[0] == "L" and not _is_of(one, script)]
    if foreign:
        raise WrongValueError(
            expected=f"{what} in letters of the script {script}",
            got=f"{''.join(foreign)!r} in {text!r}",
            remedy="Write it in that script, or state another `script`.",
        )


def _is_of(letter: str, script: str) -> bool:
    return unicodedata.name(letter, "").startswith(SCRIPTS[script])
