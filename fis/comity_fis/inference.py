"""One person's parameters from one rulebook: the inference itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

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
from comity_fis.engine import Engine
from comity_fis.errors import InputError
from comity_fis.mamdani import AggregatedSet, holds, strength, united
from comity_fis.methods import MAMDANI, Methods
from comity_fis.output_set import Concluded, OutputSet, needs_output_set
from comity_fis.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.rule import Rule
from comity_fis.value import FiredRule, Origin, ParameterValue
from comity_fis.variable import NominalVariable, Variable

Strengths = tuple[tuple[str, float], ...]
"""Every term that a rule concludes, with that rule's strength in (0, 1], in the rules' order."""


@dataclass(frozen=True, slots=True)
class Block:
    """The rules that decide one parameter."""

    parameter: Parameter
    rules: tuple[tuple[Rule, str], ...]
    """Each with the term that it gives."""
    reads: tuple[str, ...]
    """The variables and other parameters in the rules' antecedents."""


@dataclass(frozen=True, slots=True)
class Person:
    """What is known of one person while their parameters are inferred one after the other."""

    variables: Mapping[str, Variable]
    parameters: Mapping[str, Parameter]
    inputs: Mapping[str, float | str | None]
    engine: Engine
    methods: Methods = MAMDANI
    values: dict[str, ParameterValue] = field(default_factory=dict)
    """Grows in the order of evaluation."""
    degrees: dict[tuple[str, str], float | None] = field(default_factory=dict)
    """Computed once, however many rules ask."""

    def degree(self, name: str, term: str) -> float | None:
        """The degree of `name is term`; None where the value was not disclosed."""
        if (name, term) not in self.degrees:
            self.degrees[name, term] = self._degree(name, term)
        return self.degrees[name, term]

    def _degree(self, name: str, term: str) -> float | None:
        if name in self.values:
            return self.parameters[name].membership(term, self.values[name].value)
        value = self.inputs[name]
        if value is None:
            return None
        variable = self.variables[name]
        if isinstance(variable, NominalVariable):
            return variable.terms[term](str(value))
        return self.engine.degree(variable.terms[term], float(value))

    def discloses(self, name: str) -> bool:
        """Whether a variable is known, or another parameter says more than its neutral value."""
        if name in self.values:
            return self.values[name].origin != "neutral"
        return self.inputs[name] is not None

    def discloses_culture(self, name: str) -> bool:
        """Whether what a rule reads tells who the person is, as far as they disclosed it."""
        if name in self.values:
            return self.values[name].origin == "culture"
        return self.inputs[name] is not None and self.variables[name].kind == "culture"


def decide(block: Block, person: Person, asked: float | str | None) -> ParameterValue:
    """One parameter of one person.

    Raises:
        InputError: if the person asked for a category whose requirement is not met.
    """
    if isinstance(block.parameter, NumericParameter):
        return _number(block, block.parameter, person, asked)
    return _word(block, block.parameter, person, asked)


def _number(
    block: Block, parameter: NumericParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    if asked is not None:
        return asked_number(parameter, float(asked))
    basis, strengths = _fire(block, person)
    if basis.origin == "neutral":
        return neutral_number(parameter, basis)
    curve, centre = _defuzzified(parameter, person, strengths)
    if centre is None:
        return neutral_number(parameter, Basis("neutral", basis.fired, "the rules that fired leave no area"))
    return inferred_number(parameter, basis, curve, centre)


def _defuzzified(
    parameter: NumericParameter, person: Person, strengths: Strengths
) -> tuple[Curve, float | None]:
    """What the rules give together, and its one number; None where it has no area."""
    if person.methods.aggregation == "max":
        strengths = tuple(united(strengths).items())
    if needs_output_set(person.methods):
        concluded = tuple(Concluded(parameter.terms[term], degree) for term, degree in strengths)
        curve = OutputSet(parameter.rules, concluded, person.methods)
        return curve, person.engine.defuzzified(curve)
    cuts = tuple(Cut(parameter.terms[term], degree) for term, degree in strengths)
    return AggregatedSet(parameter.rules, cuts), person.engine.centre(cuts, *parameter.rules.ends)


def _word(
    block: Block, parameter: NominalParameter, person: Person, asked: float | str | None
) -> ParameterValue:
    permitted = tuple(
        c.name for c in parameter.categories if c.requires is None or holds(c.requires, person.degree)
    )
    if asked is not None:
        if asked not in permitted:
            raise _requirement_error(parameter, str(asked))
        return asked_word(parameter, str(asked))
    basis, strengths = _fire(block, person)
    if basis.origin == "neutral":
        return neutral_word(parameter, basis, permitted)
    degrees = united(strengths, person.methods.aggregation)
    desirability = {category: degrees.get(category, 0.0) for category in permitted}
    refused = [category for category in degrees if category not in desirability]
    note = "; ".join(
        f"{category} is out, it requires {_requirement(parameter, category)}" for category in refused
    )
    if not any(desirability.values()):
        return neutral_word(parameter, Basis("neutral", (), note), permitted)
    return inferred_word(parameter, Basis(basis.origin, basis.fired, note), desirability)


def _fire(block: Block, person: Person) -> tuple[Basis, Strengths]:
    """The rules that hold to some degree, and what each concludes.

    Rules of whose inputs nothing at all was disclosed hold to degree 1, and would be a guess: the neutral
    value stands where there are no others.
    """
    holding = [
        (rule, term, degree)
        for rule, term in block.rules
        if (degree := rule.weight * strength(rule.antecedent, person.degree, methods=person.methods)) > 0
    ]
    if not holding:
        return Basis("neutral", (), "no rule fires" if block.rules else "the rulebook has no rule for it"), ()
    reads = dict.fromkeys(name for rule, _, _ in holding for name in rule.reads)
    if not any(person.discloses(name) for name in reads):
        return Basis("neutral", (), f"nothing is known of {', '.join(reads)}"), ()
    once = {rule.number: FiredRule(rule, degree) for rule, _, degree in holding}
    fired = sorted(once.values(), key=lambda firing: (-firing.strength, firing.rule.number))
    origin: Origin = "culture" if any(person.discloses_culture(name) for name in reads) else "situation"
    return Basis(origin, tuple(fired)), tuple((term, degree) for _, term, degree in holding)


def _requirement(parameter: NominalParameter, category: str) -> str:
    return next(f"`{c.requires}`" for c in parameter.categories if c.name == category)


def _requirement_error(parameter: NominalParameter, category: str) -> InputError:
    requirement = _requirement(parameter, category)
    return InputError(
        expected=f"{requirement} before {parameter.name} can be {category}",
        got="a person of whom that is not known or not so",
        remedy="State it if the person said so; what is not disclosed, above all consent, is never presumed.",
    )
