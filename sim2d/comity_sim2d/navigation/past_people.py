"""Routes that rely on people making way: the robot can ask those who block the only path."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from comity_sim2d.kinds import require_names
from comity_sim2d.navigation.route import Route
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.pose import XY
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene.surroundings import Surroundings


def without_people(surroundings: Surroundings, but: Collection[str] = ()) -> RouteMap:
    """The routes that would exist if all people made way.

    Args:
        surroundings: The place.
        but: People who stay, together with the o-space of those who stand together.
    """
    staying = tuple(person for person in surroundings.people if person.name in but)
    return RouteMap(surroundings.with_people(staying))


class PastPeople(RouteMap):
    """Routes around people if there are any; else the routes that would exist if all people made way.

    Args:
        scene: The place.
        but: People who stay: the visited person, and people who were asked in vain.
        walkers: People who leave anyway.
    """

    def __init__(
        self, scene: Scene | Surroundings, but: Collection[str] = (), *, walkers: Collection[str] = ()
    ) -> None:
        super().__init__(scene)
        require_names("past people", "but", but)
        require_names("past people", "walkers", walkers)
        self._but, self._walkers = tuple(but), frozenset(walkers)
        self._bare = without_people(self.surroundings, but)

    def to(self, person: str) -> RouteMap:
        """The routes for a visit to a person, who stays unless they walk."""
        if person in self._walkers or person in self._but:
            return self
        return PastPeople(self.surroundings, (*self._but, person), walkers=self._walkers)

    def with_people(self, people: tuple[Person, ...]) -> PastPeople:
        """The same kind of routes for changed positions or preferences of people."""
        return PastPeople(self.surroundings.with_people(people), self._but, walkers=self._walkers)

    def route(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> Route | None:
        """The route around people, or past them; None if walls or furniture leave none."""
        return super().route(start, goal, keep=keep) or self._bare.route(start, goal)

    def reaches(self, start: XY, goal: XY, *, keep: Mapping[str, float] | None = None) -> bool:
        """Whether there is a route of either kind."""
        return super().reaches(start, goal, keep=keep) or self._bare.reaches(start, goal)
