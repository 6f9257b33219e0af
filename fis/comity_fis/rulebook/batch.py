"""Inference for many people at once: the program that serves one person, with columns in place of numbers.

Columns are worked through in chunks that stay in the processor's cache, which matters as much as the
arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial, reduce
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.exact import EXACT
from comity_fis.defuzzification.ground import ground_of
from comity_fis.defuzzification.panels import panels_of
from comity_fis.defuzzification.sets import Sets
from comity_fis.inference.block import Block, Program
from comity_fis.inference.column import Bools, Column, Columns, Floats, hedged, read_columns
from comity_fis.inference.composition import TIE
from comity_fis.membership.arrays import degrees as degrees_of_numbers
from comity_fis.rulebook.table import told_columns
from comity_fis.rules.antecedent import Literal, Logic
from comity_fis.rules.methods import DUAL, Methods
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook

CHUNK = 8192
"""People at a time: a column of them is 64 kB."""


def _probor(one: Any, other: Any) -> Any:
    return one + other - one * other


Operator = Callable[[Sequence[Any]], Any]
"""What makes one column of several."""

OPERATORS: Mapping[str, Operator] = {
    "min": partial(reduce, np.minimum),
    "max": partial(reduce, np.maximum),
    "prod": partial(reduce, np.multiply),
    "probor": partial(reduce, _probor),
    "sum": partial(reduce, np.add),
}


MIN_MAX: Logic[Any] = Logic(
    OPERATORS["min"], OPERATORS["max"], not_all_of=OPERATORS["max"], not_any_of=OPERATORS["min"]
)
"""For the requirements of categories, whatever the methods are."""

Layer = tuple[str, Any]
"""A term, and a column of strengths or one for all."""


def logic_of_columns(methods: Methods) -> Logic[Any]:
    """What a rulebook's methods make of `and` and `or`, for columns."""
    return Logic(
        OPERATORS[methods.conjunction],
        OPERATORS[methods.disjunction],
        not_all_of=OPERATORS[DUAL[methods.conjunction]],
        not_any_of=OPERATORS[DUAL[methods.disjunction]],
    )


class Answers(dict[str, NDArray[Any]]):
    """By parameter, the value for each person: a dictionary, of which pandas makes a table."""

    neutral: Mapping[str, Bools]
    """By parameter, where the rules have nothing to go on, so that its neutral value stands."""
    notes: tuple[str, ...]
    """What was ignored, and cultures from which nothing follows."""


def infer_many(rulebook: Rulebook, columns: Columns) -> Answers:
    """See `Rulebook.infer_many`."""
    told, notes = told_columns(rulebook, columns)
    read = read_columns(rulebook.variables, told)
    count = len(next(iter(read.values())).values) if read else 0
    results = Answers(
        {
            name: np.empty(count, dtype=np.float64 if isinstance(parameter, NumericParameter) else object)
            for name, parameter in rulebook.parameters.items()
        }
    )
    neutral = {name: np.zeros(count, dtype=np.bool_) for name in rulebook.parameters}
    results.neutral, results.notes = neutral, notes
    for start in range(0, count, CHUNK):
        rows = slice(start, min(start + CHUNK, count))
        people = People(
            program=rulebook.program,
            columns={name: column.part(rows) for name, column in read.items()},
            count=rows.stop - rows.start,
        )
        for block in rulebook.program.blocks:
            decided, name = people.decide(block), block.parameter.name
            results[name][rows] = decided.as_said(block.parameter)
            neutral[name][rows] = np.logical_not(decided.grounded)
    return results


@dataclass(frozen=True, slots=True)
class Decided:
    """One parameter of many people."""

    values: NDArray[Any]
    """Numbers, or the numbers of categories in declared order."""
    grounded: Bools | bool
    """Where rules that know something decided it, and not the neutral value stands."""

    def as_said(self, parameter: Parameter) -> NDArray[Any]:
        """Numbers as they are, categories by name."""
        if isinstance(parameter, NumericParameter):
            return self.values
        categories: NDArray[Any] = np.array(parameter.terms, dtype=object)
        words: NDArray[Any] = categories[self.values]
        return words

    def degrees(self, parameter: Parameter, literal: Literal) -> Floats:
        """The degrees of a literal about the parameter."""
        if isinstance(parameter, NumericParameter):
            within = np.clip(self.values, *parameter.rules.ends)
            degrees = degrees_of_numbers(parameter.terms[literal.term], within)
        else:
            degrees = (self.values == parameter.terms.index(literal.term)).astype(np.float64)
        return hedged(degrees, literal)


