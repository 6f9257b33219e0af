"""The languages that a person names, by code or by name."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping

from comity_fis.errors import WrongValueError

CODE = re.compile(r"[A-Za-z]{2,3}(-[A-Za-z0-9]{1,8})*")
"""Form of a BCP 47 language tag (RFC 5646) that begins with an ISO 639 code: `swe`, `sv`, `de-AT`."""
JOINING = " '\u2019-"
"""Characters allowed between the letters of a name; letters may be of any script."""

ALSO: Mapping[str, tuple[str, ...]] = {
    "eng": ("en", "english"),
    "ara": ("ar", "arabic"),
    "deu": ("de", "ger", "german"),
    "jpn": ("ja", "japanese"),
    "swe": ("sv", "swedish"),
}
"""Languages with phrases for the robot, by ISO 639-3 code: other codes, and the English name."""


def read_language(words: str) -> str:
    """Validate the form of a language code or name; whether the language exists is not checked.

    Raises:
        WrongValueError: It has the form of neither.
    """
    if CODE.fullmatch(words) or _is_name(words):
        return words
    raise WrongValueError(
        expected="a language by code (swe, sv, de-AT) or by name (Swedish)",
        got=repr(words),
        remedy="Write for example [ara, Swedish], the best liked first.",
    )


def iso639(words: str) -> str:
    """ISO 639-3 code of a language with phrases for the robot; any other text in lower case.

    Subtags, such as the country, are dropped: `de-AT` becomes `deu`.
    """
    said = words.casefold()
    language = said.partition("-")[0] if CODE.fullmatch(said) else said
    return next((code for code, also in ALSO.items() if language in (code, *also)), said)


def _is_name(words: str) -> bool:
    """Two letters or more, with the combining marks of scripts such as Devanagari."""
    kinds = [unicodedata.category(character)[0] for character in words if character not in JOINING]
    return set(kinds) <= {"L", "M"} and kinds.count("L") > 1
