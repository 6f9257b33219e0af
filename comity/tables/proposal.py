"""Proposals learnt from examples, as a rulebook: rules over its own terms, or a prior for each culture."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import fsum
from types import MappingProxyType

import numpy as np

from comity.tables.basis import ParameterRules, with_value_rules
from comity.tables.examples import GROUP, ExampleRow
from comity_fis import NominalVariable, NumericParameter, NumericVariable, Rulebook, Source, Variable
from comity_fis.audit.order import equality_band
from comity_fis.inference.column import Floats, read_columns
from comity_fis.learning.pooling import PooledPrior, StatedOffset, pooled
from comity_fis.learning.rule_table import Cell, rule_table
from comity_fis.membership.function import Trapezoid
from comity_fis.rules.antecedent import Literal
from comity_fis.rules.rule import Condition, Is, Rule

HALF_WIDTH = 0.1
"""Half the width of a learnt term, as a share of the output range (our choice): only its centre matters."""
NARROWEST = 0.01
"""Half width of a term at an end of that range, where a wider one would not be symmetric."""


def cells_of(basis: ParameterRules, inputs: Sequence[str], rows: Iterable[ExampleRow]) -> tuple[Cell, ...]:
    """Answers of people for every combination of the inputs' terms.

    A person counts once per situation, with the mean of their rows.
    """
    said: dict[tuple[object, ...], list[float]] = defaultdict(list)
    for row in rows:
        if is_in_terms(basis.rulebook, inputs, row):
            said[row.person, *(row.inputs[name] for name in inputs)].append(row.value)
    told = {key: fsum(values) / len(values) for key, values in said.items()}
    if not told or not inputs:
        return ()
    columns = dict(zip(inputs, list(zip(*told, strict=True))[1:], strict=True))
    degrees = {name: _degrees(basis.rulebook.variables[name], column) for name, column in columns.items()}
    return rule_table(degrees, basis.parameter, np.array(list(told.values())))


def is_in_terms(rulebook: Rulebook, inputs: Iterable[str], row: ExampleRow) -> bool:
    """Whether each input is known and has a term; a person's own word may have none."""
    return all(
        (value := row.inputs.get(name)) is not None
        and (isinstance(variable := rulebook.variables[name], NumericVariable) or value in variable.terms)
        for name in inputs
    )


def prior_of(basis: ParameterRules, rows: Iterable[ExampleRow]) -> PooledPrior:
    """Pooled estimates for everybody, each culture and individuals, as offsets from the baseline."""
    parameter = basis.parameter
    answers = (StatedOffset(row.person, row.group, row.value - row.before) for row in rows)
    span = parameter.rules.high - parameter.rules.low
    return pooled(answers, declared_spread=parameter.spread, widest=span)


def with_cells(rulebook: Rulebook, name: str, cells: Iterable[Cell], source: Source) -> Rulebook:
    """The rulebook with rules from these cells instead of those that determined the parameter's value.

    Counter-evidence of an existing rule is kept when the same rule is learnt.
    """
    against = {str(rule): rule.counter_evidence for rule in rulebook.rules}
    rules = [
        _rule(
            cell.antecedent,
            Is(name, cell.conclusion),
            source,
            against=against,
            note=f"Support {cell.support:.1f} people; mean degree of their values in {cell.conclusion} "
            f"{cell.agreement:.2f}",
            weight=cell.weight,
        )
        for cell in cells
        if not cell.is_thin
    ]
    return with_value_rules(rulebook, name, rules, source.key)


def with_prior(rulebook: Rulebook, name: str, prior: PooledPrior, source: Source) -> Rulebook:
    """The rulebook with a rule for each culture with enough people; the overall mean is the neutral value.

    Rules that determined the parameter's value are disabled. A term is named after its value: `0.74 m`.
    """
    parameter = rulebook.parameters[name]
    assert isinstance(parameter, NumericParameter)
    terms: dict[str, Trapezoid] = {}
    rules: list[Rule] = []
    for group, found in prior.groups.items():
        if found.is_thin:
            continue
        value = _within(parameter, parameter.neutral + found.offset)
        term = _called(value, parameter)
        terms[term] = _around(value, parameter)
        mean = f"{parameter.neutral + found.mean:.3f} {parameter.unit}"
        note = f"{found.people} people, mean {mean}, drawn towards everybody's"
        if parameter.neutral + found.offset not in parameter.rules:
            note += f", and held to what rules can give, {parameter.rules} {parameter.unit}"
        rules.append(_rule(Is(GROUP, group), Is(name, term), source, note=note))
    why = f"Learnt from {source.key}, {prior.people} people"
    moved = _within(parameter, parameter.neutral + prior.everybody)
    learnt = replace(
        parameter,
        neutral=moved if abs(prior.everybody) >= equality_band(parameter) else parameter.neutral,
        spread=max(round(prior.between_people, 4), 1e-4),
        terms={**parameter.terms, **terms},
        reasons={
            **parameter.reasons,
            "terms": f"{parameter.reasons['terms']} Terms that are called by a number: {why}.",
            "neutral": f"{why}: what to expect of a person whose culture is not known.",
            "spread": f"{why}: between people of one culture.",
        },
    )
    variables = dict(rulebook.variables)
    if isinstance(culture := variables.get(GROUP), NominalVariable):
        variables[GROUP] = culture.naming(group for group, found in prior.groups.items() if not found.is_thin)
    with_terms = replace(rulebook, variables=variables, parameters={**rulebook.parameters, name: learnt})
    return with_value_rules(with_terms, name, rules, source.key)


def _rule(
    antecedent: Condition,
    concludes: Is,
    source: Source,
    *,
    note: str,
    weight: float = 1.0,
    against: Mapping[str, str] = MappingProxyType({}),
) -> Rule:
    rule = Rule(
        number=1,
        text="",
        antecedent=antecedent,
        consequents=(concludes,),
        sources=(source,),
        evidence="learnt",
        note=note,
        weight=weight,
    )
    return replace(rule, text=str(rule), counter_evidence=against.get(str(rule), ""))


def _degrees(variable: Variable, values: Sequence[object]) -> dict[str, Floats]:
    """By term, the membership degree of each value; for categories, stated ones only, not their groups."""
    column = read_columns({variable.name: variable}, {variable.name: values})[variable.name]
    terms = dict.fromkeys(column.words()) if isinstance(variable, NominalVariable) else variable.terms
    return {term: column.degrees(Literal(variable.name, term)) for term in sorted(map(str, terms))}


def _within(parameter: NumericParameter, value: float) -> float:
    """A value clipped to the output range and rounded to the smallest difference that counts."""
    band = equality_band(parameter)
    return round(parameter.rules.clamp(round(value / band) * band), 6)


def _called(value: float, parameter: NumericParameter) -> str:
    return f"{value:g}" if parameter.unit == "1" else f"{value:g} {parameter.unit}"


def _around(value: float, parameter: NumericParameter) -> Trapezoid:
    """A symmetric triangle inside the range, so that its centre of area is the value."""
    low, high = parameter.rules.ends
    span = high - low
    middle = min(max(value, low + NARROWEST * span), high - NARROWEST * span)
    half = min(HALF_WIDTH * span, middle - low, high - middle)
    return Trapezoid(round(middle - half, 6), round(middle, 6), round(middle, 6), round(middle + half, 6))
