"""A rulebook's variables and parameters as inputs and outputs of a `.fis` file, with indexed terms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import ceil, sqrt
from typing import TYPE_CHECKING

from comity_fis.errors import InputError
from comity_fis.membership.curved import Curved
from comity_fis.membership.function import (
    Complement,
    NumericMembership,
    Singleton,
    Trapezoid,
    TwoTermGaussian,
)
from comity_fis.membership.trapezoid_fit import nearest_trapezoid
from comity_fis.variables.parameter import NumericParameter, Parameter
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook


SAMPLES = 101
"""Number of points at which MATLAB samples the output of a Mamdani system."""


@dataclass(frozen=True, slots=True)
class Shape:
    """A membership function as MATLAB writes it."""

    kind: str
    numbers: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class MatlabVariable:
    """One input or output."""

    name: str
    low: float
    high: float
    shapes: Mapping[str, Shape]
    """Membership functions by term, in the file's order."""
    index: Mapping[str, int]
    """Index of each term in rules, from 1; negative for the complement of another term."""
    notes: tuple[str, ...] = ()
    """What was changed, or could not be expressed."""


def refuse_coarse(rulebook: Rulebook, tolerance: float | None) -> None:
    """Reject terms that no trapezoid approximates well enough, and state the tolerance that would suffice.

    Args:
        rulebook: The rulebook with the terms.
        tolerance: Maximum error of a trapezoid that replaces a curve; None rejects curves that MATLAB does
            not have.

    Raises:
        InputError: A term exceeds the tolerance; the worst one is named.
    """
    numeric = [v for v in rulebook.variables.values() if isinstance(v, NumericVariable)]
    outputs = [p for p in rulebook.parameters.values() if isinstance(p, NumericParameter)]
    columns = [(v.name, v.domain.ends, v.terms) for v in numeric]
    columns += [(p.name, p.rules.ends, p.terms) for p in outputs]
    off = {
        f"{term} of {name}": error
        for name, ends, terms in columns
        for term, membership in terms.items()
        if not isinstance(membership, Complement) and (error := _shape(membership, ends)[1]) is not None
    }
    worst = max(off, key=lambda called: off[called], default=None)
    if worst is None or (tolerance is not None and off[worst] <= tolerance):
        return
    enough = f"--piecewise-linear {ceil(1000 * off[worst]) / 1000:g}"
    if tolerance is None:
        raise InputError(
            expected=f"a membership function that MATLAB knows for {worst}",
            got="a sum of two Gaussians",
            remedy=f"Accept a trapezoid in its place with {enough}, the largest error allowed.",
        )
    raise InputError(
        expected=f"a trapezoid within {tolerance:g} of {worst}",
        got=f"a largest error of {off[worst]:.4f} by the best one found",
        remedy=f"Allow more with {enough}, which is enough for every term, or keep the YAML file.",
    )


def input_column(variable: Variable) -> MatlabVariable:
    """A variable as an input.

    Args:
        variable: A numeric variable is kept; the categories of a nominal one become the codes 1, 2, ....

    Raises:
        InputError: A term has no counterpart.
    """
    if isinstance(variable, NominalVariable):
        return _coded(variable)
    return _numeric(variable.name, variable.domain.ends, variable.terms)


def output_column(parameter: Parameter, *, sugeno: bool = False) -> MatlabVariable:
    """A parameter as an output.

    Args:
        parameter: A numeric parameter.
        sugeno: Whether its terms, all singletons, are the constants of a Sugeno system.

    Raises:
        InputError: The parameter is nominal, or a term has no counterpart.
    """
    if not isinstance(parameter, NumericParameter):
        raise InputError(
            expected="parameters that are numbers",
            got=f"{parameter.name}, one of {', '.join(parameter.terms)}",
            remedy="A .fis file has no outputs that are words; leave the parameter and its rules out.",
        )
    column = _numeric(parameter.name, parameter.rules.ends, parameter.terms)
    places = {name: term.place for name, term in parameter.terms.items() if isinstance(term, Singleton)}
    if sugeno:
        return replace(column, shapes={name: Shape("constant", (x,)) for name, x in places.items()})
    missed = [
        f"{parameter.name} is {name}: MATLAB looks at {SAMPLES} places of the range, and misses {x:g}"
        for name, x in places.items()
        if not _sampled(x, *parameter.rules.ends)
    ]
    return replace(column, notes=(*column.notes, *missed))


def _sampled(x: float, low: float, high: float) -> bool:
    """Whether MATLAB samples this value of an output's range."""
    steps = (x - low) / (high - low) * (SAMPLES - 1)
    return abs(steps - round(steps)) < 1e-9


def _numeric(name: str, ends: tuple[float, float], terms: Mapping[str, NumericMembership]) -> MatlabVariable:
    plain = {term: shape for term, shape in terms.items() if not isinstance(shape, Complement)}
    index = {term: number for number, term in enumerate(plain, 1)}
    for term, membership in terms.items():
        if isinstance(membership, Complement):
            index[term] = -next((index[other] for other in plain if plain[other] == membership.part), 0)
            if not index[term]:
                raise InputError(
                    expected=f"the opposite of the term {term} of {name} as a term of its own",
                    got="none",
                    remedy="Declare it: MATLAB writes a complement as `not` of another term.",
                )
    shapes: dict[str, Shape] = {}
    notes: list[str] = []
    for term, membership in plain.items():
        shapes[term], error = _shape(membership, ends)
        if error is not None:
            notes.append(f"{name} is {term}: a trapezoid in place of the curve, largest error {error:.4f}")
    return MatlabVariable(name, *ends, shapes, index, tuple(notes))


def _shape(term: NumericMembership, ends: tuple[float, float]) -> tuple[Shape, float | None]:
    """A term as a MATLAB shape, and the approximation error; None if the function is identical."""
    if isinstance(term, Curved):
        return Shape(term.matlab, term.parameters), None
    if isinstance(term, Trapezoid):
        return _straight(term), None
    if isinstance(term, Singleton):
        return Shape("trimf", (term.place,) * 3), None
    if isinstance(term, TwoTermGaussian) and (term.first.height, term.second.height) == (1, 0):
        return Shape("gaussmf", (term.first.width / sqrt(2), term.first.centre)), None
    near, error = nearest_trapezoid(term, *ends)
    return _straight(near), error


def _straight(term: Trapezoid) -> Shape:
    a, b, c, d = term.knots
    return Shape("trimf", (a, b, d)) if b == c else Shape("trapmf", (a, b, c, d))


def _coded(variable: NominalVariable) -> MatlabVariable:
    """Triangles that peak at the codes: at a code every degree is 1 or 0, as it is for the category."""
    codes = {category: code for code, category in enumerate(variable.categories, 1)}
    shapes = {
        category: Shape("trimf", (code - 1.0, float(code), code + 1.0)) for category, code in codes.items()
    }
    notes = [f"{variable.name}: {', '.join(f'{code} = {category}' for category, code in codes.items())}"]
    for name, group in variable.groups.items():
        members = sorted(codes[member] for member in group.members)
        if members and members[-1] - members[0] == len(members) - 1:
            first, last = members[0], members[-1]
            shapes[name] = Shape("trapmf", (first - 1.0, float(first), float(last), last + 1.0))
        else:
            notes.append(f"{variable.name}: no term for the group {name}, whose codes are not neighbours")
    index = {term: number for number, term in enumerate(shapes, 1)}
    return MatlabVariable(variable.name, 1.0, float(max(len(codes), 2)), shapes, index, tuple(notes))
