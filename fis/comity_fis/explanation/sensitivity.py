"""Sensitivity of a value to a small change of one input: one-sided derivatives.

Derivatives are finite differences: the input is changed slightly to one side, and the parameter inferred
again. At a corner of a membership function, or where the dominant rule changes, the two sides differ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign, inf, isclose, isinf

from comity_fis.explanation.what_if import WhatIf
from comity_fis.membership.interval import Interval
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

STEP = 1e-5
"""Step as a fraction of the input's range: above rounding, below the curvature between two corners."""

NO_ROOM = 1e-7
"""Distance from an end of the input's range, as a fraction of it, that counts as being at that end."""

FLAT = 1e-6
"""Derivatives below this fraction of (output range / input range) count as 0."""

SMOOTH = 1e-4
"""Relative difference below which the one-sided derivatives are equal."""

JUMP = 0.05
"""The value jumps if a hundredth of the step causes more than this fraction of the step's change."""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The derivative of a numeric parameter by a numeric input, in parameter units per input unit."""

    input: str
    at: float
    unit: str | None
    """Unit of the input."""
    below: float | None
    """Derivative from below; infinite at a jump; None at the lower end of the domain."""
    above: float | None
    """Derivative from above; None at the upper end."""
    flat_over: Interval | None = None
    """Interval around the input's value where the parameter is constant; None if it is not flat."""

    @property
    def kink(self) -> bool:
        """Whether the one-sided derivatives differ."""
        return self.below is not None and self.above is not None and self.below != self.above

    @property
    def derivative(self) -> float | None:
        """The derivative common to both sides, or of the only side; None at a kink or a jump."""
        sides = [side for side in (self.below, self.above) if side is not None]
        return None if self.kink or not sides or isinf(sides[0]) else sides[0]

    @property
    def flat(self) -> bool:
        """Whether a small change has no effect."""
        return self.derivative == 0.0


def sensitivities(question: WhatIf) -> tuple[Sensitivity, ...]:
    """The derivatives of a numeric parameter by each known numeric input that it depends on."""
    if not isinstance(question.parameter, NumericParameter):
        return ()
    found = []
    for name in question.read.inputs:
        variable, at = question.rulebook.variables[name], question.inference.inputs[name]
        if isinstance(variable, NumericVariable) and isinstance(at, int | float):
            below, above = _sides(question, question.parameter, variable, at)
            one = Sensitivity(name, at, variable.unit, below, above)
            flat_over = question.flat_over(name) if one.flat else None
            found.append(Sensitivity(name, at, variable.unit, below, above, flat_over))
    return tuple(found)


def _sides(
    question: WhatIf, parameter: NumericParameter, variable: NumericVariable, at: float
) -> tuple[float | None, float | None]:
    """The derivatives from below and above; None at an end of the domain."""
    low, high = variable.domain.ends
    span = parameter.rules.high - parameter.rules.low
    least = FLAT * span / (high - low)

    def change(distance: float) -> float:
        """Change of the value if the input changes by `distance`."""
        return question.given(variable.name, at + distance).number - question.now.number

    step = STEP * (high - low)
    below, above = (
        None if room <= NO_ROOM * (high - low) else _slope(change, copysign(min(step, room / 2), side), least)
        for side, room in ((-1.0, at - low), (1.0, high - at))
    )
    if below is not None and above is not None and isclose(below, above, rel_tol=SMOOTH, abs_tol=least):
        below = above = (below + above) / 2
    return below, above


def _slope(change: Callable[[float], float], step: float, least: float) -> float:
    """The one-sided derivative, from the parabola through the value and two points on that side.

    Args:
        change: Change of the value by change of the input.
        step: Signed distance of the nearer point; negative for below.
        least: Slopes up to this size count as 0.
    """
    near, far = change(step), change(2 * step)
    if abs(near) > 2 * least * abs(step) and abs(change(step / 100)) > JUMP * abs(near):
        return copysign(inf, near / step)
    slope = (4 * near - far) / (2 * step)
    return 0.0 if abs(slope) <= least else slope
