"""Sends the tree's goals to a base as poses on the map.

A pose next to a person moves along with them. If it has moved by more than `FOLLOW_M`, or the robot comes
near and has to slow down, the base receives a new goal that replaces the previous one; for the tree it
remains one goal. Goals are renewed only while the robot may move, so that a base that has lost its pose or
its tracks stops by itself; it is also commanded to stop.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import dist, inf, pi
from typing import TYPE_CHECKING

from comity_executor import MapGoal, MotionStatus
from comity_executor.robots.status import known_motion
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import RouteMap, wrap_angle
from comity_sim2d.base.drive import NEAR_PEOPLE_M, NEAR_PEOPLE_M_S, REDUCED_M_S
from comity_sim2d.navigation.docking import spot_beside
from comity_sim2d.pose import direction_to
from comity_sim2d.robot.obstructing_people import in_the_way

if TYPE_CHECKING:
    from comity.live.known_world import KnownWorld
    from comity.live.margins_on_map import MarginsOnMap
    from comity_executor import GoalId, MapRobot, Motion, MotionGoal
    from comity_sim2d import Person, Pose

FOLLOW_M, FOLLOW_RAD = 0.05, 5.0 * pi / 180.0
"""Motion of a pose, in position [m] and heading [rad], after which it is sent again (our choice)."""


class GoalsOnMap:
    """The motion goals of one robot, with their own numbers.

    Args:
        base: The robot.
        known: The robot's knowledge of the world.
        stands: Returns why the robot must not move now; None if it may.
        margins: The margin to keep from each person.
    """

    def __init__(
        self, base: MapRobot, known: KnownWorld, stands: Callable[[], str | None], margins: MarginsOnMap
    ) -> None:
        self._base = base
        self._margins = margins
        self._waits_for: tuple[str, ...] = ()
        """The people who blocked the robot at the last check."""
        self._known = known
        self._stands = stands
        self.places: Mapping[str, Pose] = {}
        """Poses for fetching objects, by place."""
        self.distances_m: dict[str, float] = {}
        """Last commanded distance from each person [m]."""
        self._goal: MotionGoal | None = None
        """The newest goal; None after a stop."""
        self._goals = 0
        """Number of goals so far."""
        self._told: MapGoal | None = None
        """The last goal sent to the base; None while it is to stand."""
        self._told_for = 0
        """Number of the tree's goal that it was sent for."""
        self._base_goals: list[GoalId] = []
        """The base's identifiers for the tree's goal, the newest last."""

    def go(self, goal: MotionGoal) -> int:
        """Start a goal once the robot may move; returns its number."""
        self._goal, self._goals = goal, self._goals + 1
        if goal.pose is not None:
            self.distances_m[goal.to] = goal.pose.distance_m
        self._mind_margins(goal, ())
        self._go_on(self._base_goals[-1:])
        return self._goals

    def renew(self, goal: GoalId) -> None:
        """Renew the base's goal, or update its pose."""
        if goal != self._goals or self._goal is None:
            return
        self._mind_margins(self._goal, self._waits_for)
        if self._stands() or self._told is None or _differs(self._told, self._pose_of(self._goal)):
            self._go_on(self._base_goals)
        else:
            self._base.renew(self._base_goals[-1])

    def _mind_margins(self, goal: MotionGoal, blocked_by: tuple[str, ...]) -> None:
        """Update the people that the robot may pass at a reduced margin."""
        if goal.pose is None and goal.kind != "go_to":
            return  # the robot turns on the spot
        keep = {} if goal.pose is None else {goal.to: goal.pose.distance_m}

        def keeps_all() -> bool:
            ways = RouteMap(self._known.around_at_full_margin)
            return ways.reaches(self._known.pose.xy, self._pose_xy(goal), keep=keep)

        self._margins.look(goal.to, blocked_by, keeps_all)

    def stop(self, goal: GoalId | None) -> None:
        """End the goal if it is the newest; None: stop the base, whatever it does."""
        if goal is None:
            self._goal = self._told = None
            self._base.stop()
        elif goal == self._goals:
            self._goal = self._told = None
            if self._base_goals:
                self._base.stop(self._base_goals[-1])

    def _go_on(self, before: Sequence[GoalId]) -> None:
        """Send the current goal pose to the base, or stop it if pose or tracks are unknown.

        Args:
            before: The base's identifiers for the goal that continues, the newest last.
        """
        assert self._goal is not None
        if self._stands():
            if self._told is not None:
                self._base.stop(before[-1])
            self._told, self._base_goals = None, []
            return
        is_new = self._told_for != self._goals
        self._told, self._told_for = self._pose_of(self._goal), self._goals
        self._base_goals = [*([] if is_new else before), self._base.go(self._told)]

    def motion(self) -> MotionStatus:
        """The progress of the newest goal as reported by the base, with our number."""
        said = known_motion(self._base)
        if self._goal is not None and self._told is None:
            return self._waiting(said)
        state, number = said.state, self._number_of(said.goal)
        if self._base_goals and said.goal in self._base_goals[:-1]:
            state = "running"  # the base has not accepted the replacement yet
        if self._goal is None and state == "succeeded":
            state = "stopped"  # it has ended, and there is no other goal
        self._waits_for = self._blocked_by(said)
        return MotionStatus(
            number,
            state,  # type: ignore[arg-type]  # the tree refuses other words
            said.text,
            stamp_s=self._known.own_time_s(said.stamp_s),
            remaining_m=said.remaining_m,
            is_blocked=said.is_blocked,
            blocked_by=self._waits_for,
            is_at_rest=said.is_at_rest,
        )

    def _waiting(self, said: Motion) -> MotionStatus:
        """The progress of a goal that was not sent to the base yet."""
        self._waits_for = ()
        return MotionStatus(
            self._goals,
            "accepted",
            self._stands() or "",
            stamp_s=self._known.now_s(),
            is_blocked=True,
            is_at_rest=said.is_at_rest,
        )

    def _number_of(self, goal: GoalId | None) -> int | None:
        """Our number for a goal of the base: the newest one or an earlier one."""
        if goal is None or not self._goals:
            return None
        return self._goals if goal in self._base_goals else self._goals - 1 or None

    def _pose_of(self, goal: MotionGoal) -> MapGoal:
        here, speed_m_s = self._known.pose, min(goal.speed_m_s, self._known.scene.robot.max_speed_m_s)
        passages = self._margins.passages
        if goal.kind == "go_to":
            there = self.places[goal.to]
            pose = (there.x_m, there.y_m, there.heading_rad)
            speed_m_s = self._near_people_m_s(speed_m_s) if passages else speed_m_s
            return MapGoal("go_to", goal.to, *pose, speed_m_s, goal.parameters, passages)
        person = self._known.person(goal.to)
        xy = (
            here.xy if goal.pose is None else spot_beside(person, self._known.scene.robot.radius_m, goal.pose)
        )
        if self._is_near(person, speed_m_s):
            speed_m_s = min(speed_m_s, goal.near_m_s)
        speed_m_s = self._near_people_m_s(speed_m_s)
        turned = direction_to(xy, person.xy)
        return MapGoal(goal.kind, goal.to, *xy, turned, speed_m_s, goal.parameters, passages)

    def _near_people_m_s(self, speed_m_s: float) -> float:
        """The speed, limited by what people nearby allow [m/s]."""
        for other in self._known.bodies:
            if self._is_near(other, speed_m_s):
                allowed_m_s = other.approach_speed_m_s or NEAR_PEOPLE_M_S
                reduced = other.margin_m < PERSON_MARGIN_M
                speed_m_s = min(speed_m_s, allowed_m_s, REDUCED_M_S if reduced else inf)
        return speed_m_s

    def _is_near(self, person: Person, speed_m_s: float) -> bool:
        """Whether the robot is so near a person that it must start to slow down for them."""
        can = self._base.capabilities
        ahead_m = speed_m_s * can.latency_s + speed_m_s**2 / (2.0 * can.braking_m_s2) + FOLLOW_M
        gap_m = dist(self._known.here.xy, person.xy) - self._known.scene.robot.radius_m - person.radius_m
        return gap_m <= NEAR_PEOPLE_M + ahead_m

    def _blocked_by(self, said: Motion) -> tuple[str, ...]:
        """The obstructing people; taken from the map if the base does not name them."""
        goal = self._goal
        if not said.is_blocked or said.blocked_by or goal is None or goal.pose is None:
            return tuple(said.blocked_by)
        found = in_the_way(
            RouteMap(self._known.around),
            self._known.pose.xy,
            self._pose_xy(goal),
            visited=goal.to,
            keep_m=goal.pose.distance_m,
            detour_m=goal.detour_m,
        )
        return tuple(name for name in found.people if name in self._known.names) if found else ()

    def _pose_xy(self, goal: MotionGoal) -> tuple[float, float]:
        there = self._pose_of(goal)
        return there.x_m, there.y_m


def _differs(told: MapGoal, wanted: MapGoal) -> bool:
    moved_m = dist((told.x_m, told.y_m), (wanted.x_m, wanted.y_m))
    turned_rad = abs(wrap_angle(told.heading_rad - wanted.heading_rad))
    is_elsewhere = moved_m > FOLLOW_M or turned_rad > FOLLOW_RAD
    means = (wanted.speed_m_s, wanted.parameters, wanted.passages)
    return is_elsewhere or (told.speed_m_s, told.parameters, told.passages) != means
