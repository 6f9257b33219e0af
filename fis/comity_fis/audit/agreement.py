"""Agreement on words: how often a rulebook names the category that a study reports."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from comity_fis.record import Record


@dataclass(frozen=True, slots=True)
class StudyAgreement(Record):
    """What the rows of one study say about a nominal parameter."""

    rows: int
    hits: int
    """Rows of which the rulebook says what was reported."""
    constant_hits: int | None
    """Hits of saying, for each row, the most frequent word of the study's other rows; several that are
    equally frequent are no answer, and no hit. None for a single row."""


def agreement(pairs: Sequence[tuple[str, str]]) -> StudyAgreement:
    """How far two rows of words are the same.

    Args:
        pairs: For each row what was reported, and what the rulebook says.
    """
    reported = Counter(word for word, _ in pairs)
    constant = sum(_only_mode(reported - Counter([word])) == word for word, _ in pairs)
    return StudyAgreement(
        rows=len(pairs),
        hits=sum(word == said for word, said in pairs),
        constant_hits=constant if len(pairs) > 1 else None,
    )


def _only_mode(words: Counter[str]) -> str | None:
    first, *others = words.most_common(2) or [("", 0)]
    return None if others and others[0][1] == first[1] else first[0]
