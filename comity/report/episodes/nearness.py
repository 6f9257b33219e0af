"""Reasons why the robot was within a person's preferred distance while neither visiting nor leaving them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from math import dist
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.run import Disturbance
from comity.monitoring.measuring import turns
from comity.simulation.manoeuvres import DREW_BACK
from comity.simulation.scene_later import scene_at
from comity_executor.trees.passing import ASK
from comity_fis.listing import listed
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import RouteMap, SceneError
from comity_sim2d.base.drive import NEAR_PEOPLE_M
from comity_sim2d.metrics import clearances_m, intrusion_of, own_distances_m
from comity_sim2d.metrics.intrusion import TICK_S
from comity_sim2d.robot.margins import MOVED_M

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity.episode import Episode
    from comity.simulation.manoeuvres import MotionSpan
    from comity_sim2d.metrics.intrusion import IntrusionSpan
    from comity_sim2d.metrics.known import Known
    from comity_sim2d.metrics.motion import Numbers

    XY = tuple[float, float]

SHORTEST_S = 0.1
"""Minimum length of a reported stay [s]: shorter ones are below the precision of docking and frames."""
SAME_M = 0.05
"""Routes count as equally long if their lengths differ by less than this [m]."""
FOLLOWS_M = 0.03
"""Precision with which the robot follows its route [m]."""
EDGE_M = 0.05
"""Two of its places count as equally near to a person if their distances differ by at most this [m]."""
MOVES_M = 0.01
"""Who has closed at most this much of a gap did not cause it [m]."""
DRIFTS_M = 0.1
"""Distance from a place within which the robot still stands there: sensor noise moves it [m]."""
ASKED_S = 15.0
"""Time for which a request to let it pass remains in effect [s]."""
NO_ROUTE, BY_ITSELF = "no route led to its goal", "it came nearer by itself"
BEFORE_S = 1.0
"""Time before a stay in which the approaching party is determined [s]."""

WALKED_S = 5.0
"""People who walked near the robot count until so long before it was nearest [s] (our choice)."""


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
    first, end = np.searchsorted(
        frames.time_s, [stay.start_s - TICK_S, stay.start_s + stay.length_s + TICK_S]
    ).tolist()
    nearest = first + int(np.argmin(gaps[first:end]))
    # What is to be explained: how the gap fell below the margin, else how it fell below the own distance.
    is_in_margin = gaps[nearest] < PERSON_MARGIN_M - FOLLOWS_M
    kept_m = PERSON_MARGIN_M if is_in_margin else own[nearest]
    before = int(np.searchsorted(frames.time_s, stay.start_s - BEFORE_S - TICK_S))
    kept = np.flatnonzero(gaps[before:nearest] >= kept_m)
    since = before + int(kept[-1]) if kept.size else before
    why = _Why(episode, stay, since, nearest, is_in_margin=bool(is_in_margin))
    is_exact = bool(own[nearest] - gaps[nearest] <= FOLLOWS_M)
    return f"robot {gaps[nearest]:.2f} m from {person}, who likes {own[nearest]:.2f} m: {why.text(is_exact)}"


@dataclass(frozen=True, slots=True)
class _Why:
    """The cause of one stay."""

    episode: Episode
    stay: IntrusionSpan
    since: int
    """Last frame before the nearest one in which the robot kept the distance; else the first of the stay."""
    nearest: int
    """Frame in which the robot was nearest to the person."""
    is_in_margin: bool
    """Whether it was nearer than any route leads."""

    def text(self, is_exact: bool) -> str:
        """The person's motion, the place where the robot stood, its manoeuvre, or its routes, in words."""
        exact = "it follows its route as exactly as that" if is_exact else ""
        return self._of_person() or exact or self._of_place() or self._of_robot() or self._of_routes()

    def _of_place(self) -> str:
        """The place where the robot stood as near to the person as ever, if any."""
        stood_s, left_s, here = self._left
        places = [((stood_s, left_s), f"it went on from {here}")] if stood_s <= self.stay.start_s else []
        places += [
            ((t, t), f"its place before {other} is as near")
            for t, other in self._docked
            if self.stay.start_s <= t <= self._end_s and other != self.stay.person
        ]
        near = [
            (self._apart_m(left_s), text)
            for (stood_s, left_s), text in places
            if self._is_as_near(stood_s) and self._is_as_near(left_s)
        ]
        return min(near)[1] if near else ""

    def _is_as_near(self, t: float) -> bool:
        """Whether the robot was then as near to the person as ever, or the two stood where they were then."""
        moved_m = dist(self._robot(t), self._robot(self._nearest_s))
        walked_m = dist(self._person(t), self._person(self._nearest_s))
        stay = moved_m <= DRIFTS_M and walked_m <= MOVES_M
        return stay or self._apart_m(t) <= self._apart_m(self._nearest_s) + EDGE_M

    def _of_person(self) -> str:
        """The person's motion, if it closed more of the gap than the robot's."""
        by_person_m = self._closed_m(self.stay.person, self._robot_name).sum()
        by_robot_m = self._closed_m(self._robot_name, self.stay.person).sum()
        if by_person_m <= max(by_robot_m, MOVES_M):
            return ""
        came = f"{self.stay.person} came to it"
        return f"{came}, after {asked}" if (asked := self._asked) else came

    def _of_robot(self) -> str:
        """The person's leave, or the manoeuvre that closed most of the gap, if any."""
        person, closed_m = self.stay.person, self._closed_m(self._robot_name, self.stay.person)
        if self.is_in_margin and any(
            one.kind == "passage" and one.about == person and one.t <= self._nearest_s <= (one.end_s or one.t)
            for one in self.episode.disturbances
        ):
            return f"{person} let it pass"
        if manoeuvre := self._manoeuvre(closed_m):
            return manoeuvre
        return "" if self.is_in_margin else self._asked

    def _manoeuvre(self, closed_m: Numbers) -> str:
        """The manoeuvre before another person that closed most of the gap, or began to; empty if none."""
        ends_s = self.episode.frames.time_s[self.since + 1 : self.nearest + 1]
        by_text: dict[str, float] = {}
        for span in self.episode.motion:
            if not self._is_for_others(span):
                continue
            during = (ends_s > span.start_s + TICK_S) & (ends_s <= span.end_s + TICK_S)
            if self.is_in_margin and during[:1].any():
                return span.manoeuvre
            by_text[span.manoeuvre] = by_text.get(span.manoeuvre, 0.0) + float(closed_m[during].sum())
        text = max(by_text, key=lambda each: by_text[each], default="")
        return text if text and by_text[text] > max(closed_m.sum() / 2.0, MOVES_M) else ""

    def _is_for_others(self, span: MotionSpan) -> bool:
        """Whether there was a manoeuvre, and not away from the person."""
        return span.manoeuvre not in ("", f"{DREW_BACK}{self.stay.person}")

    def _of_routes(self) -> str:
        left_s = self._left[1]
        begun_s = max(self._before_s, left_s)
        if dist(self._person(begun_s), self._person(self._nearest_s)) > MOVED_M:
            return f"{self.stay.person} moved while it was on its way"
        times = () if self.is_in_margin else (left_s, begun_s)
        reasons = [reason for t in times if (reason := self._of_route(t))]
        return next(
            (each for each in reasons if each != NO_ROUTE), reasons[0] if reasons else self._by_itself
        )

    @property
    def _by_itself(self) -> str:
        """That nothing else explains it, with where the robot went and who walked near it then."""
        to = next(
            (name for name, start_s, end_s in turns(self.episode.events) if self._is_in(start_s, end_s)), ""
        )
        way = f" on its way to {to}" if to and to != self.stay.person else ""
        walked = list(self._walked_near())
        return f"{BY_ITSELF}{way}{f', as {listed(walked)} walked near it' if walked else ''}"

    def _is_in(self, start_s: float, end_s: float) -> bool:
        return start_s <= self._nearest_s < end_s

    def _walked_near(self) -> Iterator[str]:
        """Who else walked and was near the robot just before it was nearest."""
        frames, begun_s = self.episode.frames, max(self._since_s, self._nearest_s - WALKED_S)
        rows = slice(int(np.searchsorted(frames.time_s, begun_s - TICK_S)), self.nearest + 1)
        robot = frames.of(self._robot_name)[rows, :2]
        for name in frames.entities[1:]:
            path = frames.of(name)[rows, :2]
            is_near = np.hypot(*(path - robot).T).min() <= NEAR_PEOPLE_M
            if name != self.stay.person and is_near and np.ptp(path, axis=0).max() > MOVED_M:
                yield name

    @property
    def _asked(self) -> str:
        """That the robot had asked the person to let it pass; empty if it had not."""
        person = self.stay.person
        asked = (act.t_start for act in self.episode.acts if act.act == ASK and act.person == person)
        is_asked = any(0.0 <= self._since_s - t <= ASKED_S for t in asked)
        return f"it had asked {person} to let it pass" if is_asked else ""

    @property
    def _robot_name(self) -> str:
        return self.episode.prepared.scene.robot.name

    @property
    def _since_s(self) -> float:
        return float(self.episode.frames.time_s[self.since])

    @property
    def _nearest_s(self) -> float:
        return float(self.episode.frames.time_s[self.nearest])

    @property
    def _gap_m(self) -> float:
        """The smallest gap [m]."""
        scene = self.episode.prepared.scene
        bodies_m = scene.robot.radius_m + scene.person(self.stay.person).radius_m
        return self._apart_m(self._nearest_s) - bodies_m

    @property
    def _before_s(self) -> float:
        return max(self.stay.start_s - BEFORE_S, 0.0)

    @property
    def _end_s(self) -> float:
        return self.stay.start_s + self.stay.length_s

    @property
    def _left(self) -> tuple[float, float, str]:
        """When the robot left the place where it last stood before it was nearest [s], and that place."""
        docked_s, person = max(
            (visit for visit in self._docked if visit[0] <= self._nearest_s), default=(0.0, "")
        )
        frames = self.episode.frames
        docked = int(np.searchsorted(frames.time_s, docked_s - TICK_S))
        path = frames.of(self._robot_name)[docked : self.nearest + 1, :2]
        stood = np.flatnonzero(np.hypot(*(path - path[0]).T) <= EDGE_M)
        left_s = float(frames.time_s[docked + int(stood[-1])])
        return docked_s, left_s, f"its place before {person}" if person else "where it started"

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
        return self._at(self._robot_name, t)

    def _closed_m(self, name: str, other: str) -> Numbers:
        """By how much one body came nearer to the other, tick by tick, until the robot was nearest [m]."""
        frames, ticks = self.episode.frames, slice(self.since, self.nearest + 1)
        here, there = frames.of(name)[ticks, :2], frames.of(other)[ticks, :2]
        apart = there - here
        towards = apart / np.maximum(np.hypot(apart[:, :1], apart[:, 1:]), 1e-9)
        return np.asarray((np.diff(here, axis=0) * (towards[1:] + towards[:-1]) / 2.0).sum(axis=1))

    def _apart_m(self, t: float) -> float:
        """Distance of the robot's centre from the person's [m]."""
        return dist(self._robot(t), self._person(t))

    def _of_route(self, t: float) -> str | None:
        """Why the route at that time led so near to the person, in words; None if it did not."""
        begun, frames = self.episode.prepared.scene, self.episode.frames
        goals = (span.goal for span in self.episode.motion if span.end_s > t + TICK_S)
        docked = (self._robot(at_s) for at_s, _ in self._docked if at_s > self._nearest_s)
        goal = next(chain(goals, docked), None)  # of a real robot only the places where it docked are known
        if goal is None:
            return None
        try:
            ways = RouteMap(scene_at(begun, frames, t, turns=self.episode.door_turns))
            start = self._robot(t)
            route, polite = ways.route(start, goal), ways.polite(start, goal)
        except SceneError:  # bodies overlap at that time, or the robot touched a wall
            return None
        if route is None:  # a person stood where the robot was to dock
            return NO_ROUTE
        if inside := self._of_space(ways, t, goal):
            return inside
        if polite is None:
            return "no route keeps clear of everybody"
        longer_m = polite.length_m - route.length_m
        longer = f"a route that keeps clear of everybody would be {longer_m:.1f} m longer"
        return longer if longer_m >= SAME_M else None

    def _of_space(self, ways: RouteMap, t: float, goal: XY) -> str:
        """The end of the route in the person's space, if routes may pass as near for its sake, in words."""
        inside = f"inside {self.stay.person}'s personal space"
        begins, ends = f"it went on from {self._left[2]}, {inside}", f"its goal lies {inside}"
        for end, text in ((self._robot(t), begins), (goal, ends)):
            shrunk = next(each for each in ways.spaces(end, end) if each.xy == self._person(t))
            if shrunk.own_m <= self._gap_m + FOLLOWS_M:
                return text
        return ""
