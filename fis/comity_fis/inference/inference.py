"""One person's parameters from one rulebook: the inference itself."""

from __future__ import annotations

from dataclasses import replace

from comity_fis.defuzzification.engine import EXACT
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.errors import InputError
from comity_fis.inference.block import Block
from comity_fis.inference.composition import (
    Basis,
    asked_number,
    asked_word,
    inferred_number,
    inferred_word,
    neutral_number,
    neutral_word,
)
from comity_fis.inference.firing import Fired, basis_of, fire
from comity_fis.inference.person import DisclosedPerson
from comity_fis.inference.value import ParameterValue
from comity_fis.rules.antecedent import MIN_MAX, strength
from comity_fis.variables.parameter import NominalParameter, NumericParameter


def decide(block: Block, person: DisclosedPerson, asked: float | str | None = None) -> ParameterValue:
    """One parameter of one person.

    Args:
        block: The parameter and its rules.
        person: Of whom everything is decided that the rules read.
        asked: What the person asked for; None for nothing.

    Raises:
        InputError: if the person asked for a category whose requirement is not met.
    """
    if isinstance(block.parameter, NumericParameter):
        if asked is not None:
            return asked_number(block.parameter, float(asked))
        return _number(block, block.parameter, person)
    permitted = _permitted(block, person)
    if asked is not None:
        if asked not in permitted:
            raise _requirement_error(block, str(asked))
        return asked_word(block.parameter, str(asked))
    return _word(block, block.parameter, person, permitted)


def _number(block: Block, parameter: NumericParameter, person: DisclosedPerson) -> ParameterValue:
    fired = fire(block, person)
    basis = basis_of(block, fired)
    if basis.origin == "neutral":
        return neutral_number(parameter, basis)
    methods = person.program.methods
    curve = OutputSet(
        parameter.rules,
        tuple(Layer(parameter.terms[term], degree) for term, degree in fired.given(methods)),
        methods,
        tuple(parameter.terms.values()),
    )
    if block.form is not None and person.engine is EXACT:
        centre = block.form.centre(fired.strengths(methods))
    else:
        centre = person.engine.value(curve)
    if centre is None:
        return neutral_number(parameter, Basis("neutral", basis.fired, "the rules that fired leave no area"))
    return inferred_number(parameter, basis, curve, centre)


def _word(
    block: Block, parameter: NominalParameter, person: DisclosedPerson, permitted: tuple[str, ...]
) -> ParameterValue:
    fired = fire(block, person)
    basis, strengths = basis_of(block, fired), fired.strengths(person.program.methods)
    desirability = {category: min(1.0, strengths.get(category, 0.0)) for category in permitted}
    if basis.origin == "neutral":
        return neutral_word(parameter, basis, permitted)
    basis = replace(basis, note=_excluded(block, fired, permitted))
    if any(desirability.values()):
        return inferred_word(parameter, basis, desirability)
    return neutral_word(parameter, Basis("neutral", (), basis.note), permitted)


def _permitted(block: Block, person: DisclosedPerson) -> tuple[str, ...]:
    """The categories whose requirement is met fully.

    What an undisclosed value might be, it might also not be: the opposite of a requirement then holds to
    degree 1, and the category is excluded.
    """
    return tuple(
        name
        for name in block.parameter.terms
        if name not in block.requirements
        or strength(block.requirements[name], person.degree, MIN_MAX, negated=True) <= 0.0
    )


def _excluded(block: Block, fired: Fired, permitted: tuple[str, ...]) -> str:
    """Which categories rules speak for, and are not permitted."""
    concluded = dict.fromkeys(firing.term for firing in fired.firings)
    return "; ".join(
        f"{category} is out, it requires `{block.requirements[category]}`"
        for category in concluded
        if category not in permitted
    )


def _requirement_error(block: Block, category: str) -> InputError:
    return InputError(
        expected=f"`{block.requirements[category]}` before {block.parameter.name} can be {category}",
        got="a person of whom that is not known or not so",
        remedy="State it if the person said so; what is not disclosed, above all consent, is never presumed.",
    )
