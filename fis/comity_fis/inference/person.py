"""What is known of one person while their parameters are inferred one after the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from comity_fis.defuzzification.engine import Engine
from comity_fis.inference.block import Program
from comity_fis.inference.rough import Rough, Stated
from comity_fis.inference.value import ParameterValue
from comity_fis.rules.antecedent import Literal, Logic, hedged, logic_of
from comity_fis.rules.methods import OPERATORS


@dataclass(slots=True)
class DisclosedPerson:
    """One person: what was disclosed, and the parameters that are decided already."""

    program: Program
    inputs: Mapping[str, Stated | None]
    engine: Engine
    values: dict[str, ParameterValue] = field(default_factory=dict)
    """Grows in the order of evaluation."""
    logic: Logic[float] = field(init=False)
    """What `and` and `or` mean."""

    def __post_init__(self) -> None:
        self.logic = logic_of(self.program.methods, OPERATORS)

    def degree(self, literal: Literal) -> float:
        """The degree of a literal, in [0, 1]; 1 for what was not disclosed."""
        name, term = literal.name, literal.term
        if name in self.values:
            parameter = self.program.blocks[name].parameter
            return float(hedged(parameter.membership(term, self.values[name].value), literal))
        value = self.inputs[name]
        if value is None:
            return 1.0
        membership: Any = self.program.variables[name].terms[term]  # over numbers or over words, as the value
        if isinstance(value, Rough):
            return value.possibility(membership, literal)
        found = membership(value) if isinstance(value, str) else self.engine.degree(membership, value)
        return float(hedged(found, literal))

    def discloses(self, name: str) -> bool:
        """Whether a variable is known, or another parameter says more than its neutral value."""
        if name in self.values:
            return self.values[name].origin != "neutral"
        return self.inputs[name] is not None

    def tells_culture(self, name: str) -> bool:
        """Whether something disclosed tells who the person is."""
        if name in self.values:
            return self.values[name].start.origin == "culture"
        return self.program.variables[name].kind == "culture"
