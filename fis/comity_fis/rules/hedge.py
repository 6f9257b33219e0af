"""Hedges: words such as `very` that sharpen or soften a term."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

HEDGES: Mapping[str, float] = MappingProxyType(
    {
        # Concentration and dilation: Zadeh, "A fuzzy-set-theoretic interpretation of linguistic hedges",
        # Journal of Cybernetics 2 (1972).
        "very": 2.0,
        "more or less": 0.5,
        # Not from Zadeh; exponents common in textbooks, for example Negnevitsky, "Artificial Intelligence"
        # (2005). `slightly` is omitted: textbooks disagree whether it sharpens or softens.
        "somewhat": 0.5,
        "extremely": 3.0,
    }
)
"""Exponents of hedges: the hedged degree is the term's degree to this power."""
