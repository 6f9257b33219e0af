"""A robot of one's own on a map: it glides, on a clock of its own, and logs every command."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from comity_executor import (
    ActGoal,
    ActStatus,
    CapabilityValues,
    GoalId,
    Localisation,
    MapGoal,
    MotionStatus,
    PersonTrack,
)

LEASE_S = 0.3
SCENARIO = """schema_version: 1
name: two
rulebook: bruno2017
adults_only: true
place: {width_m: 8, height_m: 6}
robot: {at_m: [1, 1]}
people:
  host: {at_m: [3.0, 3.0], facing_deg: 0, profile: german_man}
  guest: {at_m: [6.0, 3.0], facing_deg: 180, profile: arab_woman}
goals:
  - greet: host
  - greet: guest
"""


@dataclass
class Gliding:
    """It moves straight to the pose of its goal; what hinders it is set from outside."""

    people: dict[str, tuple[float, float, float]]
    """Where everybody is, x and y [m] and heading [deg]; a test moves them."""
    x: float = 1.0
    y: float = 1.0
    heading_rad: float = 0.0
    keeps_log: bool = True
    """Whether it keeps commands and its path; in hours they would grow."""
    latency_s: float = 0.0
    """A goal is taken up so much later."""
    t: float = 100.0
    pressed: str | bool = False
    knows_where: bool = True
    tells: Callable[[Localisation], Any] = lambda here: here
    """What it says of where it is."""
    tells_of_people: Callable[[list[PersonTrack]], Any] = lambda tracks: tracks
    """What it says of whom it sees."""
    tracks_people: bool = True
    dropped: set[str] = field(default_factory=set)
    """Whom the tracker does not see."""
    called: dict[str, str] = field(default_factory=dict)
    """Whom it takes for whom."""
    sure_of: dict[str, float | None] = field(default_factory=dict)
    """When it made sure last, by the name that it gives; who is not here is made sure of all the while."""
    velocity: dict[str, tuple[float, float]] = field(default_factory=dict)
    """Of people, in m/s, as the tracker says."""
    log: list[tuple[float, str, object]] = field(default_factory=list)
    """Time, command and what it was told."""
    path: list[tuple[float, float, float, float]] = field(default_factory=list)
    """Time, place and speed after every step."""
    _speed: float = 0.0
    _goals: int = 0
    _waiting: list[tuple[float, int, MapGoal]] = field(default_factory=list)
    _goal: MapGoal | None = None
    _newest: int | None = None
    _renewed_s: float = -math.inf
    _acts: list[float] = field(default_factory=list)
    _stamp_s: float = 100.0
    _tracked_s: float = 100.0

    @property
    def capabilities(self) -> CapabilityValues:
        return CapabilityValues(lease_s=LEASE_S, latency_s=self.latency_s)

    def now_s(self) -> float:
        return self.t

    def sleep(self, seconds: float) -> None:
        self.t += seconds
        while self._waiting and self._waiting[0][0] <= self.t:
            _, self._newest, self._goal = self._waiting.pop(0)
        self._speed = 0.0
        goal = self._goal
        if goal is not None and self.t - self._renewed_s <= LEASE_S + self.latency_s:
            gap_m = math.dist((self.x, self.y), (goal.x_m, goal.y_m))
            step_m = min(gap_m, goal.speed_m_s * seconds)
            if gap_m > 1e-9:
                self.x += step_m * (goal.x_m - self.x) / gap_m
                self.y += step_m * (goal.y_m - self.y) / gap_m
            self.heading_rad, self._speed = goal.heading_rad, step_m / seconds
        if self.keeps_log:
            self.path.append((self.t, self.x, self.y, self._speed))

    def localisation(self) -> Localisation | None:
        if self.knows_where:
            self._stamp_s = self.t
        return self.tells(Localisation(self.x, self.y, self.heading_rad, self._speed, self._stamp_s))

    def tracks(self) -> list[PersonTrack] | None:
        if not self.tracks_people:
            return None
        seen = [self._track(i, name) for i, name in enumerate(self.people) if name not in self.dropped]
        return self.tells_of_people(seen)

    def _track(self, i: int, name: str) -> PersonTrack:
        x, y, deg = self.people[name]
        called = self.called.get(name, name)
        return PersonTrack(
            i,
            x,
            y,
            self.t,
            math.radians(deg),
            self.velocity.get(name, (0.0, 0.0)),
            person=called,
            identified_s=self.sure_of.get(called, self.t),
        )

    def go(self, goal: MapGoal) -> GoalId:
        self._note("go", goal)
        self._goals += 1
        self._renewed_s = self.t
        if self.latency_s:
            self._waiting.append((self.t + self.latency_s, self._goals, goal))
        else:
            self._newest, self._goal = self._goals, goal
        return self._goals

    def renew(self, goal: GoalId) -> None:
        self._renewed_s = self.t

    def motion(self) -> MotionStatus:
        goal = self._goal
        if goal is None:
            return MotionStatus(self._newest, "stopped", stamp_s=self.t, is_at_rest=self._speed == 0.0)
        is_there = math.dist((self.x, self.y), (goal.x_m, goal.y_m)) < 1e-6
        state = "succeeded" if is_there else "running"
        return MotionStatus(self._newest, state, stamp_s=self.t, is_at_rest=self._speed == 0.0)

    def perform(self, act: ActGoal) -> GoalId:
        self._note("perform", act)
        self._acts.append(self.t + 1.0)
        return f"act {len(self._acts)}"

    def performance(self, act: GoalId) -> ActStatus:
        return ActStatus(act, "succeeded" if self.t >= self._acts[int(str(act)[4:]) - 1] else "running")

    def stop(self, goal: GoalId | None = None) -> None:
        self._note("stop", goal)
        if goal is None or goal == self._goals:
            self._goal, self._waiting, self._newest = None, [], self._goals or None

    def emergency(self) -> str | bool:
        return self.pressed

    def _note(self, command: str, what: object) -> None:
        if self.keeps_log:
            self.log.append((self.t, command, what))

    def told(self, command: str) -> list[object]:
        """All that one command was given."""
        return [what for _, each, what in self.log if each == command]

    def furthest_speed_m_s(self, person: str, within_m: float) -> float:
        """The fastest it was within so much of a person's body; bodies are 0.25 m and 0.2 m thick."""
        x, y, _ = self.people[person]
        near = (v for _, px, py, v in self.path if math.dist((px, py), (x, y)) - 0.45 <= within_m)
        return max(near, default=0.0)


def written(here: Path, text: str) -> str:
    """The path of a file that holds a scenario."""
    path = here / "two.scenario.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def gliding(**more: Any) -> Gliding:
    """A robot in the room of `SCENARIO`."""
    return Gliding({"host": (3.0, 3.0, 0.0), "guest": (6.0, 3.0, 180.0)}, **more)


def reaching() -> Gliding:
    """One that states how far it reaches as it waves."""
    robot = gliding()
    robot.gesture_reach_m = {"wave": 0.45}  # type: ignore[attr-defined]
    return robot
