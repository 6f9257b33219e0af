"""A real robot as the tree and the planner need it: distances, sides and docking poses come from the map."""

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
    """It has the form of the executor's `Robot`, and what the planner asks of the simulated one.

    Args:
        base: The robot.
        scene: The map, everybody where they were when the plan was made, and the robot's body and speed.
        operator: Who may hold it.
    """

    def __init__(self, base: MapRobot, scene: Scene, operator: Operator | None = None) -> None:
        self._base = base
        self._operator = operator
        self._known = KnownWorld(base, scene)
        self._margins = MarginsOnMap(base, self._known)
        self._goals = GoalsOnMap(base, self._known, self._has_to_stand, self._margins)
        self._record = ActRecord()

    def sense(self) -> None:
        """Take in where the robot is and whom it sees; to be called once in every tick."""
        self._known.sense()

    @property
    def uncertain(self) -> frozenset[str]:
        """Of whom it is not sure who they are."""
        return self._known.uncertain

    @property
    def is_blind(self) -> str | None:
        """Why it does not know enough to move: where it is, or who is there; None: it does."""
        return self._known.is_blind

    @property
    def odd_readings(self) -> tuple[Disturbance, ...]:
        """What it read of the base that looks like a mistake in the base's code."""
        return self._known.odd.notes

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Whether each person who let it pass is passed at the reduced margin, in order."""
        return self._margins.decisions

    def _has_to_stand(self) -> str | None:
        """Why it must not move for now: the operator holds it, or it is blind; None: it may."""
        return self._held or self._known.is_blind

    @property
    def _held(self) -> str | None:
        """Why the operator holds it; None: they do not."""
        held = self._operator.holds() if self._operator is not None else False
        return str(held) if held else None

    @property
    def name(self) -> str:
        """As in the scenario."""
        return self._known.scene.robot.name

    @property
    def capabilities(self) -> Capabilities:
        """The base's own."""
        return self._base.capabilities

    def now_s(self) -> float:
        """Seconds since the start of the episode."""
        return self._known.now_s()

    @property
    def pose(self) -> Pose:
        """Where it can be, near where it last knew to be."""
        return self._known.pose

    @property
    def here(self) -> Pose:
        """Where it last knew to be."""
        return self._known.here

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All that it said and did."""
        return self._record.events

    @property
    def people(self) -> tuple[Person, ...]:
        """All people of the scenario where it believes them to be."""
        return self._known.people

    @property
    def missing(self) -> frozenset[str]:
        """Who is known not to be where they were seen last."""
        return self._known.missing

    @property
    def walking(self) -> frozenset[str]:
        """Who is under way."""
        return self._known.walking

    def lost(self) -> dict[str, str]:
        """The missing, with since when: it does not go to look for them."""
        return self._known.lost()

    def would_see(self, person: str) -> bool:
        """Never: it does not turn to look for people."""
        return False

    def has_to_watch(self, person: str) -> bool:
        """Never: the tracker's view does not depend on where the robot looks, as far as is known."""
        return False

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Know how a person wants it to pass them."""
        self._known.learn(person, distance_m=distance_m, speed_m_s=speed_m_s)

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Know where to stand to fetch things."""
        self._goals.places = dict(places)

    def carried(self) -> str | None:
        """What the robot says that it holds; nothing where it cannot say."""
        carried = getattr(self._base, "carried", None)
        return carried() if carried else None

    def read(self, person: str) -> PersonEstimate | None:
        """Distances and angles to a person whom the tracker sees, or presumably; None otherwise."""
        return self._known.read(person, told_m=self._goals.distances_m.get(person))

    def heard(self, person: str) -> Sequence[Words]:
        """What the robot understood of a person; nothing where it has no ears."""
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
        """The wanted pose if the map and the people leave it free, else the most desirable one that is."""
        wish = Wish(person, distance_m, bearing_deg, distance_desirability, direction_desirability)
        return self._known.pose_for(wish)

    def go(self, goal: MotionGoal) -> int:
        """Set out for a goal, once the robot may move; its number."""
        return self._goals.go(goal)

    def renew(self, goal: GoalId) -> None:
        """Let the base go on, or tell it where the goal is by now."""
        self._goals.renew(goal)

    def motion(self) -> MotionStatus:
        """How the newest goal goes, as the base says, by the number that it has here."""
        return self._goals.motion()

    def perform(self, act: ActGoal) -> str:
        """Begin an act; what it is called here. Nobody is named of whom it is not sure who they are."""
        if self._held:
            raise RuntimeError(self._held)  # it is tried again once the operator lets it
        if self.uncertain:
            act = act.without(self.uncertain)
        return self._record.begin(act, self._base.perform(act), self.now_s())

    def performance(self, act: GoalId) -> GoalStatus:
        """How an act goes."""
        status = known_performance(self._base, self._record.goal_of(act))
        if status.state == "succeeded" and (asked := self._record.asked_to_pass(act)) is not None:
            self._margins.note_asked(asked)
        return self._record.note(act, status, self.now_s())

    def stop(self, goal: GoalId | None = None) -> None:
        """End a goal, an act, or whatever the base does."""
        if isinstance(goal, str):
            self._base.stop(self._record.goal_of(goal))
        else:
            self._goals.stop(goal)

    def emergency(self) -> str | bool:
        """The base's own stop."""
        return self._base.emergency()

    def stop_of(self, asked: Callable[[], object]) -> Callable[[], object]:
        """The stop as the execution reads it: the operator's, where the base's own is not pressed.

        Args:
            asked: Says what the base's own is.
        """

        def read() -> object:
            said = asked()
            return self._operator.holds() if self._operator is not None and is_false(said) else said

        return read
