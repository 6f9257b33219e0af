"""The prize of a dropped visit, and the cost it is compared with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import SkippingAnswer
from comity.planning.agenda import places_for
from comity.planning.request import spots_of, what_bars, why_unserved
from comity_domain import SKIP, cost_of_serving

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity.preparation import PlannedEpisode


def skipping(prepared: PlannedEpisode, name: str) -> SkippingAnswer:
    """The prize of a dropped visit, and what serving the person would have cost.

    Args:
        prepared: A planned episode that drops the visit.
        name: Name of the person.
    """
    visitee = next(one for one in prepared.visitees if one.name == name)
    within_reach = name not in prepared.asked.request.dropped_m
    serving = cost_of_serving(prepared.asked.request, name) if within_reach else None
    scene, route_map = prepared.scene, prepared.route_map
    places = places_for(scene, route_map, prepared.visitees)
    found = spots_of(scene, route_map, visitee)
    reason = why_unserved(scene, visitee, found, places)
    if reason is not None and not found:
        reason += what_bars(scene, visitee)
    if reason is None and serving is None:
        reason = "no order of visits keeps every deadline with them"
    price = next(step.cost for step in prepared.plan.steps if (step.action, step.person) == (SKIP, name))
    return SkippingAnswer(price=price, serving=serving, reason=reason)


def skipping_text(skipping: SkippingAnswer) -> Iterator[str]:
    """The answer as text."""
    yield f"the scenario prices that at {skipping.price} cm (`skip: {skipping.price / 100:g}`)"
    if skipping.serving is None:
        yield f"they cannot be served: {skipping.reason}"
        return
    more = skipping.serving - skipping.price
    yield (
        f"to serve them would cost {skipping.serving} cm of path, {more} more than the price; for this "
        "paths count the same for everyone, so that culture has no say in who is served"
    )
