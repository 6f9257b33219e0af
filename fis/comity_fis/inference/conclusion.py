"""What rules that hold give a numeric parameter: a fuzzy set, and the one number that stands for it."""

from __future__ import annotations

from comity_fis.defuzzification.centroid import Cut
from comity_fis.defuzzification.curve import Curve
from comity_fis.defuzzification.engine import EXACT, Engine
from comity_fis.defuzzification.mamdani import AggregatedSet
from comity_fis.defuzzification.output_set import Concluded, OutputSet
from comity_fis.inference.block import Block, Program
from comity_fis.inference.firing import Fired
from comity_fis.variables.parameter import NumericParameter


def centre_of(
    block: Block, parameter: NumericParameter, program: Program, fired: Fired, engine: Engine
) -> float | None:
    """The number that stands for the set; None where that has no area."""
    if not program.has_cuts:
        return engine.defuzzified(_output_set(parameter, program, fired))
    if block.form is not None and engine is EXACT:
        return block.form.centre(fired.strengths)
    return engine.centre(_cuts(parameter, fired), *parameter.rules.ends)


def set_of(parameter: NumericParameter, program: Program, fired: Fired) -> Curve:
    """The fuzzy set."""
    if not program.has_cuts:
        return _output_set(parameter, program, fired)
    return AggregatedSet(parameter.rules, _cuts(parameter, fired))


def _output_set(parameter: NumericParameter, program: Program, fired: Fired) -> OutputSet:
    given = fired.given(program.methods)
    concluded = [Concluded(parameter.terms[term], strength) for term, strength in given]
    return OutputSet(parameter.rules, tuple(concluded), program.methods)


def _cuts(parameter: NumericParameter, fired: Fired) -> tuple[Cut, ...]:
    return tuple([Cut(parameter.terms[term], strength) for term, strength in fired.strengths.items()])
