"""Routes of which only a lower bound is known so far, and how to measure them.

Measuring a route among people takes milliseconds; a request has thousands, and a plan uses a few dozen. So a
request may hold lower bounds: no route is shorter. A plan computed with bounds costs no more than one
computed with lengths; so once every route of a cheapest plan is measured, that plan is optimal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from comity_domain.problem.spot import Leg, Way


@dataclass(frozen=True, slots=True)
class Survey:
    """The unmeasured routes of a request. The functions are deterministic."""

    legs: frozenset[Leg]
    """The legs of `travel` that are bounds."""
    ways: frozenset[Way]
    """The ways of `ways_m` and `durations_s` that are bounds."""
    leg_m: Callable[[Leg], float | None]
    """The length of a leg [m]; None if there is no route."""
    way: Callable[[Way], tuple[float, float] | None]
    """The length [m] and travel time [s] of a way, computed without culture; None if there is no route."""
