"""Reasons why the robot was within a person's preferred distance while neither visiting nor leaving them."""

from __future__ import annotations

from dataclasses import dataclass
from math import dist
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.run import Disturbance
from comity.simulation.scene_later import scene_at
from comity_executor.trees.passing import ASK
from comity_sim2d import RouteMap, SceneError
from comity_sim2d.metrics import clearances_m, intrusion_of, own_distances_m
from comity_sim2d.metrics.intrusion import TICK_S
from comity_sim2d.robot.margins import MOVED_M

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity.episode import Episode
    from comity_sim2d.metrics.intrusion import IntrusionSpan
    from comity_sim2d.metrics.known import Known

    XY = tuple[float, float]

SHORTEST_S = 0.1
"""Minimum length of a reported stay [s]: shorter ones are below the precision of docking and frames."""
SAME_M = 0.05
"""Routes count as equally long if their lengths differ by less than this [m]."""
FOLLOWS_M = 0.03
"""Precision with which the robot follows its route [m]."""
EDGE_M = 0.05
"""Tolerance within which a position counts as on the boundary of a person's distance, as when docked [m]."""
ASKED_S = 15.0
"""Time for which a request to let it pass remains in effect [s]."""
BEFORE_S = 1.0
"""Time before a stay in which the approaching party is determined [s]."""


def nearness_answers(episode: Episode) -> Iterator[Disturbance]:
    """Every stay within a known preferred distance, with its reason, by time."""
    known = episode.known
    intrusion = intrusion_of(episode.frames, known)
    stays = [
        stay
        for person in intrusion.people
        if person in intrusion.own
        for stay in intrusion.stays(episode.frames, person)
        if stay.length_s > SHORTEST_S
    ]
    for stay in sorted(stays, key=lambda one: one.start_s):
        yield Disturbance(
            t=stay.start_s,
            end_s=stay.start_s + stay.length_s,
            kind="nearness",
            about=stay.person,
            text=_text(stay, episode, known),
        )


def _text(stay: IntrusionSpan, episode: Episode, known: Known) -> str:
    """The actual distance, the preferred distance, and the reason, in words."""
    frames, person = episode.frames, stay.person
    gaps = clearances_m(frames)[:, frames.entities.index(person) - 1]
    own = own_distances_m(frames.time_s, known.own_m[person], known.later_m.get(person, ()))
    first, last = np.searchsorted(
        frames.time_s, [stay.start_s - TICK_S, stay.start_s + stay.length_s + TICK_S]
    )
    nearest = int(first) + int(np.argmin(gaps[first:last]))
    told = f"robot {gaps[nearest]:.2f} m from {person}, who likes {own[nearest]:.2f} m"
    if own[nearest] - gaps[nearest] <= FOLLOWS_M:
        return f"{told}: it follows its route as exactly as that"
    why = _Why(episode, stay, float(own[nearest]), float(frames.time_s[nearest]))
    return f"{told}: {why.text()}"


