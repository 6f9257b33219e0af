"""How a parameter responds to what it depends on: values over one input, and over two."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations as pairs_of
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis import NominalParameter, NominalVariable, NumericParameter, NumericVariable
from comity_fis.audit.sweep import MOST, MOST_SLOWLY, combinations, is_quick
from comity_fis.rulebook.dependencies import reading

if TYPE_CHECKING:
    from comity_fis import Parameter, Rulebook, Variable

Floats = NDArray[np.float64]

CURVE, SURFACE = 121, 61
"""Even places along the axis of a curve, and along each axis of a surface."""
MOST_SURFACES = 4
MOST_LINES = 4
"""Categories of another input that a curve has a line for."""
VISIBLE = 0.05
"""Of the height of a panel: lines that are nearer together are not drawn."""
LEAST_EFFECT = 1e-9
UNDISCLOSED = -1
"""The place of no value."""

Held = Mapping[str, float | str]
"""Facts that are the same in the whole picture, by variable."""


@dataclass(frozen=True, slots=True)
class Response:
    """A parameter over one input.

    Values of a nominal parameter are the places of its categories in declared order.
    """

    variable: Variable
    places: Floats | tuple[str, ...]
    """Of the input: numbers, or its categories."""
    value: Floats
    """At each place, where the other facts are held or not disclosed."""
    others: Floats
    """The same with other facts disclosed: one row for each combination of them."""
    complete: bool
    """Whether every combination is there, and not a sample of them."""
    by: str = ""
    """A nominal input that the curve has lines for."""
    lines: Mapping[str, Floats] = field(default_factory=dict)
    """The value where that input has each of its categories."""

    @property
    def effect(self) -> float:
        """How much the input can change the value: the largest difference along a row."""
        return float(np.ptp(np.vstack([self.value, self.others]), axis=1).max())


@dataclass(frozen=True, slots=True)
class Surface:
    """A parameter over two numbers, with the other facts held or not disclosed."""

    across: NumericVariable
    up: NumericVariable
    xs: Floats
    ys: Floats
    values: Floats
    """One row for each of `ys`."""


@dataclass(frozen=True, slots=True)
class Responses:
    """All curves and surfaces of one parameter."""

    parameter: Parameter
    curves: tuple[Response, ...]
    """The input with the largest effect first."""
    without_effect: tuple[str, ...]
    """Inputs that the rules read and that change nothing here."""
    surfaces: tuple[Surface, ...]
    left_out: int
    """Pairs of numbers without a surface, which have the smallest effects."""
    held: Held
    """Those of the held facts that it depends on."""


def responses(rulebook: Rulebook, parameter: str, held: Held) -> Responses:
    """The curves over every input of a parameter, also through other parameters, and the surfaces over pairs.

    Args:
        rulebook: Whose answers are drawn.
        parameter: By name.
        held: Facts that are the same everywhere; every other input is varied or not disclosed.

    Raises:
        InputError: if a held value is outside its variable's domain.
    """
    inputs = reading(rulebook, rulebook.infer(held), parameter).inputs
    free = [
        variable
        for name in inputs
        if name not in held and not _follows_from(variable := rulebook.variables[name], held)
    ]
    curves = [_curve(rulebook, parameter, variable, free, held) for variable in free]
    curves.sort(key=lambda curve: -curve.effect)
    idle = tuple(curve.variable.name for curve in curves if not curve.effect > LEAST_EFFECT)
    curves = [curve for curve in curves if curve.variable.name not in idle]
    by = next((v for c in curves if (v := _of_few_categories(c.variable))), None)
    if by is not None and isinstance(rulebook.parameters[parameter], NumericParameter):
        curves = [_with_lines(rulebook, parameter, curve, by, held) for curve in curves]
    numbers = [curve.variable for curve in curves if isinstance(curve.variable, NumericVariable)]
    chosen = list(pairs_of(numbers, 2))
    return Responses(
        rulebook.parameters[parameter],
        tuple(curves),
        idle,
        tuple(_surface(rulebook, parameter, *pair, held) for pair in chosen[:MOST_SURFACES]),
        len(chosen[MOST_SURFACES:]),
        {name: held[name] for name in inputs if name in held},
    )


def _curve(
    rulebook: Rulebook, parameter: str, variable: Variable, free: Sequence[Variable], held: Held
) -> Response:
    if isinstance(variable, NumericVariable):
        low, high = variable.domain.ends
        knots = [x for term in variable.terms.values() for x in term.knots if low <= x <= high]
        places: Any = np.unique([*np.linspace(low, high, CURVE), *knots])
        column = places
    else:
        places = variable.categories
        column = _categories(variable)
    told = {other.name for other in free}
    others = [other for other in free if other is not variable and not _follows_from(other, told)]
    levels = [_levels(other) for other in others]
    choices = [np.arange(UNDISCLOSED, len(level) - 1) for level in levels]
    width = len(column)
    most = MOST if is_quick(rulebook) else MOST_SLOWLY
    contexts, complete = combinations(choices, max(1, most // width))
    columns: dict[str, Any] = {variable.name: np.tile(column, len(contexts))}
    for i, (other, level) in enumerate(zip(others, levels, strict=True)):
        columns[other.name] = np.repeat(level[contexts[:, i]], width)
    values = _values(rulebook, parameter, columns, held).reshape(len(contexts), width)
    return Response(variable, places, values[0], values[1:], complete)


def _of_few_categories(variable: Variable) -> NominalVariable | None:
    few = isinstance(variable, NominalVariable) and len(variable.categories) <= MOST_LINES
    return variable if few and isinstance(variable, NominalVariable) else None


def _with_lines(
    rulebook: Rulebook, parameter: str, curve: Response, by: NominalVariable, held: Held
) -> Response:
    """The curve with a line for each category of another input, where that makes a visible difference."""
    if not isinstance(curve.variable, NumericVariable):
        return curve
    lines = {
        category: _values(
            rulebook,
            parameter,
            {curve.variable.name: curve.places, by.name: np.full(len(curve.places), category)},
            held,
        )
        for category in by.categories
    }
    apart = np.ptp(np.vstack(list(lines.values())), axis=0).max()
    visible = apart > VISIBLE * np.ptp(np.vstack([curve.value, curve.others]))
    return replace(curve, by=by.name, lines=lines) if visible else curve


def _follows_from(variable: Variable, told: Collection[str]) -> bool:
    """Whether a variable is derived from a fact that is told: a score from a culture."""
    return variable.derived_from is not None and variable.derived_from.fact in told


def _surface(
    rulebook: Rulebook, parameter: str, across: NumericVariable, up: NumericVariable, held: Held
) -> Surface:
    xs, ys = (np.linspace(*variable.domain.ends, SURFACE) for variable in (across, up))
    columns = {across.name: np.tile(xs, SURFACE), up.name: np.repeat(ys, SURFACE)}
    values = _values(rulebook, parameter, columns, held).reshape(SURFACE, SURFACE)
    return Surface(across, up, xs, ys, values)


def _categories(variable: NominalVariable) -> NDArray[np.int64]:
    """The numbers of the categories, as `infer_many` takes them."""
    return np.arange(len(variable.categories)) + variable.first_number


def _levels(variable: Variable) -> NDArray[Any]:
    """Values that stand for all, of a number its ends and its terms' middles; the last is not disclosed."""
    if not isinstance(variable, NumericVariable):
        return np.append(_categories(variable), UNDISCLOSED)
    low, high = variable.domain.ends
    xs = np.linspace(low, high, CURVE)
    middles = [float(xs[np.argmax([term(float(x)) for x in xs])]) for term in variable.terms.values()]
    return np.append(np.unique([low, *middles, high]), nan)


def _values(rulebook: Rulebook, parameter: str, columns: Mapping[str, Any], held: Held) -> Floats:
    count = len(next(iter(columns.values())))
    constant = {name: np.full(count, value) for name, value in held.items()}
    values = rulebook.infer_many({**constant, **columns})[parameter]
    decided = rulebook.parameters[parameter]
    if isinstance(decided, NominalParameter):
        places = {name: place for place, name in enumerate(decided.terms)}
        return np.array([places[value] for value in values.tolist()], dtype=np.float64)
    return np.asarray(values, dtype=np.float64)
