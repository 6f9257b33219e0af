"""Whether what is to be done at a visit can be done, and where what is offered is fetched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain import Say, offers, unheard
from comity_sim2d import standing_place

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from comity_domain import Visitee
    from comity_sim2d import Pose, RouteMap, Scene


def places_for(scene: Scene, route_map: RouteMap, visitees: Iterable[Visitee]) -> dict[str, Pose | None]:
    """Where the robot stands to fetch what is offered, by the place's name; None where it cannot."""
    kept = dict.fromkeys(offer.place for visitee in visitees for offer in offers(visitee.agenda))
    return {name: standing_place(scene, route_map, name) for name in kept}


def against_agenda(visitee: Visitee, places: Mapping[str, Pose | None]) -> str | None:
    """Why not all of an agenda can be done now; None where it can."""
    now, name = visitee.now, visitee.name
    silent = unheard(visitee.values, now)
    if silent and any(isinstance(task, Say) for task in visitee.agenda):
        return f"nothing can be said to {name}: {silent}"
    for offer in offers(visitee.agenda)[visitee.in_hand :]:
        if now.robot_carries:
            return f"{offer.thing} cannot be fetched for {name}: the robot carries {now.robot_carries}"
        if places[offer.place] is None:
            return (
                f"{offer.thing} cannot be fetched for {name}: no way leads to a free place at {offer.place}"
            )
    return None