@dataclass(frozen=True, slots=True)
class _Why:
    """The cause of one stay."""

    episode: Episode
    stay: IntrusionSpan
    own_m: float
    nearest_s: float
    """Time at which the robot was nearest to the person [s]."""

    def text(self) -> str:
        """The person's action, else the robot's position, else the available routes, in words."""
        return self._of_person() or self._of_place() or self._of_routes()

    def _of_person(self) -> str:
        person, before_s = self.stay.person, self._before_s
        asked = (act for act in self.episode.acts if act.act == ASK and act.person == person)
        if any(0.0 <= self.stay.start_s - act.t_start <= ASKED_S for act in asked):
            return f"it had asked {person} to let it pass"
        came = self._closed_by_person(before_s) > self._closed_by_robot(before_s)
        return f"{person} came to it" if came else ""

    def _of_place(self) -> str:
        """The place within the person's distance where the robot stood nearest to them, if any."""
        places = [
            (t, f"its place before {other} is as near")
            for t, other in self._docked
            if self.stay.start_s <= t <= self._end_s and other != self.stay.person
        ]
        left_s, left = self._left
        places.append(
            (left_s, f"it went on from {f'its place before {left}' if left else 'where it started'}")
        )
        near = [(self._apart_m(t), text) for t, text in places if self._is_near(t)]
        return min(near)[1] if near else ""

    def _of_routes(self) -> str:
        left_s, _ = self._left
        goal_s = min((t for t, _ in self._docked if t > self._end_s), default=self._last_s)
        for t in (left_s, max(self._before_s, left_s)):
            if reason := self._of_route(t, goal_s):
                return reason
        if dist(self._person(left_s), self._person(self.stay.start_s)) > MOVED_M:
            return f"{self.stay.person} moved while it was on its way"
        return "it left the route that keeps clear of everybody, for who or what was in the way"

    @property
    def _before_s(self) -> float:
        return max(self.stay.start_s - BEFORE_S, 0.0)

    @property
    def _end_s(self) -> float:
        return self.stay.start_s + self.stay.length_s

    @property
    def _last_s(self) -> float:
        return float(self.episode.frames.time_s[-1])

    @property
    def _left(self) -> tuple[float, str]:
        """Time of the last docking before the stay [s], and the person; 0 and an empty name if none."""
        return max((visit for visit in self._docked if visit[0] < self.stay.start_s), default=(0.0, ""))

    @property
    def _docked(self) -> list[tuple[float, str]]:
        """Times [s] and people of dockings, by time."""
        visits = self.episode.visits
        return sorted((visit.docked_s, visit.person) for visit in visits if visit.docked_s is not None)

    def _at(self, name: str, t: float) -> XY:
        frames = self.episode.frames
        row = min(int(np.searchsorted(frames.time_s, t - TICK_S)), len(frames) - 1)
        x, y = frames.of(name)[row, :2].tolist()
        return x, y

    def _person(self, t: float) -> XY:
        return self._at(self.stay.person, t)

    def _robot(self, t: float) -> XY:
        return self._at(self.episode.prepared.scene.robot.name, t)

    def _closed_by_person(self, since_s: float) -> float:
        """By how much the person came nearer to the robot's earlier position [m]."""
        here = self._robot(since_s)
        return dist(here, self._person(since_s)) - dist(here, self._person(self.nearest_s))

    def _closed_by_robot(self, since_s: float) -> float:
        """By how much the robot came nearer to the person's earlier position [m]."""
        there = self._person(since_s)
        return dist(self._robot(since_s), there) - dist(self._robot(self.nearest_s), there)

    def _is_near(self, t: float) -> bool:
        """Whether the robot was docked within the person's distance, or at its boundary."""
        scene = self.episode.prepared.scene
        bodies_m = scene.robot.radius_m + scene.person(self.stay.person).radius_m
        return self._apart_m(t) < self.own_m + bodies_m + EDGE_M

    def _apart_m(self, t: float) -> float:
        """Distance of the robot's centre from the person's [m]."""
        return dist(self._robot(t), self._person(t))

    def _of_route(self, t: float, goal_s: float) -> str | None:
        """The extra length of a route clear of everybody at that time, in words; None if negligible."""
        begun, frames = self.episode.prepared.scene, self.episode.frames
        try:
            ways = RouteMap(scene_at(begun, frames, t, turns=self.episode.door_turns))
            start, goal = self._robot(t), self._robot(goal_s)
            route, polite = ways.route(start, goal), ways.polite(start, goal)
        except SceneError:  # bodies overlap at that time, or the robot touched a wall
            return None
        if route is None:  # a person stood where the robot was to dock
            return None
        if polite is None:
            return "no route keeps clear of everybody"
        longer_m = polite.length_m - route.length_m
        if longer_m < SAME_M:
            return None
        return f"a route that keeps clear of everybody would be {longer_m:.1f} m longer"
