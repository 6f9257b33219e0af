"""How far the weights can change before another plan is cheaper.

The weights say what disliked options are worth in metres, and nobody can measure them: whoever reads a plan
should know whether it hangs on them. They are followed from a quarter to four times what they are, each by
itself and both together; the first factor each way at which another plan is cheaper is narrowed down.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from comity_domain.label_search import cheapest
from comity_domain.options import options
from comity_domain.plan import Plan
from comity_domain.request import VisitRequest, Weights
from comity_domain.skipping import served_part
from comity_domain.survey import fully_measured
from comity_domain.tour import Visit, best_tour, tour_cost
from comity_domain.what_if import MOST_PEOPLE, visits_of

LOWEST, HIGHEST = 0.25, 4.0
STEPS = 4
"""Factors looked at in each direction: the square roots of two up to four."""
NARROWED = 1.01
"""A factor at which the plan changes is known this exactly."""

Scale = Callable[[Weights, float], Weights]

Weight = Literal["side", "greeting", "both"]

SCALES: dict[Weight, Scale] = {
    "side": lambda weights, factor: replace(weights, side_m=weights.side_m * factor),
    "greeting": lambda weights, factor: replace(weights, greeting_m=weights.greeting_m * factor),
    "both": lambda weights, factor: weights.scaled(factor),
}


@dataclass(frozen=True, slots=True)
class Flip:
    """Where another plan becomes cheaper."""

    weight: Weight
    factor: float
    """Of the weight, in [0.25, 4]."""
    visits: tuple[Visit, ...]
    """What is cheaper there."""


def flips(request: VisitRequest, plan: Plan) -> tuple[Flip, ...] | None:
    """The nearest factors at which the plan is no longer among the cheapest; empty: it is stable.

    Returns:
        None where there are too many people to know.
    """
    if len(request.visitees) > MOST_PEOPLE:
        return None
    request, visits = served_part(fully_measured(request), plan), visits_of(plan)
    return tuple(
        flip
        for weight in SCALES
        for limit in (LOWEST, HIGHEST)
        if (flip := _first_flip(request, visits, weight, limit)) is not None
    )


def _first_flip(request: VisitRequest, visits: Sequence[Visit], weight: Weight, limit: float) -> Flip | None:
    last = 1.0
    for step in range(1, STEPS + 1):
        factor = limit ** (step / STEPS)
        if _cheaper(request, visits, weight, factor) is not None:
            return _narrowed(request, visits, weight, last, factor)
        last = factor
    return None


def _narrowed(
    request: VisitRequest, visits: Sequence[Visit], weight: Weight, stays: float, flipped: float
) -> Flip:
    """Halve the distance until the factor is known well enough."""
    while max(stays / flipped, flipped / stays) > NARROWED:
        middle = (stays * flipped) ** 0.5
        if _cheaper(request, visits, weight, middle) is None:
            stays = middle
        else:
            flipped = middle
    cheaper = _cheaper(request, visits, weight, flipped)
    assert cheaper is not None  # that is how `flipped` was found
    return Flip(weight, flipped, cheaper)


def _cheaper(
    request: VisitRequest, visits: Sequence[Visit], weight: Weight, factor: float
) -> tuple[Visit, ...] | None:
    """A plan that is cheaper at this factor; None where these visits are still among the cheapest."""
    choices = options(replace(request, weights=SCALES[weight](request.weights, factor)))
    best, cost = cheapest(choices), tour_cost(visits, choices)
    if best is None or (cost is not None and cost <= best.cost):
        return None
    return best_tour(best.stops, choices)


def differences(before: Sequence[Visit], after: Sequence[Visit]) -> Iterator[str]:
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