@dataclass(slots=True, kw_only=True)
class People:
    """What is known of some people while their parameters are inferred one after the other."""

    program: Program
    columns: dict[str, Column]
    count: int
    degrees: list[Floats | float] = field(init=False)
    """Of the program's literals, by number; 1 for what nobody disclosed."""
    logic: Logic[Any] = field(init=False)
    """What `and` and `or` mean."""
    known: dict[str, Bools | bool] = field(init=False)
    """Of whom a variable is known, or another parameter says more than its neutral value."""

    def __post_init__(self) -> None:
        self.degrees = [
            self.columns[literal.name].degrees(literal) if literal.name in self.columns else 1.0
            for literal in self.program.literals
        ]
        self.logic = logic_of_columns(self.program.methods)
        self.known = {name: column.known for name, column in self.columns.items()}

    def decide(self, block: Block) -> Decided:
        """One parameter of everybody; whatever reads it knows it from then on."""
        parameter = block.parameter
        if isinstance(parameter, NumericParameter):
            decided = self._numbers(block, parameter)
            if parameter.name in self.program.shifts:
                decided = self._moved(decided, parameter, self.program.shifts[parameter.name])
        else:
            decided = self._words(block, parameter)
        self.known[parameter.name] = decided.grounded
        for number in self.program.about.get(parameter.name, ()):
            self.degrees[number] = decided.degrees(parameter, self.program.literals[number])
        return decided

    def _fire(self, block: Block, *, only_told: bool = False) -> tuple[list[Layer], Bools | bool]:
        """What each rule concludes and how strongly, and for whom a rule holds that knows anything of them.

        The second may be True for somebody of whom no rule holds at all: then every strength is 0.

        Args:
            block: The rules.
            only_told: Whether a rule that knows nothing of somebody does not count for them.
        """
        layers: list[Layer] = []
        informed: Bools | bool = all(self._knows(clause.reads) is True for clause in block.clauses)
        for clause in block.clauses:
            strength = clause.antecedent.strength(self.degrees, self.logic)
            if clause.weight != 1.0:
                strength = clause.weight * strength
            if only_told:
                strength = np.where(self._knows(clause.reads), strength, 0.0)
            layers.append((clause.term, strength))
            if informed is not True:
                informed = informed | ((strength > 0) & self._knows(clause.reads))
        return layers, informed

    def _knows(self, reads: tuple[str, ...]) -> Bools | bool:
        known: Bools | bool = False
        for name in reads:
            if (one := self.known.get(name, False)) is True:
                return True
            known = known | one
        return known

    def _moved(self, decided: Decided, parameter: NumericParameter, block: Block) -> Decided:
        """What the rules gave, moved by the situation."""
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
            if category in block.refusals:
                refused = block.refusals[category].strength(self.degrees, MIN_MAX) > 0
                desirability[i] = np.where(refused, 0.0, desirability[i])
        best = desirability.max(axis=0)
        neutral = parameter.terms.index(parameter.neutral)
        tied = (best - desirability < TIE).sum(axis=0) > 1
        grounded = np.broadcast_to((best > 0) & informed, (self.count,))
        values = np.where(grounded & ~tied, desirability.argmax(axis=0), neutral)
        return Decided(values, True if grounded.all() else grounded)


def _united(layers: Sequence[Layer], aggregation: str) -> dict[str, Any]:
    """The strengths of each term as one."""
    by_term: dict[str, list[Any]] = {}
    for term, strength in layers:
        by_term.setdefault(term, []).append(strength)
    return {term: OPERATORS[aggregation](strengths) for term, strengths in by_term.items()}
