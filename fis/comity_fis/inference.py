"""One person's parameters from one rulebook: the inference itself."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from operator import itemgetter
from typing import Any, NamedTuple

from comity_fis.antecedent import MIN_MAX, Modified
from comity_fis.block import Block, Firing, Program
from comity_fis.centroid import Cut
from comity_fis.composition import (
    Basis,
    asked_number,
    asked_word,
    inferred_number,
    inferred_word,
    neutral_number,
    neutral_word,
)
from comity_fis.curve import Curve
from comity_fis.engine import EXACT, Engine
from comity_fis.errors import InputError
from comity_fis.mamdani import AggregatedSet
from comity_fis.methods import Methods, united
from comity_fis.output_set import Concluded, OutputSet
from comity_fis.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.possibility import ROUGH, Known, Rough
from comity_fis.value import FiredRule, Origin, ParameterValue
from comity_fis.variable import Variable


@dataclass(slots=True)
class Person:
    """What is known of one person while their parameters are inferred one after the other."""

    program: Program
    variables: Mapping[str, Variable]
    inputs: Mapping[str, Known | None]
    engine: Engine
    degrees: list[float]
    """Of the program's literals, by number; of one about a parameter once that is decided."""
    values: dict[str, ParameterValue]
    """Grows in the order of evaluation."""

    def discloses(self, name: str) -> bool:
        """Whether a variable is known, or another parameter says more than its neutral value."""
        if name in self.values:
            return self.values[name].origin != "neutral"
        return self.inputs[name] is not None

    def tells_culture(self, name: str) -> bool:
        """Whether something disclosed tells who the person is."""
        if name in self.values:
            return self.values[name].origin == "culture"
        return self.variables[name].kind == "culture"


def meet(
    program: Program, variables: Mapping[str, Variable], inputs: Mapping[str, Known | None], engine: Engine
) -> Person:
    """A person of whom nothing is decided yet: the literals about variables have their degrees."""
    degrees = [1.0] * len(program.literals)
    for name, questions in program.questions.items():
        value = inputs.get(name)
        if value is None:
            continue
        if isinstance(value, ROUGH) or engine.degree is not None:
            _ask_one_by_one(program, variables[name], value, engine, degrees)
            continue
        for number, degree in questions:
            degrees[number] = degree(value)
    return Person(program, variables, inputs, engine, degrees, {})


def _ask_one_by_one(
    program: Program, variable: Variable, value: Known, engine: Engine, degrees: list[float]
) -> None:
    """The degrees of the literals about what is known only roughly, or by an engine's own memberships."""
    for number in program.about[variable.name]:
        _, term, exponent, negated = program.literals[number]
        membership: Any = variable.terms[term]  # over numbers or over words, as the value is
        if isinstance(value, Rough):
            degrees[number] = value.possibility(membership, exponent, negated)
        else:
            if engine.degree is not None and not isinstance(value, str):
                membership = partial(engine.degree, membership)
            degrees[number] = Modified(membership, exponent, negated)(value)


def settle(program: Program, person: Person, parameter: Parameter, value: ParameterValue) -> None:
    """Note a decided parameter; the literals about it have their degrees from now on."""
    name = parameter.name
    person.values[name] = value
    for number in program.about.get(name, ()):
        _, term, exponent, negated = program.literals[number]
        membership = partial(parameter.membership, term)
        person.degrees[number] = Modified(membership, exponent, negated)(value.value)


def decide(block: Block, person: Person, asked: float | str | None) -> ParameterValue:
    """One parameter of one person.

    Raises:
        InputError: if the person asked for a category whose requirement is not met.
    """
    if isinstance(block.parameter, NumericParameter):
        return _number(block, block.parameter, person, asked)
    return _word(block, block.parameter, person, asked)


def value_of(block: Block, person: Person) -> float | str:
    """What `decide` finds, without the records of why."""
    parameter = block.parameter
    if not isinstance(parameter, NumericParameter):
        return _word(block, parameter, person, None).word
    fired = _fire(block, person)
    centre = _centre(block, parameter, person, fired) if fired.origin != "neutral" else None
    return parameter.neutral if centre is None else centre


