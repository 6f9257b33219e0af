"""Equal costs: which of several plans of the same cost is made.

Everywhere the same order decides: higher desirability, then the neutral value, then the scenario's order of
people, then front, left, right, then the name. An inferred value is the most desirable one and, where several
are, the neutral one; a choice that departs from it therefore comes later.

`tie_break` holds the first two parts as one number that adds up over a plan. The label search compares it and
then the order of people; along an order, `best_tour` compares it and then the sides.
"""

from __future__ import annotations

_WHOLE = 1_000_000
"""A desirability of 1 in the units that are compared: a smaller difference is rounding."""
_DEPARTURES = 4_096
"""More departures than a plan has: a visit has a side and two words for each greeting, 40 visits are many."""


def tie_break(desirability: float, departures: int = 0) -> int:
    """What decides between choices of equal cost; less is better, and that of a plan is the sum.

    Args:
        desirability: Of the choice, in [0, 1].
        departures: The number of its values that differ from the inferred ones.
    """
    return (_WHOLE - round(_WHOLE * desirability)) * _DEPARTURES + departures


def untied(tie: int) -> tuple[float, int]:
    """The desirability, to six decimals, and the departures of a `tie_break`."""
    missing, departures = divmod(tie, _DEPARTURES)
    return (_WHOLE - missing) / _WHOLE, departures
