"""Shift rules: how much the situation shifts a parameter of one person.

A shift rule counts only if one of its inputs is known. In the rules for a value, an unknown input fires with
possibility 1, so that the value lies between those of the possible inputs. A shift has a neutral value, 0, so
unknown inputs shift nothing.
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
    """The enabled shift rules, by parameter."""
    blocks = {
        name: block_of(_as_parameter(parameter), rules, methods)
        for name, parameter in parameters.items()
        if isinstance(parameter, NumericParameter) and parameter.shift is not None
    }
    return {name: block for name, block in blocks.items() if block.clauses}


def shift_of(block: Block | None, person: DisclosedPerson) -> ParameterValue | None:
    """The situation's shift of a parameter, in its unit; None if no rule has a known input."""
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
    """Reject a shift rule that reads variables about the person: those belong in the other rules.

    Raises:
        InputError: With the first name that is not a situation variable.
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
    """The shift as a parameter of the same name, concluded by the shift rules."""
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
