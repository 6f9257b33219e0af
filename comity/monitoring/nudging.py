"""How far the operator may move the distance to a person."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import Contribution
from comity_fis.learning.signals import AWAY
from comity_fis.proxemics import PERSON_MARGIN_M

if TYPE_CHECKING:
    from comity_executor import Visit
    from comity_fis import Inference

FARTHEST_M = 3.0
"""No farther between the bodies than a person may ask for [m]."""
STEP_SHARE = 0.5
"""Of the spread: so much nearer than without the operator at most, as for invitations of a person."""


def nudged(values: Inference, by_m: float, *, visit: Visit | None, tolerance_m: float) -> Inference | str:
    """A person's parameters after a nudge, or why it is refused: it is never bent.

    Args:
        values: As they are now.
        by_m: How much farther; negative is nearer.
        visit: How the visit to them went so far.
        tolerance_m: How exactly the robot stops.
    """
    value = values[DISTANCE]
    wanted_m = value.number + by_m
    before_m = value.number - sum(_nudge(each) for each in value.contributions)
    nearest_m = max(PERSON_MARGIN_M + tolerance_m, before_m - STEP_SHARE * (value.spread or 0.0))
    if value.asked_for:
        return f"they asked for {value.number:.2f} m"
    if by_m < 0.0 and visit is not None and visit.noticed and visit.noticed.kind in AWAY:
        return "they have shown that they want the robot farther away"
    if wanted_m < nearest_m - 1e-9:
        return f"no operator brings the robot nearer to them than {nearest_m:.2f} m"
    if wanted_m > FARTHEST_M:
        return f"nobody is met farther away than {FARTHEST_M:g} m"
    told = f"the operator nudged it {'farther' if by_m > 0.0 else 'nearer'} by {abs(by_m):.2f} m"
    contributions = (*value.contributions, Contribution("operator", by_m, told))
    moved = replace(value, value=wanted_m, origin="operator", contributions=contributions)
    return replace(values, parameters={**values.parameters, DISTANCE: moved})


def _nudge(contribution: Contribution) -> float:
    return float(contribution.value) if contribution.origin == "operator" else 0.0
