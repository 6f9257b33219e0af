"""Ways of which only a bound is known so far, and how to measure them.

To measure a way among people takes milliseconds, and there are thousands of them, of which a plan takes a few
dozen. So a request may hold bounds: no route is shorter. What is planned with bounds costs no more than what
is planned with lengths; once all that a cheapest plan takes is measured, it is the cheapest of all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from comity_domain.problem.spot import Leg, Way


@dataclass(frozen=True, slots=True)
class Survey:
    """What is not measured of a request. The functions answer the same each time."""

    legs: frozenset[Leg]
    """Those of `travel` that are bounds."""
    ways: frozenset[Way]
    """Those of `ways_m` and `durations_s` that are bounds."""
    leg_m: Callable[[Leg], float | None]
    """The length of a route [m]; None where there is none."""
    way: Callable[[Way], tuple[float, float] | None]
    """The length of a way [m] and what it takes [s], computed without culture; None where there is none."""
