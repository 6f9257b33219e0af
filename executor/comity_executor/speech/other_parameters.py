"""Further parameters of a person, without an argument in goals: robots receive them by name."""

from __future__ import annotations

from collections.abc import Mapping

from comity_domain.problem.bound_parameters import BOUND
from comity_fis.inference.value import Inference


def other_parameters(values: Inference | None) -> Mapping[str, float | str]:
    """All further parameters of a rulebook, in their units.

    A rulebook with a new parameter, such as the share of time in which the robot looks at the person, needs
    no change in Comity: a robot that knows the name reads it from its goals; others ignore it.

    Args:
        values: The person's parameters; None if nothing was inferred.
    """
    return {} if values is None else {name: one.value for name, one in values.items() if name not in BOUND}
