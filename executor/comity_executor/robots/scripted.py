"""A minimal robot that implements the protocol: no physics and no map, only distances to people.

It is an example for connecting a real robot, and enough to try a plan's tree: it moves straight towards
people at the commanded speed, turns instantly, and does every act in a fixed time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from comity_executor.robots.capabilities import LONGEST_LEASE_S, CapabilityValues
from comity_executor.robots.carrier import HAND_OVER, PICK_UP
from comity_executor.robots.goals import (
    ActGoal,
    ActStatus,
    GoalId,
    MotionGoal,
    MotionStatus,
    PlannedPose,
    RelativePose,
)
from comity_executor.robots.robot import Words
from comity_fis.defuzzification.curve import Curve

CLOSE_M = 0.5
"""Remaining distance at which navigation succeeds [m]."""
BODIES_M = 0.45
"""Sum of the two body radii: centre distance minus distance [m]."""


@dataclass(frozen=True, slots=True)
class ScriptedReading:
    """The reading of a person, without error."""

    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    person_facing_error_deg: float
    speed_m_s: float
    stamp_s: float


class ScriptedRobot:
    """A robot simulated by numbers only; `step` advances its world.

    Args:
        people: Initial distance of each person, between the bodies [m].
        name: Name in the plan.
        step_s: Duration of a step [s].
        act_s: Duration of every utterance and gesture [s].
    """

    def __init__(
        self, people: Mapping[str, float], *, name: str = "robot", step_s: float = 0.1, act_s: float = 1.5
    ) -> None:
        self._name = name
        self._step_s = step_s
        self._act_steps = round(act_s / step_s)
        self._steps = 0
        self._away_m = dict(people)
        self._bearing_deg = dict.fromkeys(people, 0.0)
        self._goal: MotionGoal | None = None
        """The current goal; None once stopped."""
        self._goals = 0
        """Number of goals so far, which identifies the newest one."""
        self._renewed_s = 0.0
        """Time at which the goal was given or last renewed [s]."""
        self._speed_m_s = 0.0
        self._faces: str | None = None
        self._acts: list[ActGoal] = []
        """All acts so far, in order: the first is called `act 1`."""
        self._ends: list[int | None] = []
        """The step in which each act ends; None if it was stopped."""
        self.in_the_way: str | None = None
        """A person who blocks every path; set by the script."""
        self.emergency_stop: str | None = None
        """Why the emergency stop is pressed; None if it is not."""

    def step(self) -> None:
        """Advance time by one step."""
        self._steps += 1
        self._speed_m_s = 0.0
        if self.now_s() - self._renewed_s > self.capabilities.lease_s:
            self._goal = None  # the lease has expired
        goal = self._goal
        if goal is None or goal.pose is None or self.in_the_way or self.emergency_stop:
            return
        person, pose = goal.to, goal.pose
        rest_m = self._away_m[person] - pose.distance_m
        most_m = goal.speed_m_s * self._step_s
        stride_m = max(-most_m, min(most_m, rest_m))
        self._away_m[person] -= stride_m
        self._speed_m_s = abs(stride_m) / self._step_s
        if abs(rest_m) <= CLOSE_M:
            self._bearing_deg[person] = pose.bearing_deg

    @property
    def name(self) -> str:
        """Name in the plan."""
        return self._name

    @property
    def capabilities(self) -> CapabilityValues:
        """Exact and without latency."""
        return CapabilityValues(lease_s=LONGEST_LEASE_S)

    def now_s(self) -> float:
        """Number of steps times their duration [s]."""
        return self._steps * self._step_s

    def read(self, person: str) -> ScriptedReading | None:
        """The true reading; None for an unknown person."""
        if person not in self._away_m:
            return None
        away_m, bearing_deg = self._away_m[person], self._bearing_deg[person]
        return ScriptedReading(
            distance_m=away_m,
            centre_distance_m=away_m + BODIES_M,
            bearing_deg=bearing_deg,
            facing_error_deg=0.0 if self._faces == person else 180.0,
            person_facing_error_deg=abs(bearing_deg),
            speed_m_s=self._speed_m_s,
            stamp_s=self.now_s(),
        )

    def heard(self, person: str) -> Sequence[Words]:
        """Nothing: nobody speaks here."""
        return ()

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> RelativePose | None:
        """The target pose: there are no obstacles."""
        return PlannedPose(distance_m, bearing_deg)

    def go(self, goal: MotionGoal) -> GoalId:
        """Approach the person, or turn or reach a place instantly: it has no positions of places."""
        self._goal, self._faces, self._goals = goal, goal.to, self._goals + 1
        self._renewed_s = self.now_s()
        return self._goals

    def renew(self, goal: GoalId) -> None:
        """Record the time of renewal."""
        if goal == self._goals:
            self._renewed_s = self.now_s()

    def motion(self) -> MotionStatus:
        """Succeeded once the remaining path is short enough."""
        newest, goal = self._goals or None, self._goal
        if goal is None:
            return MotionStatus(newest, "stopped", stamp_s=self.now_s(), is_at_rest=True)
        if goal.pose is None:
            return MotionStatus(newest, "succeeded", stamp_s=self.now_s(), is_at_rest=True)
        rest_m = abs(self._away_m[goal.to] - goal.pose.distance_m)
        return MotionStatus(
            newest,
            "succeeded" if rest_m <= (CLOSE_M if goal.kind == "navigate" else 1e-9) else "running",
            f"{self.in_the_way} is in the way" if self.in_the_way else f"{rest_m:.2f} m to {goal.to}",
            stamp_s=self.now_s(),
            remaining_m=rest_m,
            is_blocked=self.in_the_way is not None,
            blocked_by=(self.in_the_way,) if self.in_the_way else (),
            is_at_rest=self._speed_m_s == 0.0,
        )

    def stop(self, goal: GoalId | None = None) -> None:
        """Stop at once, or abort an act."""
        if isinstance(goal, str):
            self._break_off(goal)
        elif goal in (None, self._goals):
            self._goal, self._speed_m_s = None, 0.0

    def emergency(self) -> str | bool:
        """What the script has set."""
        return self.emergency_stop or False

    def perform(self, act: ActGoal) -> GoalId:
        """Record when the act will be over."""
        self._acts.append(act)
        self._ends.append(self._steps + self._act_steps)
        return f"act {len(self._acts)}"

    def performance(self, act: GoalId) -> ActStatus:
        """Succeeded once its time is over."""
        end = self._ends[_place(act)]
        if end is None:
            return ActStatus(act, "stopped")
        return ActStatus(act, "succeeded" if self._steps >= end else "running")

    def carried(self) -> str | None:
        """The object picked up and not handed over."""
        held: str | None = None
        for act, end in zip(self._acts, self._ends, strict=True):
            if end is not None and self._steps >= end and act.act in (PICK_UP, HAND_OVER):
                held = act.thing if act.act == PICK_UP else None
        return held

    def _break_off(self, act: GoalId) -> None:
        if self.performance(act).state == "running":
            self._ends[_place(act)] = None


def _place(act: GoalId) -> int:
    """Index of the act in the list: `act 1` is the first."""
    return int(str(act).removeprefix("act ")) - 1
