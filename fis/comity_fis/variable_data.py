"""A numeric variable as the plain values that a rulebook file holds below `variables:`."""

from __future__ import annotations

from typing import Any

from comity_fis.membership import NumericMembership, Trapezoid, TwoTermGaussian
from comity_fis.variable import NumericVariable

DIGITS = 12
"""Significant ones: the fit itself is good to about nine."""


def variable_data(variable: NumericVariable) -> dict[str, Any]:
    """What a rulebook file says of a variable; reading it back gives the same one, to twelve digits."""
    coercion, derived, parts = variable.coercion, variable.derived_from, variable.partition
    content = {
        "kind": variable.kind,
        "level": str(variable.level),
        "coercion": coercion and {"to": str(coercion.to), "reason": coercion.reason},
        "range": _rounded(*variable.domain.ends),
        "unit": variable.unit,
        "derived_from": derived and {"fact": derived.fact, "table": derived.table},
        "terms": {name: _term(term) for name, term in variable.terms.items()},
        "shapes": variable.shapes,
        "reason": variable.reason,
        "partition": parts
        and {
            "data": parts.data,
            "radius": parts.radius,
            "centres": _rounded(*parts.centres),
            "squared_errors": _rounded(*parts.squared_errors),
            "method": parts.method,
        },
    }
    return {key: value for key, value in content.items() if value is not None}


def _term(term: NumericMembership) -> dict[str, Any]:
    match term:
        case Trapezoid():
            return {"trapezoid": _rounded(*term.knots)}
        case TwoTermGaussian(first, second):
            bumps = [_rounded(bump.height, bump.centre, bump.width) for bump in (first, second)]
            return {"two_term_gaussian": bumps}


def _rounded(*numbers: float) -> list[float]:
    return [float(f"{number:.{DIGITS}g}") for number in numbers]
