"""Tie-breaking between plans of equal cost.

The same order decides everywhere: higher desirability, then the neutral value, then the scenario's order of
people, then front, left, right, then the name. An inferred value is the most desirable one and, if several
are, the neutral one; so a choice that departs from it comes later.

`tie_break` encodes the first two parts as one number that is additive over a plan. The label search compares
it and then the order of people; for a given order, `best_tour` compares it and then the sides.
"""

from __future__ import annotations

_WHOLE = 1_000_000
"""Scale of desirabilities in a tie-break: smaller differences are rounding."""
_DEPARTURES = 4_096
"""Upper bound of the departures of a plan: each visit has a side and two words per greeting, and 40 visits
are many."""


def tie_break(desirability: float, departures: int = 0) -> int:
    """Tie-break value of a choice; smaller is better, and that of a plan is the sum.

    Args:
        desirability: Desirability of the choice, in [0, 1].
        departures: Number of its values that differ from the inferred ones.
    """
    return (_WHOLE - round(_WHOLE * desirability)) * _DEPARTURES + departures


def untied(tie: int) -> tuple[float, int]:
    """The desirability, to six decimals, and the departures of a `tie_break`."""
    missing, departures = divmod(tie, _DEPARTURES)
    return (_WHOLE - missing) / _WHOLE, departures
