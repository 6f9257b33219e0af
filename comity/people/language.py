"""The languages that a person names, by code or by name."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping

from comity_fis.errors import WrongValueError

CODE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{1,8})*")
"""The shape of a language tag of BCP 47 (RFC 5646) that begins with an ISO 639 code: `swe`, `sv`, `de-AT`."""
JOINING = " '\u2019-"
"""What may stand between the letters of a name, which are of any script."""

ALSO: Mapping[str, tuple[str, ...]] = {
    "eng": ("en", "english"),
    "ara": ("ar", "arabic"),
    "deu": ("de", "ger", "german"),
    "jpn": ("ja", "japanese"),
    "swe": ("sv", "swedish"),
}
"""The languages that the robot has phrases in, by ISO 639-3 code: other codes, and the English name."""


def read_language(words: str) -> str:
    """A language as a person wrote it, if it can be one; which languages there are is not asked.

    Raises:
        WrongValueError: if it has neither the shape of a code nor that of a name.
    """
    if CODE.fullmatch(words) or _is_name(words):
        return words
    raise WrongValueError(
        expected="a language by code (swe, sv, de-AT) or by name (Swedish)",
        got=repr(words),
        remedy="Write for example [ara, Swedish], the best liked first.",
    )


def iso639(words: str) -> str:
    """The ISO 639-3 code of a language that the robot has phrases in; any other as it came, in small letters.

    What a tag says beyond the language, such as the country, is left aside: `de-AT` is `deu`.
    """
    said = words.casefold()
    language = said.partition("-")[0] if CODE.fullmatch(said) else said
    return next((code for code, also in ALSO.items() if language in (code, *also)), said)


def _is_name(words: str) -> bool:
    """Two letters or more, with the signs that belong to them in scripts such as Devanagari."""
    kinds = [unicodedata.category(character)[0] for character in words if character not in JOINING]
    return set(kinds) <= {"L", "M"} and kinds.count("L") > 1
