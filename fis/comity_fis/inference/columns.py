"""Inference for many people at once: the rules for one person, evaluated on columns.

Columns are processed in chunks, so that memory does not grow with the number of people.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial, reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.exact import EXACT
from comity_fis.defuzzification.ground import ground_of
from comity_fis.defuzzification.panels import panels_of
from comity_fis.defuzzification.sets import Sets
from comity_fis.inference.block import Block, Program
from comity_fis.inference.column import Bools, Columns, Floats, VariableColumn, read_columns
from comity_fis.inference.composition import TIE
from comity_fis.membership.arrays import degrees as degrees_of_numbers
from comity_fis.rules.antecedent import Literal, Logic, Operator, hedged, logic_of, strength
from comity_fis.rules.methods import MAMDANI, probor
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter

CHUNK = 8192
"""Number of people per chunk: a column of them takes 64 kB."""


OPERATORS: Mapping[str, Operator[Any]] = {
    "min": partial(reduce, np.minimum),
    "max": partial(reduce, np.maximum),
    "prod": partial(reduce, np.multiply),
    "probor": partial(reduce, probor),
    "sum": partial(reduce, np.add),
}
"""For columns; at least one degree each."""

MIN_MAX = logic_of(MAMDANI, OPERATORS)
"""Logic for the requirements of categories, independent of the methods."""

Layer = tuple[str, Any]
"""A term with its strengths: a column, or one value for all."""


class Answers(dict[str, NDArray[Any]]):
    """Values for each person, by parameter: a dictionary that pandas can convert to a table."""

    neutral: Mapping[str, Bools]
    """By parameter, the people for whom no rule applies, so that the neutral value is used."""
    notes: tuple[str, ...]
    """Ignored columns, and cultures from which nothing follows."""


def infer_columns(
    program: Program, parameters: Sequence[str], columns: Columns, notes: tuple[str, ...]
) -> Answers:
    """Infer the values for many people; see `Rulebook.infer_many`.

    Args:
        program: Compiled rules of the rulebook.
        parameters: Parameter names in declared order.
        columns: Input columns by variable.
        notes: Notes on what was ignored in the table.
    """
    read = read_columns(program.variables, columns)
    count = len(next(iter(read.values())).values) if read else 0
    answers = Answers((name, np.empty(count, dtype=_dtype(program.blocks[name]))) for name in parameters)
    answers.neutral = {name: np.zeros(count, dtype=np.bool_) for name in parameters}
    answers.notes = notes
    for start in range(0, count, CHUNK):
        rows = slice(start, min(start + CHUNK, count))
        chunk = {name: column.part(rows) for name, column in read.items()}
        people = People(program, chunk, rows.stop - rows.start)
        for name, block in program.blocks.items():
            decided = people.decide(block)
            answers[name][rows] = decided.as_said(block.parameter)
            answers.neutral[name][rows] = np.logical_not(decided.grounded)
    return answers


def _dtype(block: Block) -> type:
    return float if isinstance(block.parameter, NumericParameter) else object


@dataclass(frozen=True, slots=True)
class Decided:
    """One inferred parameter for many people."""

    values: NDArray[Any]
    """Numbers, or the numbers of categories in declared order."""
    grounded: Bools | bool
    """Whether rules with a known input determined it, and not the neutral value."""

    def as_said(self, parameter: Parameter) -> NDArray[Any]:
        """The values: numbers as they are, categories by name."""
        if isinstance(parameter, NumericParameter):
            return self.values
        categories: NDArray[Any] = np.array(parameter.terms, dtype=object)
        words: NDArray[Any] = categories[self.values]
        return words

    def degrees(self, parameter: Parameter, literal: Literal) -> Floats:
        """Degrees of a literal on this parameter."""
        if isinstance(parameter, NumericParameter):
            within = np.clip(self.values, *parameter.rules.ends)
            degrees: Floats = degrees_of_numbers(parameter.terms[literal.term], within)
        else:
            degrees = (self.values == parameter.terms.index(literal.term)).astype(np.float64)
        return hedged(degrees, literal)


@dataclass(slots=True)
class People:
    """Known facts of some people while their parameters are inferred one after the other."""

    program: Program
    columns: Mapping[str, VariableColumn]
    count: int
    logic: Logic[Any] = field(init=False)
    """Meaning of `and` and `or`."""
    known: dict[str, Bools | bool] = field(init=False)
    """For whom a variable is known, or a parameter has more than its neutral value."""
    decided: dict[str, Decided] = field(default_factory=dict)
    """Parameters inferred so far."""
    degrees: dict[Literal, Floats | float] = field(default_factory=dict)
    """Cached degrees of literals, which several rules share."""

    def __post_init__(self) -> None:
        self.logic = logic_of(self.program.methods, OPERATORS)
        self.known = {name: column.known for name, column in self.columns.items()}

    def degree(self, literal: Literal) -> Floats | float:
        """Degrees of a literal; 1 if undisclosed."""
        if literal not in self.degrees:
            self.degrees[literal] = self._degree(literal)
        return self.degrees[literal]

    def _degree(self, literal: Literal) -> Floats | float:
        if literal.name in self.decided:
            parameter = self.program.blocks[literal.name].parameter
            return self.decided[literal.name].degrees(parameter, literal)
        return self.columns[literal.name].degrees(literal) if literal.name in self.columns else 1.0

    def decide(self, block: Block) -> Decided:
        """Infer one parameter for everyone; later rules can read it."""
        parameter = block.parameter
        if isinstance(parameter, NumericParameter):
            decided = self._numbers(block, parameter)
            if parameter.name in self.program.shifts:
                decided = self._moved(decided, parameter, self.program.shifts[parameter.name])
        else:
            decided = self._words(block, parameter)
        self.known[parameter.name] = decided.grounded
        self.decided[parameter.name] = decided
        return decided

    def _fire(self, block: Block, *, only_told: bool = False) -> tuple[list[Layer], Bools | bool]:
        """What each rule concludes and how strongly, and for whom a rule holds that knows anything of them.

        The second may be True for a person of whom no rule holds at all: then every strength is 0.

        Args:
            block: The rules.
            only_told: Whether a rule that knows nothing of a person does not count for them.
        """
        layers: list[Layer] = []
        informed: Bools | bool = all(self._knows(rule.reads) is True for rule, _ in block.clauses)
        for rule, term in block.clauses:
            degrees = rule.weight * strength(rule.antecedent, self.degree, self.logic)
            if only_told:
                degrees = np.where(self._knows(rule.reads), degrees, 0.0)
            layers.append((term, degrees))
            if informed is not True:
                informed = informed | ((degrees > 0) & self._knows(rule.reads))
        return layers, informed

    def _knows(self, reads: tuple[str, ...]) -> Bools | bool:
        known: Bools | bool = False
        for name in reads:
            if (one := self.known.get(name, False)) is True:
                return True
            known = known | one
        return known

    def _moved(self, decided: Decided, parameter: NumericParameter, block: Block) -> Decided:
        """The result of the rules, shifted by the situation."""
        difference = block.parameter
        assert isinstance(difference, NumericParameter)
        by = self._numbers(block, difference, only_told=True).values
        values = np.clip(np.clip(decided.values + by, *parameter.ask.ends), *parameter.safe.ends)
        return Decided(np.where(by != 0.0, values, decided.values), decided.grounded | (by != 0.0))

    def _numbers(self, block: Block, parameter: NumericParameter, *, only_told: bool = False) -> Decided:
        layers, informed = self._fire(block, only_told=only_told)
        aggregation = self.program.methods.aggregation
        if aggregation == "max" or block.form is not None:
            layers = list(_united(layers, aggregation).items())
        if block.form is None:
            values = self._by_panels(parameter, layers)
            grounded = ~np.isnan(values) & informed
        else:
            heights: dict[str, Any] = dict(layers)
            area, moment = block.form.area_and_moment(heights, OPERATORS["min"])
            grounded = np.broadcast_to((np.asarray(area) > 0) & informed, (self.count,))
            values = np.full(self.count, parameter.neutral)
            np.divide(moment, area, out=values, where=grounded)
            np.add(values, block.form.low, out=values, where=grounded)
            np.clip(values, block.form.low, block.form.high, out=values)
        if grounded.all():
            return Decided(values, True)
        return Decided(np.where(grounded, values, parameter.neutral), grounded)

    def _by_panels(self, parameter: NumericParameter, layers: Sequence[Layer]) -> Floats:
        """The values of sets that have no closed form; NaN where there is no area."""
        if not layers:
            return np.full(self.count, np.nan)
        methods, numbers = self.program.methods, list(parameter.terms)
        ground = ground_of(tuple(parameter.terms.values()), *parameter.rules.ends, methods)
        strengths = np.stack([np.broadcast_to(strength, (self.count,)) for _, strength in layers])
        sets = Sets(ground, methods, [numbers.index(term) for term, _ in layers], strengths)
        return EXACT[methods.defuzzification](panels_of(sets))

    def _words(self, block: Block, parameter: NominalParameter) -> Decided:
        layers, informed = self._fire(block)
        strengths = _united(layers, self.program.methods.aggregation)
        desirability = np.zeros((len(parameter.terms), self.count))
        for i, category in enumerate(parameter.terms):
            desirability[i] = np.minimum(strengths.get(category, 0.0), 1.0)
            if category in block.requirements:
                opposite = strength(block.requirements[category], self.degree, MIN_MAX, negated=True)
                desirability[i] = np.where(opposite > 0, 0.0, desirability[i])
        best = desirability.max(axis=0)
        neutral = parameter.terms.index(parameter.neutral)
        tied = (best - desirability < TIE).sum(axis=0) > 1
        grounded = np.broadcast_to((best > 0) & informed, (self.count,))
        values = np.where(grounded & ~tied, desirability.argmax(axis=0), neutral)
        return Decided(values, True if grounded.all() else grounded)


def _united(layers: Sequence[Layer], aggregation: str) -> dict[str, Any]:
    """The strengths of each term as one."""
    by_term: dict[str, list[Any]] = {}
    for term, degrees in layers:
        by_term.setdefault(term, []).append(degrees)
    return {term: OPERATORS[aggregation](strengths) for term, strengths in by_term.items()}
