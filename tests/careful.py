"""A robot of one's own that keeps its margins by itself, in a corridor in which Anna stands before Bert.

It glides along a straight line, and waits before people that it may not pass. Anna answers when it asks.
"""

from __future__ import annotations

import math
import threading
import time
from dataclasses import dataclass, field
from typing import Any, Literal

from gliding import LEASE_S, Gliding

from comity_executor import ActGoal, CapabilityValues, GoalId, MarginStatement, MotionStatus, PersonTrack
from comity_sim2d import Said

FULL_M, WAITS_M = 0.30, 1.0
BODIES_M = 0.45
MIDDLE_M, ASIDE_M, LANE_M = 0.635, 0.25, 0.95
"""Across the corridor: where Anna stands at first, where she stands aside, and the robot's line [m]."""
STATED = MarginStatement(latency_s=0.15, braking_m_s2=0.8, tracker_sd_m=0.004, path_sd_m=0.003)
"""The least margin is 0.15 + 0.2 x 0.15 + 0.04 / 1.6 + 2 x 0.005 = 0.215 m."""
FIT = "{name: Anna, age: 40, hearing: good, sight: good, mobility: full}"


def corridor(*, profile: str = FIT, margin: str = ", margin_m: 0.24", more: str = "") -> str:
    """The scenario."""
    return f"""\
schema_version: 1
name: corridor
adults_only: true
place: {{width_m: 10, height_m: 1.27}}
robot: {{at_m: [0.6, {LANE_M}]{margin}}}
people:
  anna: {{at_m: [4, {MIDDLE_M}], facing_deg: 180, profile: {profile}}}
  bert: {{at_m: [8, {LANE_M}], facing_deg: 180}}
goals: [{{greet: bert}}]
limits: {{time_s: 60}}
{more}"""


@dataclass
class Careful(Gliding):
    """It takes goals with a margin, where it states what that depends on."""

    people: dict[str, tuple[float, float, float]] = field(
        default_factory=lambda: {"anna": (4.0, MIDDLE_M, 180.0), "bert": (8.0, LANE_M, 180.0)}
    )
    x: float = 0.6
    y: float = LANE_M
    stated: Any = STATED
    answer: Literal["steps aside", "says yes", "is silent"] = "steps aside"
    faces: bool = True
    """Whether its tracker knows where people face."""
    said: list[Said] = field(default_factory=list)
    least_m: float = math.inf
    """The least gap to Anna so far."""
    _answers_s: float = math.inf
    _holds: bool = False

    @property
    def capabilities(self) -> CapabilityValues:
        return CapabilityValues(lease_s=LEASE_S, latency_s=self.latency_s, reduced_margin=self.stated)

    def sleep(self, seconds: float) -> None:
        goal = self._goal
        self._holds = goal is not None and any(map(self._may_not_pass, self.people))
        if self._holds:
            self._goal = None
        super().sleep(seconds)
        if self._holds and self._goal is None:
            self._goal = goal
        self.least_m = min(self.least_m, self._gap_m("anna"))
        if self.t >= self._answers_s:
            self._answers_s = math.inf
            self._answer()

    def _answer(self) -> None:
        if self.answer == "says yes":
            self.said.append(Said(self.t, "anna", "yes, please go ahead."))
        if self.answer == "steps aside":
            self.people["anna"] = (4.0, ASIDE_M, math.degrees(math.atan2(self.y - ASIDE_M, self.x - 4.0)))

    def _gap_m(self, name: str) -> float:
        return math.dist((self.x, self.y), self.people[name][:2]) - BODIES_M

    def _may_not_pass(self, name: str) -> bool:
        goal, (x, y, _) = self._goal, self.people[name]
        if goal is None or name == goal.to or self._gap_m(name) > WAITS_M or self.x > x:
            return False
        allowed = [one for one in goal.passages if one.person == name]
        margin_m = min((one.margin_m for one in allowed), default=FULL_M)
        return abs(y - self.y) - BODIES_M < margin_m

    def motion(self) -> MotionStatus:
        if not self._holds:
            return super().motion()
        return MotionStatus(
            self._newest, "running", "waiting", stamp_s=self.t, is_blocked=True, is_at_rest=True
        )

    def _track(self, i: int, name: str) -> PersonTrack:
        track = super()._track(i, name)
        return track if self.faces else PersonTrack(**{**_fields(track), "heading_rad": None})

    def perform(self, act: ActGoal) -> GoalId:
        if act.act == "ask_to_pass":
            self._answers_s = self.t + 1.7
        return super().perform(act)

    def heard(self, person: str) -> list[Said]:
        return [words for words in self.said if words.person == person]


def _fields(track: PersonTrack) -> dict[str, Any]:
    return {name: getattr(track, name) for name in PersonTrack.__slots__}


class OldAdapter(Careful):
    """Written before goals had a margin."""

    @property
    def capabilities(self) -> CapabilityValues:
        return CapabilityValues(lease_s=LEASE_S, latency_s=self.latency_s)


class InRealTime:
    """The careful robot, stepped by a thread of its own, without a lease: a `Watchdog` stops it."""

    def __init__(self) -> None:
        self._robot = Careful(t=time.monotonic())
        threading.Thread(target=self._live, daemon=True).start()

    def _live(self) -> None:
        while True:
            time.sleep(0.02)
            self._robot.renew("")
            self._robot.sleep(time.monotonic() - self._robot.t)

    def __getattr__(self, name: str) -> Any:
        if name == "sleep":
            raise AttributeError(name)
        return getattr(self._robot, name)
