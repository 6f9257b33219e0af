"""What rules that hold give a numeric parameter: a fuzzy set, and the one number that stands for it."""

from __future__ import annotations

from comity_fis.defuzzification.engine import EXACT, Engine
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.inference.block import Block, Program
from comity_fis.inference.firing import Fired
from comity_fis.rules.methods import united
from comity_fis.variables.parameter import NumericParameter


def centre_of(
    block: Block, parameter: NumericParameter, program: Program, fired: Fired, engine: Engine
) -> float | None:
    """The number that stands for the set; None where that has no area."""
    if block.form is not None and engine is EXACT:
        methods, heights = program.methods, fired.strengths
        if methods.aggregation != "max":
            heights = united(fired.given(methods), methods.aggregation)
        return block.form.centre(heights)
    return engine.value(set_of(parameter, program, fired))


def set_of(parameter: NumericParameter, program: Program, fired: Fired) -> OutputSet:
    """The fuzzy set."""
    layers = tuple(
        [Layer(parameter.terms[term], strength) for term, strength in fired.given(program.methods)]
    )
    return OutputSet(parameter.rules, layers, program.methods, tuple(parameter.terms.values()))
