"""Stability: how far the weights can change before another plan is cheaper.

The weights convert preferences to metres and cannot be measured, so a reader of a plan should know whether it
depends on them. They are varied from a quarter to four times their value, each alone and both together; the
first factor in each direction at which another plan is cheaper is narrowed down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from comity_domain.choices.options import options
from comity_domain.explanation.what_if import MOST_PEOPLE, visits_of
from comity_domain.labelling.search import NO_LIMIT, cheapest
from comity_domain.labelling.skipping import served_part
from comity_domain.plans.plan import Plan
from comity_domain.problem.measuring import measured, unmeasured
from comity_domain.problem.request import VisitRequest, Weights
from comity_domain.tours.tour import PlannedVisit, best_tour, path, tour_cost

LOWEST, HIGHEST = 0.25, 4.0
STEPS = 4
"""Number of factors tested in each direction: powers of the square root of two up to four."""
NARROWED = 1.01
"""Precision (ratio) of the factor at which the plan changes."""

Scale = Callable[[Weights, float], Weights]

Weight = Literal["side", "greeting", "both"]

SCALES: dict[Weight, Scale] = {
    "side": lambda weights, factor: replace(weights, side_m=weights.side_m * factor),
    "greeting": lambda weights, factor: replace(weights, greeting_m=weights.greeting_m * factor),
    "both": lambda weights, factor: weights.scaled(factor),
}


@dataclass(frozen=True, slots=True)
class BreakEven:
    """A factor at which another plan becomes cheaper."""

    weight: Weight
    factor: float
    """Factor of the weight, in [0.25, 4]."""
    visits: tuple[PlannedVisit, ...]
    """The visits of the cheaper plan."""


def flips(request: VisitRequest, plan: Plan) -> tuple[BreakEven, ...] | None:
    """The nearest factors at which the plan is no longer among the cheapest; empty: it is stable.

    Returns:
        None if there are too many people.
    """
    if len(request.visitees) > MOST_PEOPLE:
        return None
    weighing = _Weighing(served_part(request, plan), visits_of(plan))
    return tuple(
        flip
        for weight in SCALES
        for limit in (LOWEST, HIGHEST)
        if (flip := weighing.first_flip(weight, limit)) is not None
    )


class _Weighing:
    """A plan held against others at other weights; ways are measured as far as an answer takes them.

    Args:
        request: For those whom the plan serves.
        visits: The plan.
    """

    def __init__(self, request: VisitRequest, visits: Sequence[PlannedVisit]) -> None:
        self._request = measured(request, unmeasured(request, path(visits, options(request))))
        self._visits = visits

    def first_flip(self, weight: Weight, limit: float) -> BreakEven | None:
        """The nearest factor towards this limit at which another plan is cheaper; None: none is."""
        last = 1.0
        for step in range(1, STEPS + 1):
            factor = limit ** (step / STEPS)
            cheaper = self._cheaper(weight, factor)
            if cheaper is not None:
                return self._narrowed(BreakEven(weight, factor, cheaper), last)
            last = factor
        return None

    def _narrowed(self, flip: BreakEven, stays: float) -> BreakEven:
        """Halve the distance until the factor is known well enough.

        Args:
            flip: Where another plan is cheaper.
            stays: A factor at which none is.
        """
        while max(stays / flip.factor, flip.factor / stays) > NARROWED:
            middle = (stays * flip.factor) ** 0.5
            cheaper = self._cheaper(flip.weight, middle)
            if cheaper is None:
                stays = middle
            else:
                flip = BreakEven(flip.weight, middle, cheaper)
        return flip

    def _cheaper(self, weight: Weight, factor: float) -> tuple[PlannedVisit, ...] | None:
        """A plan that is cheaper at this factor; None where these visits are still among the cheapest.

        With bounds no plan costs more than it does: where none is cheaper then, none is.
        """
        while True:
            weights = SCALES[weight](self._request.weights, factor)
            choices = options(replace(self._request, weights=weights))
            cost = tour_cost(self._visits, choices)
            best = cheapest(choices, at_most=NO_LIMIT if cost is None else cost - 1)
            if best is None:
                return None
            tour = best_tour(best.stops, choices)
            missing = unmeasured(self._request, path(tour, choices))
            if not missing:
                return tour
            self._request = measured(self._request, missing)


def differences(before: Sequence[PlannedVisit], after: Sequence[PlannedVisit]) -> Iterator[str]:
    """What another plan does otherwise, in words."""
    order, other = ([visit.spot.place for visit in visits] for visits in (before, after))
    if order != other:
        yield f"goes to {', '.join(other)}"
    known = {visit.spot.place: visit for visit in before}
    for visit in after:
        was = known.get(visit.spot.place)
        if was is None or was == visit:
            continue
        if was.spot != visit.spot:
            yield f"reaches {visit.spot.place} from the {visit.spot.side}, not the {was.spot.side}"
        if was.company != visit.company:
            yield f"greets {visit.company or visit.spot.place}, not {was.company or was.spot.place} at once"
        elif was.way and visit.way and was.way != visit.way:
            yield f"greets {visit.spot.place} {_way(visit.way)}, not {_way(was.way)}"
        if was.bringing != visit.bringing:
            first, second = ("before", "after") if visit.bringing else ("after", "before")
            yield f"fetches what {visit.spot.place} is offered {first} the greeting, not {second} it"
        if was.farewell and visit.farewell and was.farewell != visit.farewell:
            yield f"takes leave of {visit.spot.place} {_way(visit.farewell)}, not {_way(was.farewell)}"


def _way(way: tuple[str, str]) -> str:
    return " with ".join(word for word in way if word != "none")
