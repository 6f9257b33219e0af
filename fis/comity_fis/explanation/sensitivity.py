"""How a value answers to a small change of one input: exact derivatives, one on each side.

The centre of area is a smooth function of the heights at which rules cut their terms: where the aggregated
set is flat at a rule's strength it rises with it, over the width of that flat stretch; elsewhere nothing
moves. The strengths change with the input by the chain rule through `min`, `max`, complement and membership.
At a corner of any of these the two sides differ.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isinf

from comity_fis.explanation.movement import Rates, Standing, rates_of, speed_of
from comity_fis.inference.value import Inference
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.dependencies import Reading
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

FLAT = 1e-12
"""A derivative below this share of the output's range per range of the input is none."""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The derivative of a numeric parameter by one numeric input, in the parameter's unit per unit of it."""

    input: str
    at: float
    unit: str | None
    """Of the input."""
    below: float | None
    """Coming from smaller values; infinite where the value jumps; None at the lower end of the domain."""
    above: float | None
    """Coming from larger values; None at the upper end."""
    flat_over: Interval | None = None
    """Around the input's value, where the parameter's value stays as it is; None where it is not flat."""

    @property
    def kink(self) -> bool:
        """Whether the two sides differ."""
        if self.below is None or self.above is None or self.below == self.above:
            return False
        return abs(self.below - self.above) > 1e-9 * (abs(self.below) + abs(self.above))

    @property
    def derivative(self) -> float | None:
        """What both sides agree on, or the only side; None at a kink or a jump."""
        sides = [side for side in (self.below, self.above) if side is not None]
        return None if self.kink or not sides or isinf(sides[0]) else sides[0]

    @property
    def flat(self) -> bool:
        """Whether a small change changes nothing."""
        return self.derivative == 0.0


def sensitivities(
    rulebook: Rulebook, inference: Inference, read: Reading, standing: Standing
) -> tuple[Sensitivity, ...]:
    """The derivative of one numeric parameter by each numeric input that was disclosed and that it reads."""
    found = []
    for name in read.inputs:
        variable, at = rulebook.variables[name], inference.inputs[name]
        if isinstance(variable, NumericVariable) and isinstance(at, int | float):
            below, above = _slopes(standing, variable, at)
            found.append(
                Sensitivity(
                    input=name,
                    at=at,
                    unit=variable.unit,
                    below=None if at <= variable.domain.low else below,
                    above=None if at >= variable.domain.high else above,
                )
            )
    return tuple(found)


def _slopes(standing: Standing, variable: NumericVariable, at: float) -> tuple[float, float]:
    """Below and above, in the parameter's unit per unit of the input."""
    down, up = rates_of(standing.program, variable, at)
    return -_slope(standing, variable, down), _slope(standing, variable, up)


def _slope(standing: Standing, variable: NumericVariable, rates: Rates) -> float:
    """On the side to which the input moves."""
    speed = speed_of(standing, rates) if rates else 0.0
    made = standing.blocks[-1].parameter
    assert isinstance(made, NumericParameter)
    (low, high), (first, last) = made.rules.ends, variable.domain.ends
    return 0.0 if abs(speed) <= FLAT * (high - low) / (last - first) else speed
