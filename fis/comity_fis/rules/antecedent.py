"""Evaluates the degree to which a condition holds, for one person or for columns of people.

`not` is pushed inwards by De Morgan's laws, so that only literals under `and` and `or` remain. An unknown
value then needs no special case: each of its literals, negated or not, has degree 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, NamedTuple, TypeVar

from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.methods import DUAL, OPERATORS, Methods
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not

Degree = TypeVar("Degree")
"""A degree in [0, 1], or an array of degrees."""

Operator = Callable[[Sequence[Degree]], Degree]
"""Combines several degrees into one."""


class Literal(NamedTuple):
    """`name is term`, possibly hedged or negated."""

    name: str
    term: str
    exponent: float = 1.0
    negated: bool = False


class Logic(NamedTuple, Generic[Degree]):
    """The operators for `and` and `or`, and their duals for negated conditions."""

    all_of: Operator[Degree]
    any_of: Operator[Degree]
    not_all_of: Operator[Degree]
    not_any_of: Operator[Degree]


def logic_of(methods: Methods, operators: Mapping[str, Operator[Degree]]) -> Logic[Degree]:
    """The operators for `and` and `or` by a rulebook's methods.

    Args:
        methods: Methods of the rulebook.
        operators: Operators by name (min, prod, max, probor), for one person or for columns.
    """
    return Logic(
        operators[methods.conjunction],
        operators[methods.disjunction],
        not_all_of=operators[DUAL[methods.conjunction]],
        not_any_of=operators[DUAL[methods.disjunction]],
    )


MIN_MAX = logic_of(Methods(), OPERATORS)
"""Min and max, for one person."""


def strength(
    condition: Condition,
    degree: Callable[[Literal], Degree],
    logic: Logic[Degree],
    *,
    negated: bool = False,
) -> Degree:
    """The degree to which a condition, or its negation, holds.

    Args:
        condition: Condition of a rule or a guard.
        degree: The degree of each literal.
        logic: The operators for `and` and `or`.
        negated: Whether to negate the condition.
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
    """The degree of a literal from its term's degree (or array of degrees): hedged, then negated."""
    found: Any = degree
    if literal.exponent != 1.0:
        found = found**literal.exponent
    wanted: Degree = 1.0 - found if literal.negated else found
    return wanted
