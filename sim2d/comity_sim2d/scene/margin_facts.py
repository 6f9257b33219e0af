"""Declared facts of a person that decide whether a robot may pass them at a reduced margin."""

from __future__ import annotations

from dataclasses import dataclass, field

from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.scene_error import require_between

OLDEST_YEARS = 150.0


@dataclass(frozen=True, slots=True)
class MarginFacts:
    """Declared facts of a person; the defaults, for unknown facts, refuse the reduced margin."""

    age_years: float | None = None
    """Age [years], the minimum if a range was declared; None: not disclosed."""
    walks_unaided: bool = False
    hears_well: bool = False
    sees_well: bool = False
    stands: bool = True
    """Whether no other posture is declared, for now or later."""
    uses_wheelchair: bool = False
    """Whether that is declared; the reason to keep the full margin is told as such."""
    words: tuple[tuple[str, str], ...] = field(default=(), compare=False)
    """Declared words that refuse it, for reasons: pairs of `hearing`, `sight` or `mobility` and the word."""

    def __post_init__(self) -> None:
        if self.age_years is not None:
            require_between("margin facts", "age_years", self.age_years, 0.0, OLDEST_YEARS)
        declared = {
            name: getattr(self, name)
            for name in ("walks_unaided", "uses_wheelchair", "hears_well", "sees_well", "stands")
        }
        require_kinds("margin facts", **{name: (value, TRUTH) for name, value in declared.items()})
