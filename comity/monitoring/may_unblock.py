"""What may still open a route to a person who has none: opening a door, or people who move or turn.

The robot knows the place and which doors are shut, but not future events.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.planning.agenda import places_for
from comity.planning.barring import opened
from comity.planning.request import spots_of, why_unserved
from comity_domain import sides
from comity_fis.listing import listed
from comity_sim2d import PastPeople

if TYPE_CHECKING:
    from collections.abc import Collection

    from comity_domain import Visitee
    from comity_sim2d import Scene


def what_may_help(
    scene: Scene,
    visitee: Visitee,
    *,
    met: Collection[str],
    walkers: Collection[str] = (),
    refused: Collection[str] = (),
) -> str | None:
    """What would open a route to a person, in words; None if nothing is known.

    Args:
        scene: The current scene.
        visitee: The person who cannot currently be served.
        met: People to whom there was a route before: they stood differently, and may do so again.
        walkers: People who walk: they may come to where there is a route.
        refused: People asked in vain to make way: they may change their minds.
    """
    shut = [door.name for door in scene.doors if not door.is_open]
    keys = [name for name in shut if _is_served(opened(scene, [name]), visitee, refused)]
    if keys or (shut and _is_served(opened(scene, shut), visitee, refused)):
        return f"{listed(keys, 'or') or listed(shut)} may be opened"
    if refused and _is_served(scene, visitee):
        return f"{listed((name for name in refused if name != visitee.name), 'or')} may make way"
    others = {person.name for person in scene.people} - {visitee.name}
    alone = opened(scene, shut).without(others)
    if _is_served(alone, visitee):
        return f"others near {visitee.name} may go"
    how = "who could be reached before" if visitee.name in met else "who walks"
    moves = visitee.name in {*met, *walkers} and sides(
        visitee.values
    )  # who accepts no side does not anywhere
    if moves and not spots_of(scene, PastPeople(scene), visitee):
        return f"{visitee.name}, {how}, may move"
    return None


def _is_served(scene: Scene, visitee: Visitee, refused: Collection[str] = ()) -> bool:
    """Whether a plan could serve them there, past everybody who was not asked in vain to make way."""
    route_map = PastPeople(scene, refused)
    places = places_for(scene, route_map, (visitee,))
    return why_unserved(scene, visitee, spots_of(scene, route_map, visitee), places) is None
