"""Agreement on categories: how often a rulebook predicts the category that a study reports."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from comity_fis.record import Record


@dataclass(frozen=True, slots=True)
class StudyAgreement(Record):
    """Agreement of a nominal parameter with the rows of one study."""

    rows: int
    hits: int
    """Number of rows predicted correctly."""
    constant_hits: int | None
    """Hits of predicting, for each row, the most frequent word of the study's other rows; a tie counts as no
    hit. None for a single row."""


def agreement(pairs: Sequence[tuple[str, str]]) -> StudyAgreement:
    """Agreement between reported and predicted words.

    Args:
        pairs: For each row the reported and the predicted word.
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
