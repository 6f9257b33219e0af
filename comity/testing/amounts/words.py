"""Case-insensitive search for whole words and whole numbers in a text."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache


def holds(text: str, words: str) -> bool:
    """Whether a text contains these words in sequence: `rule 1` is not contained in `rule 11`."""
    return _pattern(words).search(_folded(text)) is not None


def _folded(text: str) -> str:
    """Normalised, case-folded text: `é` may be one code point or two, and `ß` is `SS` in capitals."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", text).casefold())


@lru_cache(maxsize=512)
def _pattern(words: str) -> re.Pattern[str]:
    """A pattern bounded by non-alphanumeric characters; numbers match as a whole, with their decimals."""
    words = _folded(words)
    parts = r"\s+".join(map(re.escape, words.split()))
    before = r"(?<!\w)(?<!\d[.,])" if re.match(r"\s*\w", words) else ""
    behind = r"(?!\w|[.,]\d)" if re.search(r"\w\s*$", words) else ""
    return re.compile(f"{before}{parts}{behind}")
