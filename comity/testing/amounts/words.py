"""Whether a text holds words: whole ones and whole numbers, in small letters or capitals, however typed."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache


def holds(text: str, words: str) -> bool:
    """Whether these words stand in the text, one after the other: `rule 1` does not in `rule 11`."""
    return _pattern(words).search(_folded(text)) is not None


def _folded(text: str) -> str:
    """Without what nobody sees or means: `é` may be one sign or two, and `ß` is `SS` in capitals."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", text).casefold())


@lru_cache(maxsize=512)
def _pattern(words: str) -> re.Pattern[str]:
    """No letter or digit may go on before or behind, nor a number across its point."""
    words = _folded(words)
    parts = r"\s+".join(map(re.escape, words.split()))
    before = r"(?<!\w)(?<!\d[.,])" if re.match(r"\s*\w", words) else ""
    behind = r"(?!\w|[.,]\d)" if re.search(r"\w\s*$", words) else ""
    return re.compile(f"{before}{parts}{behind}")
