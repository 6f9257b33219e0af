"""Converts a numeric variable to the plain data below `variables:` in a rulebook file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from comity_fis.membership.curved import Curved
from comity_fis.membership.function import (
    Complement,
    NumericMembership,
    Singleton,
    Trapezoid,
    TwoTermGaussian,
)
from comity_fis.variables.resolution import resolved
from comity_fis.variables.variable import Derivation, NumericVariable

DIGITS = 12
"""Number of significant digits, relative to the variable's range: the fit is accurate to about nine."""


def variable_data(variable: NumericVariable, digits: int | None = DIGITS) -> dict[str, Any]:
    """A variable as data for a rulebook file; reading it back gives the same variable.

    Args:
        variable: A numeric variable.
        digits: Significant digits to keep; None: all.
    """
    coercion, derived, parts = variable.coercion, variable.derived_from, variable.partition
    span = variable.domain.high - variable.domain.low
    content = {
        "kind": variable.kind,
        "level": str(variable.level),
        "coercion": coercion and {"to": str(coercion.to), "reason": coercion.reason},
        "range": list(map(float, variable.domain.ends)),
        "unit": variable.unit,
        "derived_from": derived and derivation_data(derived),
        "terms": {name: term_data(term, digits, span) for name, term in variable.terms.items()},
        "shapes": variable.shapes,
        "reason": variable.reason,
        "partition": parts
        and {
            "data": parts.data,
            "radius": parts.radius,
            "centres": _rounded(parts.centres, digits, span),
            "squared_errors": _rounded(parts.squared_errors, digits),
            **({"largest_errors": _rounded(parts.largest_errors, digits)} if parts.largest_errors else {}),
            "method": parts.method,
            **({"held": dict(parts.held)} if parts.held else {}),
        },
    }
    return {key: value for key, value in content.items() if value is not None}


def derivation_data(derivation: Derivation) -> dict[str, str]:
    """A derivation as data for a rulebook file."""
    table = derivation.table
    named = {} if table is None else {"table": table.name, "column": table.column}
    return {key: value for key, value in {"fact": derivation.fact, **named}.items() if value}


def term_data(
    term: NumericMembership, digits: int | None = DIGITS, span: float | None = None
) -> dict[str, Any]:
    """A membership function as data for a rulebook file.

    Args:
        term: The function.
        digits: Significant digits to keep; None: all.
        span: Width of the variable's range, to which positions are rounded; None: round relative to the
            value.
    """
    match term:
        case Trapezoid():
            return {"trapezoid": _rounded(term.knots, digits, span)}
        case TwoTermGaussian(first, second):
            bumps = [
                _rounded((bump.height, bump.centre, bump.width), digits, span) for bump in (first, second)
            ]
            return {"two_term_gaussian": bumps}
        case Singleton(place):
            return {"singleton": _rounded([place], digits, span)[0]}
        case Complement(part):
            return {"complement": term_data(part, digits, span)}
        case Curved():
            return {term.matlab: _rounded(term.parameters, digits, span)}


def _rounded(numbers: Iterable[float], digits: int | None, span: float | None = None) -> list[float]:
    if digits is None:
        return list(numbers)
    return [float(resolved(number, span or abs(number), digits)) for number in numbers]
