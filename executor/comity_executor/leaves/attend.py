"""Attend_to: observe the person's reaction to the approach, and respect the distance they choose."""

from __future__ import annotations

from py_trees.common import Status

from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Ports
from comity_executor.robots.goals import PlannedPose, RelativePose, unverified
from comity_executor.robots.noticed import Noticed, noticed
from comity_executor.robots.robot import Reading
from comity_fis.learning.signals import SAID, SIGNALS

A_LITTLE_M = 0.10
"""Meaning of `a little closer` and `a little farther` [m] (our choice)."""
SETTLED_S = 1.5
"""Time after a signal in which the person may still be moving [s]."""


class AttendTo(Action):
    """Watch and listen for a few seconds; the visit stores the first signal, or that there was none.

    A person who moves has chosen a distance: the resulting pose becomes the one to hold, so that no gap is
    closed again uninvited. A person who asks gets a little of what they ask for. Both hold for the rest of
    the visit, even if the robot leaves and returns.
    """

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("Attend_to", meeting.person), meeting.reach_grounds)
        self._meeting = meeting.seen_by(
            self, reads=("reach", "values"), writes=("pose", "shown", "noticed", "attended")
        )
        self._first: Reading | None = None
        self._began_s = 0.0
        self._heard_before = 0

    @property
    def ports(self) -> Ports:
        """The person and the duration."""
        return {"person": self._meeting.person, "for_s": self._meeting.limits.attend_s}

    def begin(self) -> None:
        """Record the initial reading; an earlier signal of this visit remains valid."""
        meeting = self._meeting
        self._began_s = meeting.senses.now_s()
        self._first = None
        self._heard_before = len(meeting.robot.heard(meeting.person))

    def step(self) -> Status:
        """SUCCESS after the time for a reaction."""
        meeting = self._meeting
        now_s, reading = meeting.senses.now_s(), meeting.senses.read(meeting.person)
        if reading is not None:
            self._first = self._first or reading
            if meeting.memory.noticed is None:
                self._look(self._first, reading, now_s)
            else:
                self._follow(meeting.memory.noticed, reading, now_s)
        if now_s - self._began_s < meeting.limits.attend_s:
            return Status.RUNNING
        if meeting.memory.noticed is None and self._first is not None:
            meeting.memory.noticed = Noticed(now_s, "nothing", self._first.distance_m)
        meeting.memory.attended = True
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """The noticed signal."""
        seen = self._meeting.memory.noticed
        if seen is None:
            return None
        text = f"{self._meeting.person} {SAID[seen.kind]} at {seen.distance_m:.2f} m"
        return Account(text, seen.distance_m, "conversational_distance")

    def _look(self, first: Reading, now: Reading, now_s: float) -> None:
        meeting = self._meeting
        words = meeting.robot.heard(meeting.person)[self._heard_before :]
        meeting.memory.noticed = seen = noticed(first, now, words, now_s)
        if seen is None or seen.kind not in _FARTHER_M:
            return
        distance_m = max(now.distance_m + _FARTHER_M[seen.kind], meeting.limits.safety_floor_m)
        meeting.memory.pose = _moved(meeting.pose, distance_m, meeting.pose.bearing_deg)
        meeting.note_shown(distance_m)

    def _follow(self, seen: Noticed, now: Reading, now_s: float) -> None:
        """Update the pose while a person moves, until they have settled."""
        if seen.kind in _MOVES and now_s - seen.t <= SETTLED_S:
            self._meeting.memory.pose = _moved(self._meeting.pose, now.distance_m, now.bearing_deg)
            if seen.kind in _MOVES_TO:
                self._meeting.note_shown(now.distance_m)


def _moved(pose: RelativePose, distance_m: float, bearing_deg: float) -> PlannedPose:
    """The new pose of the robot, with the reason for the deviation."""
    return PlannedPose(distance_m, bearing_deg, pose.pose_free, pose.deviation_reason, unverified(pose))


_FARTHER_M = {"ask_farther": A_LITTLE_M, "ask_closer": -A_LITTLE_M}
_MOVES_TO = frozenset({"step_back", "lean_in"})
"""Signals that choose another distance; turning away does not."""
_MOVES = frozenset(SIGNALS) - _FARTHER_M.keys() - {"nothing"}
