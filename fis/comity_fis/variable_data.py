"""A numeric variable as the plain values that a rulebook file holds below `variables:`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from comity_fis.matlab_membership import Complement, Curved
from comity_fis.membership import NumericMembership, Trapezoid, TwoTermGaussian
from comity_fis.variable import NumericVariable

DIGITS = 12
"""Significant ones: the fit itself is good to about nine."""


def variable_data(variable: NumericVariable, digits: int | None = DIGITS) -> dict[str, Any]:
    """What a rulebook file says of a variable; reading it back gives the same one.

    Args:
        variable: Over numbers.
        digits: The significant ones that are kept; None: all of them.
    """
    coercion, derived, parts = variable.coercion, variable.derived_from, variable.partition
    content = {
        "kind": variable.kind,
        "level": str(variable.level),
        "coercion": coercion and {"to": str(coercion.to), "reason": coercion.reason},
        "range": _rounded(variable.domain.ends, digits),
        "unit": variable.unit,
        "derived_from": derived
        and {"fact": derived.fact, **({"table": derived.table} if derived.table else {})},
        "terms": {name: term_data(term, digits) for name, term in variable.terms.items()},
        "shapes": variable.shapes,
        "reason": variable.reason,
        "partition": parts
        and {
            "data": parts.data,
            "radius": parts.radius,
            "centres": _rounded(parts.centres, digits),
            "squared_errors": _rounded(parts.squared_errors, digits),
            "method": parts.method,
        },
    }
    return {key: value for key, value in content.items() if value is not None}


def term_data(term: NumericMembership, digits: int | None = DIGITS) -> dict[str, Any]:
    """What a rulebook file says of a membership function."""
    match term:
        case Trapezoid():
            return {"trapezoid": _rounded(term.knots, digits)}
        case TwoTermGaussian(first, second):
            bumps = [_rounded((bump.height, bump.centre, bump.width), digits) for bump in (first, second)]
            return {"two_term_gaussian": bumps}
        case Complement(part):
            return {"complement": term_data(part, digits)}
        case Curved():
            return {term.matlab: _rounded(term.parameters, digits)}


def _rounded(numbers: Iterable[float], digits: int | None) -> list[float]:
    return [number if digits is None else float(f"{number:.{digits}g}") for number in numbers]
