"""How a value answers to a small change of one input: a derivative on each side.

Each is taken from differences: the input is moved a little to one side, and the parameter inferred again. At
a corner of a membership function, or where another rule takes the lead, the two sides differ.
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
"""Of the input's range: wide enough for rounding, narrow enough for the curves between two corners."""

NO_ROOM = 1e-7
"""Of the input's range: what is no farther from an end of it stands at that end."""

FLAT = 1e-6
"""A derivative below this share of the output's range per range of the input is none."""

SMOOTH = 1e-4
"""Derivatives of both sides that differ by less, relative to their size, are one."""

JUMP = 0.05
"""Where a hundredth of the step changes the value by more than this part of what the step does, it jumps."""


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
        return self.below is not None and self.above is not None and self.below != self.above

    @property
    def derivative(self) -> float | None:
        """What both sides agree on, or the only side; None at a kink or a jump."""
        sides = [side for side in (self.below, self.above) if side is not None]
        return None if self.kink or not sides or isinf(sides[0]) else sides[0]

    @property
    def flat(self) -> bool:
        """Whether a small change changes nothing."""
        return self.derivative == 0.0


def sensitivities(question: WhatIf) -> tuple[Sensitivity, ...]:
    """The derivative of one numeric parameter by each numeric input that was disclosed and that it reads."""
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
    """The derivatives below and above; None at an end of the domain."""
    low, high = variable.domain.ends
    span = parameter.rules.high - parameter.rules.low
    least = FLAT * span / (high - low)

    def change(distance: float) -> float:
        """By how much the value changes when the input moves so far."""
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
    """The derivative on the side of the step, from the parabola through the value and two more.

    Args:
        change: By how much the value changes.
        step: To the first of the two places; negative below.
        least: Slopes that are no larger are 0.
    """
    near, far = change(step), change(2 * step)
    if abs(near) > 2 * least * abs(step) and abs(change(step / 100)) > JUMP * abs(near):
        return copysign(inf, near / step)
    slope = (4 * near - far) / (2 * step)
    return 0.0 if abs(slope) <= least else slope
