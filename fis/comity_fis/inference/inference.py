"""One person's parameters from one rulebook: the inference itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from comity_fis.defuzzification.engine import Engine
from comity_fis.errors import InputError
from comity_fis.inference.block import Block, Program
from comity_fis.inference.composition import (
    Basis,
    asked_number,
    asked_word,
    chosen,
    inferred_number,
    inferred_word,
    neutral_number,
    neutral_word,
)
from comity_fis.inference.conclusion import centre_of, set_of
from comity_fis.inference.firing import Fired, basis_of, fire
from comity_fis.inference.possibility import ROUGH, Known, Rough, Stated
from comity_fis.inference.value import ParameterValue
from comity_fis.rules.antecedent import MIN_MAX, Modified
from comity_fis.rules.methods import united
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.variables.variable import Variable


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
            value = self.values[name]
            if value.origin in ("culture", "neutral", "setting"):
                return value.origin == "culture"
            return value.start.origin == "culture"  # whatever moved it, it set out from there
        return self.variables[name].kind == "culture"


def meet(
    program: Program, variables: Mapping[str, Variable], inputs: Mapping[str, Stated | None], engine: Engine
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
    centre = _centre(block, parameter, person, fire(block, person))
    return parameter.neutral if centre is None else centre


def _number(
    block: Block, parameter: NumericParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    if asked is not None:
        return asked_number(parameter, float(asked))
    fired, program = fire(block, person), person.program
    centre = _centre(block, parameter, person, fired)
    return ParameterValue.begun(
        lambda: _number_record(block, parameter, program, fired, centre),
        value=parameter.neutral if centre is None else centre,
        origin="neutral" if centre is None else fired.origin,
    )


def _centre(block: Block, parameter: NumericParameter, person: Person, fired: Fired) -> float | None:
    """None where the rules have nothing to go on, or leave no area."""
    if fired.origin == "neutral":
        return None
    return centre_of(block, parameter, person.program, fired, person.engine)


def _number_record(
    block: Block, parameter: NumericParameter, program: Program, fired: Fired, centre: float | None
) -> ParameterValue:
    basis = basis_of(block, fired)
    if centre is not None:
        return inferred_number(parameter, basis, set_of(parameter, program, fired), centre)
    if basis.origin != "neutral":
        basis = Basis("neutral", basis.fired, "the rules that fired leave no area")
    return neutral_number(parameter, basis)


def _word(
    block: Block, parameter: NominalParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    permitted = tuple(
        [
            name
            for name in parameter.terms
            if name not in block.refusals or block.refusals[name].strength(person.degrees, MIN_MAX) <= 0
        ]
    )
    if asked is not None:
        if asked not in permitted:
            raise _requirement_error(parameter, str(asked))
        return asked_word(parameter, str(asked))
    fired, methods = fire(block, person), person.program.methods
    strengths = fired.strengths
    if methods.aggregation != "max":
        strengths = united(fired.given(methods), methods.aggregation)
    desirability = {category: min(1.0, strengths.get(category, 0.0)) for category in permitted}
    rules_speak = fired.origin != "neutral" and any(desirability.values())
    return ParameterValue.begun(
        lambda: _word_record(block, parameter, fired, desirability, rules_speak),
        value=chosen(parameter, desirability)[0] if rules_speak else parameter.neutral,
        origin=fired.origin if rules_speak else "neutral",
    )


def _word_record(
    block: Block,
    parameter: NominalParameter,
    fired: Fired,
    desirability: Mapping[str, float],
    rules_speak: bool,
) -> ParameterValue:
    basis = basis_of(block, fired)
    if basis.origin != "neutral":
        refused = [category for category in fired.strengths if category not in desirability]
        note = "; ".join(
            f"{category} is out, it requires {_requirement(parameter, category)}" for category in refused
        )
        basis = Basis(basis.origin, basis.fired, note) if rules_speak else Basis("neutral", (), note)
    if rules_speak:
        return inferred_word(parameter, basis, desirability)
    return neutral_word(parameter, basis, tuple(desirability))


def _requirement(parameter: NominalParameter, category: str) -> str:
    return next(f"`{c.requires}`" for c in parameter.categories if c.name == category)


def _requirement_error(parameter: NominalParameter, category: str) -> InputError:
    requirement = _requirement(parameter, category)
    return InputError(
        expected=f"{requirement} before {parameter.name} can be {category}",
        got="a person of whom that is not known or not so",
        remedy="State it if the person said so; what is not disclosed, above all consent, is never presumed.",
    )
