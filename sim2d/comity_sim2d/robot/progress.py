"""Progress of an approach: arrived, blocked or coming nearer, as a state and in words."""

from __future__ import annotations

import math

from comity_sim2d.base.base import Base
from comity_sim2d.base.physics import Physics, foresee
from comity_sim2d.clock import Clock
from comity_sim2d.robot.approach import AT_PLACE, Approach, MovingTarget
from comity_sim2d.robot.motion import MotionProgress, blocked
from comity_sim2d.robot.obstructing_people import ARRIVED_M, ObstructingPeople
from comity_sim2d.robot.walkers_met import goes_along
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.senses.sensing import SensedPeople

CLOSE_M = 1.2
"""Remaining path at which navigation has arrived [m]; docking does the rest, at the person's own approach
speed. Our choice: long enough for that speed to be felt, too short to crawl through a hall."""
DOCKED_M, DOCKED_RAD, DOCKED_M_S = 0.001, math.radians(0.5), 0.01
"""Tolerances for docking: distance [m], angle [rad] and relative speed [m/s] (plus sensor noise)."""
LEFT_M = 0.02
"""Distance of its pose at which a docked robot counts as moving again [m]."""
BESIDE_M = 0.05
"""An object nearer than this to a robot without progress is named [m]."""


class ApproachProgress:
    """Assesses one robot's approaches.

    Args:
        spec: The robot's body.
        physics: Its true pose.
        senses: Believed positions of people.
        clock: Simulated time.
    """

    def __init__(self, spec: RobotBody, physics: Physics, senses: SensedPeople, clock: Clock) -> None:
        self._spec = spec
        self._physics = physics
        self._senses = senses
        self._clock = clock

    def of(
        self,
        approach: Approach,
        goal: MovingTarget,
        turn_rad: float,
        *,
        held_up_by: ObstructingPeople | None,
        docks: bool,
        was: MotionProgress,
        plan: FloorPlan,
    ) -> MotionProgress:
        """The progress of an approach; the progress watch restarts when blocked or arrived.

        Args:
            approach: The approach.
            goal: Its target.
            turn_rad: The remaining turn [rad].
            held_up_by: The obstructing people.
            docks: Whether it leads onto the docking pose, or only near it.
            was: The progress one tick ago.
            plan: The static obstacles around the robot.
        """
        now_s, left_m = self._clock.now_s, approach.remaining_m
        if held_up_by is not None:
            approach.restart_watch(now_s)
            waits = not approach.has_route or left_m <= ARRIVED_M
            return self._held_up(held_up_by, approach.person, waits=waits)
        if not approach.has_route:
            text = self._without_route(approach)
            return MotionProgress("running", text) if self._walks(approach) else blocked(text)
        if self._is_there(approach, goal, turn_rad, docks=docks, was=was):
            approach.restart_watch(now_s)
            return MotionProgress("succeeded", f"{'docked' if docks else 'close'} to {self._whom(approach)}")
        if approach.gives_way_to and not approach.stalled(now_s, left_m):
            return MotionProgress("running", f"giving way to {approach.gives_way_to}")
        if approach.stalled(now_s, left_m + 0.1 * abs(turn_rad)) and not self._goes_along(approach):
            return blocked(f"no progress towards {approach.person} for 3 s{self._beside(plan)}")
        return MotionProgress("running", f"{left_m:.2f} m of way left to {self._whom(approach)}")

    def of_facing(self, person: str, turn_rad: float, base: Base, was: MotionProgress) -> MotionProgress:
        """The progress of turning to a person; unchanged until the robot faces them."""
        if abs(turn_rad) <= DOCKED_RAD and base.speed_m_s <= DOCKED_M_S:
            return MotionProgress("succeeded", f"facing {person}")
        return was

    def _walks(self, approach: Approach) -> bool:
        """Whether the approached person walks: without a route now, there may be one later."""
        return approach.pose is not AT_PLACE and self._senses.walks(approach.person)

    def _goes_along(self, approach: Approach) -> bool:
        """Whether it accompanies a walking person, whose turns swing the goal away from it."""
        return self._walks(approach) and goes_along(self._spec, self._senses.person(approach.person))

    def _without_route(self, approach: Approach) -> str:
        if approach.pose is AT_PLACE:
            return f"no route to {approach.person}"
        pose, whom = approach.pose, self._whom(approach)
        return f"no route to {pose.distance_m:.2f} m from {whom} at {pose.bearing_deg:.0f} deg"

    def _whom(self, approach: Approach) -> str:
        """The goal in words: a person out of view may be elsewhere."""
        if approach.pose is AT_PLACE or self._senses.sees(approach.person):
            return approach.person
        reach_m, apart_m = self._spec.sensor.range_m, approach.pose.distance_m + self._spec.radius_m
        blind = (
            f", {apart_m:.2f} m away, where its sensor sees {reach_m:g} m far" if apart_m > reach_m else ""
        )
        return f"where {approach.person} was last known to be{blind}"

    def _held_up(self, by: ObstructingPeople, to: str, *, waits: bool) -> MotionProgress:
        """The progress with obstructing people; a walking visited person may turn round without a request."""
        if to not in by.people:
            text = f"{by.words} in the way to {to}"
            return blocked(text, by.people) if waits else MotionProgress("running", text)
        text = f"no way past {to} to before {to}"
        return blocked(text) if waits and not self._senses.walks(to) else MotionProgress("running", text)

    def _beside(self, plan: FloorPlan) -> str:
        """The object right next to the robot, as the end of a sentence; empty if there is none."""
        thing = plan.blocker(self._physics.pose.xy, self._spec.radius_m + BESIDE_M)
        return "" if thing is None else f", {100 * (thing.gap_m + BESIDE_M):.0f} cm from {thing.name}"

    def _is_there(
        self, approach: Approach, goal: MovingTarget, turn_rad: float, *, docks: bool, was: MotionProgress
    ) -> bool:
        if not docks:
            return approach.remaining_m <= CLOSE_M
        body = foresee(self._physics.pose, self._physics.twist, self._physics.step_s)
        gap = math.dist(body.xy, goal.xy)
        if was.state == "succeeded":
            return gap <= LEFT_M + self._senses.noise_m
        drift = math.dist(self._physics.twist.xy, goal.velocity)
        noise = 0.3 * self._senses.noise_m
        return (
            (approach.settled or gap <= DOCKED_M + noise)
            and abs(turn_rad) <= DOCKED_RAD + noise
            and drift <= DOCKED_M_S + noise
        )
