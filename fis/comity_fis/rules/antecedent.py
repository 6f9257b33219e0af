"""To what degree a condition holds, for one person or for a column of them.

`not` is moved inwards by De Morgan's laws, so that what remains are literals under `and` and `or`. An
undisclosed value then needs no special case: each of its literals, negated or not, has degree 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, NamedTuple, TypeVar

from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.methods import DUAL, OPERATORS, Methods
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not

Degree = TypeVar("Degree")
"""A degree in [0, 1], or an array of them."""

Operator = Callable[[Sequence[Degree]], Degree]
"""One degree from several."""


class Literal(NamedTuple):
    """`name is term`, possibly hedged, possibly negated."""

    name: str
    term: str
    exponent: float = 1.0
    negated: bool = False


class Logic(NamedTuple, Generic[Degree]):
    """What `and` and `or` do to degrees, and `not` before them to the degrees of the opposites."""

    all_of: Operator[Degree]
    any_of: Operator[Degree]
    not_all_of: Operator[Degree]
    not_any_of: Operator[Degree]


def logic_of(methods: Methods, operators: Mapping[str, Operator[Degree]]) -> Logic[Degree]:
    """What a rulebook's methods make of `and` and `or`.

    Args:
        methods: Of the rulebook.
        operators: By name (min, prod, max, probor), for one person or for columns.
    """
    return Logic(
        operators[methods.conjunction],
        operators[methods.disjunction],
        not_all_of=operators[DUAL[methods.conjunction]],
        not_any_of=operators[DUAL[methods.disjunction]],
    )


MIN_MAX = logic_of(Methods(), OPERATORS)
"""For one person, by min and max."""


def strength(
    condition: Condition,
    degree: Callable[[Literal], Degree],
    logic: Logic[Degree],
    *,
    negated: bool = False,
) -> Degree:
    """The degree to which a condition, or its opposite, holds.

    Args:
        condition: What a rule or a guard says.
        degree: The degree of each literal.
        logic: What `and` and `or` mean.
        negated: Whether the opposite is meant.
    """
    if isinstance(condition, Is):
        return degree(Literal(condition.name, condition.term, 1.0, negated))
    if isinstance(condition, Hedged):
        part = condition.part
        return degree(Literal(part.name, part.term, HEDGES[condition.hedge], negated))
    if isinstance(condition, Not):
        return strength(condition.part, degree, logic, negated=not negated)
    parts = [strength(part, degree, logic, negated=negated) for part in condition.parts]
    if isinstance(condition, And):
        return (logic.not_all_of if negated else logic.all_of)(parts)
    return (logic.not_any_of if negated else logic.any_of)(parts)


def hedged(degree: Degree, literal: Literal) -> Degree:
    """The degree of a term, or an array of degrees, as a literal wants it: hedged, then negated."""
    found: Any = degree
    if literal.exponent != 1.0:
        found = found**literal.exponent
    wanted: Degree = 1.0 - found if literal.negated else found
    return wanted