def _number(
    block: Block, parameter: NumericParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    if asked is not None:
        return asked_number(parameter, float(asked))
    fired = _fire(block, person)
    if fired.origin == "neutral":
        return neutral_number(parameter, _basis(block, fired))
    centre = _centre(block, parameter, person, fired)
    if centre is None:
        rules = _basis(block, fired).fired
        return neutral_number(parameter, Basis("neutral", rules, "the rules that fired leave no area"))
    program = person.program
    return ParameterValue.begun(
        lambda: inferred_number(parameter, _basis(block, fired), _curve(parameter, program, fired), centre),
        value=centre,
        origin=fired.origin,
    )


def _centre(block: Block, parameter: NumericParameter, person: Person, fired: Fired) -> float | None:
    """The one number that stands for what the rules give together; None where that has no area."""
    if not person.program.has_cuts:
        return person.engine.defuzzified(_output_set(parameter, person.program.methods, fired))
    if block.form is not None and person.engine is EXACT:
        return block.form.centre(fired.strengths)
    return person.engine.centre(_cuts(parameter, fired), *parameter.rules.ends)


def _curve(parameter: NumericParameter, program: Program, fired: Fired) -> Curve:
    if not program.has_cuts:
        return _output_set(parameter, program.methods, fired)
    return AggregatedSet(parameter.rules, _cuts(parameter, fired))


def _output_set(parameter: NumericParameter, methods: Methods, fired: Fired) -> OutputSet:
    concluded = [Concluded(parameter.terms[term], strength) for term, strength in _given(methods, fired)]
    return OutputSet(parameter.rules, tuple(concluded), methods)


def _given(methods: Methods, fired: Fired) -> Iterable[tuple[str, float]]:
    """Terms with their strengths: only the strongest of each where no other counts."""
    if methods.aggregation == "max":
        return fired.strengths.items()
    return ((clause.term, strength) for clause, strength in fired.clauses)


def _cuts(parameter: NumericParameter, fired: Fired) -> tuple[Cut, ...]:
    terms = parameter.terms
    return tuple([Cut(terms[term], strength) for term, strength in fired.strengths.items()])


def _word(
    block: Block, parameter: NominalParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    permitted = tuple(
        name
        for name in parameter.terms
        if name not in block.refusals or block.refusals[name].strength(person.degrees, MIN_MAX) <= 0
    )
    if asked is not None:
        if asked not in permitted:
            raise _requirement_error(parameter, str(asked))
        return asked_word(parameter, str(asked))
    fired = _fire(block, person)
    basis = _basis(block, fired)
    if basis.origin == "neutral":
        return neutral_word(parameter, basis, permitted)
    strengths = fired.strengths
    methods = person.program.methods
    if methods.aggregation != "max":
        strengths = united(_given(methods, fired), methods.aggregation)
    desirability = {category: strengths.get(category, 0.0) for category in permitted}
    refused = [category for category in strengths if category not in desirability]
    note = "; ".join(
        f"{category} is out, it requires {_requirement(parameter, category)}" for category in refused
    )
    if not any(desirability.values()):
        return neutral_word(parameter, Basis("neutral", (), note), permitted)
    return inferred_word(parameter, Basis(basis.origin, basis.fired, note), desirability)


class Fired(NamedTuple):
    """The rules of a block that hold for somebody."""

    clauses: Sequence[Firing]
    strengths: Mapping[str, float]
    """The largest of every concluded term, whatever the aggregation; terms in the order in which they first
    came."""
    origin: Origin
    """culture or situation; neutral where no rule holds or none that holds knows anything.

    Rules of whose inputs nothing at all was disclosed hold to degree 1, and would be a guess.
    """


def _fire(block: Block, person: Person) -> Fired:
    firings = block.firings(person.degrees, person.program.logic)
    strengths: dict[str, float] = {}
    for clause, strength in firings:
        term = clause.term
        if strength > strengths.get(term, 0.0):
            strengths[term] = strength
    return Fired(firings, strengths, _origin(firings, person))


def _basis(block: Block, fired: Fired) -> Basis:
    if not fired.clauses:
        return Basis("neutral", (), "no rule fires" if block.clauses else "the rulebook has no rule for it")
    if fired.origin == "neutral":
        reads = dict.fromkeys(name for clause, _ in fired.clauses for name in clause.reads)
        return Basis("neutral", (), f"nothing is known of {', '.join(reads)}")
    strongest_first = sorted(fired.clauses, key=itemgetter(1), reverse=True)
    rules = [FiredRule(clause.rule, strength) for clause, strength in strongest_first]
    if block.repeats:
        rules = list({rule.rule.number: rule for rule in rules}.values())
    return Basis(fired.origin, tuple(rules))


def _origin(holding: Sequence[Firing], person: Person) -> Origin:
    """What those rules know: who the person is, else how things stand, else nothing."""
    origin: Origin = "neutral"
    for clause, _ in holding:
        for name in clause.reads:
            if person.discloses(name):
                if person.tells_culture(name):
                    return "culture"
                origin = "situation"
    return origin


def _requirement(parameter: NominalParameter, category: str) -> str:
    return next(f"`{c.requires}`" for c in parameter.categories if c.name == category)


def _requirement_error(parameter: NominalParameter, category: str) -> InputError:
    requirement = _requirement(parameter, category)
    return InputError(
        expected=f"{requirement} before {parameter.name} can be {category}",
        got="a person of whom that is not known or not so",
        remedy="State it if the person said so; what is not disclosed, above all consent, is never presumed.",
    )
