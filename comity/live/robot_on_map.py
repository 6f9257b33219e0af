"""Adapts a real robot to the protocol of tree and planner: distances and poses come from the map."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from comity.live.act_record import ActRecord
from comity.live.goals_on_map import GoalsOnMap
from comity.live.known_world import KnownWorld
from comity.live.margins_on_map import MarginsOnMap
from comity_executor.robots.status import known_performance
from comity_executor.robots.stop_button import is_false
from comity_sim2d import Wish

if TYPE_CHECKING:
    from comity.answers.run import Disturbance
    from comity.live.operator import Operator
    from comity_executor import (
        ActGoal,
        Capabilities,
        GoalId,
        GoalStatus,
        MapRobot,
        MotionGoal,
        MotionStatus,
        RelativePose,
        Words,
    )
    from comity_fis.defuzzification.curve import Curve
    from comity_sim2d import ActEvent, Person, Pose, Scene
    from comity_sim2d.robot.margins import MarginDecision
    from comity_sim2d.robot.motion import PersonEstimate


class RobotOnMap:
    """Implements the executor's `Robot`, and what the planner needs of the simulated robot.

    Args:
        base: The robot.
        scene: The map, people's positions at planning time, and the robot's body and speed.
        operator: The operator, who may hold the robot.
    """

    def __init__(self, base: MapRobot, scene: Scene, operator: Operator | None = None) -> None:
        self._base = base
        self._operator = operator
        self._known = KnownWorld(base, scene)
        self._margins = MarginsOnMap(base, self._known)
        self._goals = GoalsOnMap(base, self._known, self._has_to_stand, self._margins)
        self._record = ActRecord()

    def sense(self) -> None:
        """Update the robot's pose and the tracked people; called once per tick."""
        self._known.sense()

    @property
    def uncertain(self) -> frozenset[str]:
        """People whose identity is uncertain."""
        return self._known.uncertain

    @property
    def is_blind(self) -> str | None:
        """Why the robot knows too little to move (its pose, or people); None if it knows enough."""
        return self._known.is_blind

    @property
    def odd_readings(self) -> tuple[Disturbance, ...]:
        """Readings that suggest a mistake in the base's code."""
        return self._known.odd.notes

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Decisions on passing people at the reduced margin, in order."""
        return self._margins.decisions

    def _has_to_stand(self) -> str | None:
        """Why it must not move now: the operator holds it, or it is blind; None if it may."""
        return self._held or self._known.is_blind

    @property
    def _held(self) -> str | None:
        """Why the operator holds it; None if they do not."""
        held = self._operator.holds() if self._operator is not None else False
        return str(held) if held else None

    @property
    def name(self) -> str:
        """Name in the scenario."""
        return self._known.scene.robot.name

    @property
    def capabilities(self) -> Capabilities:
        """Capabilities of the base."""
        return self._base.capabilities

    def now_s(self) -> float:
        """Time since the start of the episode [s]."""
        return self._known.now_s()

    @property
    def pose(self) -> Pose:
        """The nearest collision-free pose to the last known one."""
        return self._known.pose

    @property
    def here(self) -> Pose:
        """The last known pose."""
        return self._known.here

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All acts so far."""
        return self._record.events

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario at their believed positions."""
        return self._known.people

    @property
    def missing(self) -> frozenset[str]:
        """People known to have left their last seen position."""
        return self._known.missing

    @property
    def walking(self) -> frozenset[str]:
        """People who are walking."""
        return self._known.walking

    def lost(self) -> dict[str, str]:
        """The missing, each with since when: the robot does not search for them."""
        return self._known.lost()

    def would_see(self, person: str) -> bool:
        """Always False: it does not turn to look for people."""
        return False

    def has_to_watch(self, person: str) -> bool:
        """Always False: the tracker's view is assumed not to depend on the robot's heading."""
        return False

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Set how a person wants the robot to pass them."""
        self._known.learn(person, distance_m=distance_m, speed_m_s=speed_m_s)

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Set the poses for fetching objects."""
        self._goals.places = dict(places)

    def carried(self) -> str | None:
        """The object that the robot reports to hold; None if it cannot tell."""
        carried = getattr(self._base, "carried", None)
        return carried() if carried else None

    def read(self, person: str) -> PersonEstimate | None:
        """Distances and angles to a tracked, or presumably present, person; None otherwise."""
        return self._known.read(person, told_m=self._goals.distances_m.get(person))

    def heard(self, person: str) -> Sequence[Words]:
        """What the robot understood of a person; empty without speech recognition."""
        heard = getattr(self._base, "heard", None)
        return heard(person) if heard else ()

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> RelativePose | None:
        """The target pose if it is free, else the most desirable free one, or None."""
        wish = Wish(person, distance_m, bearing_deg, distance_desirability, direction_desirability)
        return self._known.pose_for(wish)

    def go(self, goal: MotionGoal) -> int:
        """Start a goal once the robot may move; returns its number."""
        return self._goals.go(goal)

    def renew(self, goal: GoalId) -> None:
        """Renew the base's goal, or update its pose."""
        self._goals.renew(goal)

    def motion(self) -> MotionStatus:
        """The progress of the newest goal as reported by the base, with our number."""
        return self._goals.motion()

    def perform(self, act: ActGoal) -> str:
        """Start an act; returns our identifier. People of uncertain identity are not named."""
        if self._held:
            raise RuntimeError(self._held)  # retried once the operator releases the robot
        if self.uncertain:
            act = act.without(self.uncertain)
        return self._record.begin(act, self._base.perform(act), self.now_s())

    def performance(self, act: GoalId) -> GoalStatus:
        """The progress of an act."""
        status = known_performance(self._base, self._record.goal_of(act))
        if status.state == "succeeded" and (asked := self._record.asked_to_pass(act)) is not None:
            self._margins.note_asked(asked)
        return self._record.note(act, status, self.now_s())

    def stop(self, goal: GoalId | None = None) -> None:
        """End a goal or an act; None: stop the base, whatever it does."""
        if isinstance(goal, str):
            self._base.stop(self._record.goal_of(goal))
        else:
            self._goals.stop(goal)

    def emergency(self) -> str | bool:
        """The base's own stop."""
        return self._base.emergency()

    def stop_of(self, asked: Callable[[], object]) -> Callable[[], object]:
        """The stop for the execution: the base's own, or else the operator's.

        Args:
            asked: Returns the state of the base's own stop.
        """

        def read() -> object:
            said = asked()
            return self._operator.holds() if self._operator is not None and is_false(said) else said

        return read
