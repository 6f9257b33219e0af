"""The motions of an agenda: to the location of an object, and a step away at the end."""

from __future__ import annotations

from dataclasses import replace

from py_trees.common import Status

from comity_executor.leaves.motion import MotionAction
from comity_executor.leaves.performing import Performing
from comity_executor.memory.task import Task
from comity_executor.memory.visit_context import POSE
from comity_executor.nodes.cause import Account
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Ports
from comity_executor.robots.carrier import PICK_UP
from comity_executor.robots.goals import ActGoal, MotionGoal, PlannedPose
from comity_fis.listing import with_verb

STEP_AWAY_M = 0.30
"""Distance that the robot adds by stepping away after a farewell [m] (our choice; we found no source)."""
STEPPED_M = 0.05
"""Tolerance within which the step away counts as done [m]."""


class GoTo(MotionAction):
    """Go to the object's location: the first part of Fetch."""

    def __init__(self, task: Task) -> None:
        assert task.fetch is not None  # only objects to hand over are fetched
        self._place = str(task.fetch.parameters["place"])
        node_id = NodeId("Go_to", (self._place,), task.person)
        super().__init__(node_id, task.meeting, reads=("asked", "in_vain"))
        self.provenance = task.fetch_provenance
        self._task = replace(task, meeting=self.meeting)

    @property
    def ports(self) -> Ports:
        """The location."""
        return {"place": self._place}

    def begin(self) -> None:
        """Set out."""
        super().begin()
        speed_m_s = self.meeting.limits.cruise_speed_m_s
        detour_m = self._task.detour_m
        self.go(MotionGoal("go_to", self._place, speed_m_s=speed_m_s, detour_m=detour_m))

    def step(self) -> Status:
        """SUCCESS at the location; FAILURE if stuck."""
        if self.is_stuck():
            return Status.FAILURE
        if self.motion().state != "succeeded":
            return Status.RUNNING
        self.say(Account(f"at {self._place}"))
        return Status.SUCCESS


class PickUp(Action):
    """Pick up the object: the second part of Fetch."""

    def __init__(self, task: Task) -> None:
        assert task.fetch is not None  # as above
        super().__init__(NodeId.of("Pick_up", *task.about), task.fetch_provenance)
        self._task = task.seen_by(self, reads=("performed", "handing_over"), of_visit=("values",))
        self._place = str(task.fetch.parameters["place"])
        self._performing = Performing(task.meeting.robot, task.meeting.senses)

    @property
    def ports(self) -> Ports:
        """The object and its location."""
        return {"thing": self._task.thing, "place": self._place}

    def begin(self) -> None:
        """Start picking up."""
        self._performing.begin(
            ActGoal(PICK_UP, self._place, thing=self._task.thing), self._task.meeting.values
        )

    def step(self) -> Status:
        """SUCCESS if the robot holds it, FAILURE if interrupted by another program."""
        self._performing.look()
        if self._performing.is_lost:
            return Status.FAILURE
        return Status.SUCCESS if self._performing.is_done and self._task.is_taken() else Status.RUNNING

    def end(self) -> None:
        """Abort picking up unless it is over."""
        self._performing.end()

    def explain(self) -> Account | None:
        """The object in the hands."""
        return Account(f"the robot holds {self._task.carrier.carried() or 'nothing'}")


class StepAway(MotionAction):
    """The end of Take_leave: back away from the person, facing them, at their preferred speed.

    If there is no room for it, for example because of a person behind the robot, or it takes longer than an
    act may, the visit ends where the robot stands: people are not asked to make way for so little.
    """

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of("Step_away", task.person), task.meeting, reads=POSE)
        self.provenance = task.provenance
        self._task = replace(task, memory=task.memory.seen_by(self, writes=("done_s",)), meeting=self.meeting)

    @property
    def ports(self) -> Ports:
        """The person, the distance and the speed."""
        meeting = self.meeting
        return {"person": meeting.person, "by_m": STEP_AWAY_M, "approach_speed": meeting.approach_speed_m_s}

    def begin(self) -> None:
        """Set out."""
        super().begin()
        meeting = self.meeting
        self._since_s = meeting.senses.now_s()
        self._distance_m = meeting.pose.distance_m + STEP_AWAY_M
        away = PlannedPose(self._distance_m, meeting.pose.bearing_deg)
        self.go(MotionGoal("dock", meeting.person, away, meeting.approach_speed_m_s))

    def step(self) -> Status:
        """SUCCESS if the robot is far enough away, or cannot move further."""
        meeting, patience_s = self.meeting, self.meeting.limits.act_timeout_s
        reading = meeting.senses.read(meeting.person)
        away = reading is not None and reading.distance_m >= self._distance_m - STEPPED_M
        if reading is not None and away:
            self.say(Account(f"distance {reading.distance_m:.2f} m", reading.distance_m, "approach_speed"))
        elif self.is_stuck(unasked=True):
            what = "no room to step away" if reading is not None else "nobody is seen to step away from"
            self.say(Account(f"{what}: {self._obstruction}"))
        elif meeting.senses.now_s() - self._since_s >= patience_s:
            self.say(Account(f"not away within {patience_s:g} s: {self._obstruction}"))
        else:
            return Status.RUNNING
        self._task.memory.done_s = meeting.senses.now_s()
        return Status.SUCCESS

    @property
    def _obstruction(self) -> str:
        """The obstruction, in words, with people's names, as the robot is not going to anybody."""
        motion = self.meeting.robot.motion()
        who = motion.blocked_by
        return f"{with_verb(who, 'is', 'are')} in the way" if who else motion.text
