"""The situation's own rules: by how much they move one parameter of one person.

A rule counts here only where something that it reads is known. In the rules that give a value, what was not
disclosed holds as possible, so that the answer lies between what either statement would get; a shift has a
neutral answer, and what nobody said moves nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_fis.errors import InputError
from comity_fis.inference.block import Block, block_of
from comity_fis.inference.inference import decide
from comity_fis.inference.person import DisclosedPerson
from comity_fis.inference.value import ParameterValue
from comity_fis.membership.interval import Interval
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import Condition, Is, Rule, literals
from comity_fis.variables.parameter import NumericParameter, Parameter
from comity_fis.variables.shift import NEUTRAL
from comity_fis.variables.variable import Variable

EVERYTHING = Interval(float("-inf"), float("inf"))


def shift_blocks(
    parameters: Mapping[str, Parameter], rules: Sequence[Rule], methods: Methods
) -> dict[str, Block]:
    """The rules of every parameter that the situation may move, where any of them are on."""
    blocks = {
        name: block_of(_as_parameter(parameter), rules, methods)
        for name, parameter in parameters.items()
        if isinstance(parameter, NumericParameter) and parameter.shift is not None
    }
    return {name: block for name, block in blocks.items() if block.clauses}


def shift_of(block: Block | None, person: DisclosedPerson) -> ParameterValue | None:
    """By how much the situation moves a parameter, in its unit; None where no rule knows anything."""
    if block is None:
        return None
    told = [clause for clause in block.clauses if any(map(person.discloses, clause.rule.reads))]
    value = decide(replace(block, clauses=tuple(told)), person)
    return None if value.origin == "neutral" else value


def refuse_person_in_shift(
    antecedent: Condition,
    consequents: Sequence[Is],
    variables: Mapping[str, Variable],
    parameters: Mapping[str, Parameter],
) -> None:
    """Refuse a rule that moves a parameter and reads who a person is: that is for the other rules.

    Raises:
        InputError: with the first name that is no variable of the situation.
    """
    moves = [is_ for is_ in consequents if is_.term not in parameters[is_.name].terms]
    for read in literals(antecedent) if moves else ():
        if read.name not in variables or variables[read.name].kind != "situation":
            own = ", ".join(parameters[moves[0].name].terms)
            raise InputError(
                expected=f"only variables of kind situation in a rule that concludes `{moves[0]}`",
                got=repr(read.name),
                remedy=f"Let it read the situation, or conclude one of {moves[0].name}'s own terms: {own}.",
            )


def _as_parameter(parameter: NumericParameter) -> NumericParameter:
    """The difference as a parameter of the same name, whose rules are those that conclude its terms."""
    shift = parameter.shift
    assert shift is not None
    return NumericParameter(
        name=parameter.name,
        kind=parameter.kind,
        unit=parameter.unit,
        rules=shift.range,
        ask=EVERYTHING,
        safe=EVERYTHING,
        terms=shift.terms,
        neutral=NEUTRAL,
        spread=parameter.spread,
        shapes=shift.shapes,
        reasons={},
    )
