"""Converts a rulebook to a scikit-fuzzy control system (`skfuzzy.control`), with terms sampled on a grid."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError, shown
from comity_fis.listing import listed
from comity_fis.membership.arrays import degrees
from comity_fis.membership.function import Singleton
from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.methods import Methods, probor
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not, Rule
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from comity_fis.inference.block import Program
    from comity_fis.membership.function import NumericMembership
    from comity_fis.variables.parameter import Parameter

Floats = NDArray[np.float64]

LEAST_POINTS, MOST_POINTS = 11, 100_001
LABEL = "rule {}"
"""Label of a rule in the control system, by its number in the rulebook."""

COUNTERPARTS: Mapping[str, tuple[str, ...]] = {
    "conjunction": ("min", "prod"),
    "disjunction": ("max", "probor"),
    "implication": ("min",),
    "aggregation": ("max",),
    "defuzzification": ("centroid", "bisector"),
}
"""Methods that `skfuzzy.control` evaluates as Comity does. It takes maxima (mom, som, lom) over its grid
points; by grid error this may be another term's equally high maximum."""


def control_system(
    program: Program, parameters: Mapping[str, Parameter], rules: Sequence[Rule], points: int
) -> Any:
    """See `Rulebook.to_skfuzzy`."""
    if not isinstance(points, int) or isinstance(points, bool) or not LEAST_POINTS <= points <= MOST_POINTS:
        raise InputError(
            expected=f"a whole number of points from {LEAST_POINTS} to {MOST_POINTS}",
            got=shown(points),
            remedy="Leave it out for 1001.",
        )
    rules = [rule for rule in rules if rule.enabled]
    _refuse(program, parameters, rules)
    from skfuzzy import control  # the import takes most of a second

    read = dict.fromkeys(name for rule in rules for name in rule.reads)
    inputs: dict[str, Any] = {}
    for name in read:
        variable = program.variables[name]
        assert isinstance(variable, NumericVariable)
        xs = _universe(*variable.domain.ends, variable.terms.values(), points)
        if any(is_.part.name == name for rule in rules for is_ in _hedged(rule.antecedent)):
            xs = _graded(xs, variable.terms.values())
        inputs[name] = control.Antecedent(xs, name)
        _add_terms(inputs[name], variable.terms, xs)
    outputs: dict[str, Any] = {}
    for name, parameter in parameters.items():
        assert isinstance(parameter, NumericParameter)
        xs = _universe(*parameter.rules.ends, parameter.terms.values(), points)
        outputs[name] = control.Consequent(xs, name, program.methods.defuzzification)
        _add_terms(outputs[name], parameter.terms, xs)
    return control.ControlSystem([_rule(rule, inputs, outputs, program.methods) for rule in rules])


def _refuse(program: Program, parameters: Mapping[str, Parameter], rules: list[Rule]) -> None:
    """Reject features that affect values and have no counterpart in `skfuzzy.control`."""
    _refuse_reads(program, parameters, rules)
    _refuse_outputs(program, parameters, rules)
    for field, known in COUNTERPARTS.items():
        if (method := getattr(program.methods, field)) not in known:
            raise _refusal(f"{field} by {listed(known, 'or')}", method)


def _refuse_reads(program: Program, parameters: Mapping[str, Parameter], rules: list[Rule]) -> None:
    for name in dict.fromkeys(name for rule in rules for name in rule.reads):
        if name in parameters:
            raise _refusal("rules that read variables only", f"rules that read the parameter {name}")
        if not isinstance(program.variables[name], NumericVariable):
            raise _refusal("inputs that are numbers", f"the words of {name}")


def _refuse_outputs(program: Program, parameters: Mapping[str, Parameter], rules: list[Rule]) -> None:
    for name, parameter in parameters.items():
        if not isinstance(parameter, NumericParameter):
            raise _refusal("parameters that are numbers", f"the words of {name}")
        if name in program.shifts:
            raise _refusal("values that no situation moves", f"the shift of {name}")
        if name in program.variables:
            raise _refusal("different names for inputs and outputs", f"{name} twice")
        singles = [term for term, shape in parameter.terms.items() if isinstance(shape, Singleton)]
        if singles:
            raise _refusal("output terms with an area", f"the singleton {singles[0]} of {name}")
        if not any(is_.name == name for rule in rules for is_ in rule.consequents):
            raise _refusal(f"a rule that concludes {name}", "none that is on")


def _refusal(expected: str, got: str) -> InputError:
    return InputError(
        expected=f"{expected}, for skfuzzy.control",
        got=got,
        remedy="Leave it out of the rulebook, or let Comity infer.",
    )


def _universe(low: float, high: float, terms: Iterable[NumericMembership], points: int) -> Floats:
    """An even grid plus every corner, and the nearest floats next to corners with a vertical edge."""
    knots = np.array([knot for term in terms for knot in term.knots], dtype=np.float64)
    beside = np.spacing(max(abs(low), abs(high)))
    places = np.concatenate([np.linspace(low, high, points), knots - beside, knots, knots + beside])
    found: Floats = np.unique(places[(places >= low) & (places <= high)])
    return found


def _graded(xs: Floats, terms: Iterable[NumericMembership]) -> Floats:
    """Additional points, denser near corners: a hedge may take a root, whose slope is unbounded there."""
    knots = np.array([knot for term in terms for knot in term.knots], dtype=np.float64)
    steps = (xs[-1] - xs[0]) * 2.0 ** -np.arange(4, 40)
    places = np.concatenate([xs, np.add.outer(knots, steps).ravel(), np.subtract.outer(knots, steps).ravel()])
    found: Floats = np.unique(places[(places >= xs[0]) & (places <= xs[-1])])
    return found


def _hedged(condition: Condition) -> Iterator[Hedged]:
    """Every hedged term of a condition."""
    if isinstance(condition, Hedged):
        yield condition
    elif isinstance(condition, Not):
        yield from _hedged(condition.part)
    elif not isinstance(condition, Is):
        for part in condition.parts:
            yield from _hedged(part)


def _add_terms(variable: Any, terms: Mapping[str, NumericMembership], xs: Floats) -> None:
    for name, term in terms.items():
        variable[name] = degrees(term, xs)


def _rule(rule: Rule, inputs: Mapping[str, Any], outputs: Mapping[str, Any], methods: Methods) -> Any:
    from skfuzzy import control

    both: Mapping[str, Any] = {"min": np.fmin, "prod": np.multiply}
    either: Mapping[str, Any] = {"max": np.fmax, "probor": probor}
    return control.Rule(
        _condition(rule.antecedent, inputs),
        [outputs[is_.name][is_.term] % float(rule.weight) for is_ in rule.consequents],
        label=LABEL.format(rule.number),
        and_func=both[methods.conjunction],
        or_func=either[methods.disjunction],
    )


def _condition(condition: Condition, inputs: Mapping[str, Any]) -> Any:
    """A condition with scikit-fuzzy's operators; a hedged term becomes a separate term, `very high`."""
    if isinstance(condition, Is):
        return inputs[condition.name][condition.term]
    if isinstance(condition, Hedged):
        variable, plain = inputs[condition.part.name], condition.part.term
        name = f"{condition.hedge} {plain}"
        if name not in variable:
            variable[name] = variable[plain].mf ** HEDGES[condition.hedge]
        return variable[name]
    if isinstance(condition, Not):
        return ~_condition(condition.part, inputs)
    parts = [_condition(part, inputs) for part in condition.parts]
    if isinstance(condition, And):
        return reduce(lambda one, other: one & other, parts)
    return reduce(lambda one, other: one | other, parts)
