"""Base class of the leaves that move the base: acquires it, and monitors the goal."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from comity_executor.memory.visit_context import DONE, VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.fault import BASE, SENSORS, WAY, trouble_of
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action
from comity_executor.robots.goals import DECLINED, LOST, GoalId, Motion, MotionGoal, MotionStatus
from comity_executor.robots.status import GoalLostError, known_motion
from comity_executor.speech.other_parameters import other_parameters


class MotionAction(Action):
    """A motion goal in execution.

    Args:
        node_id: The action and the person.
        meeting: Context of the visit.
        reads: Entries of the blackboard that it reads.
        writes: Entries that it writes, besides the holder of the base and a refusal by the person.
    """

    def __init__(
        self,
        node_id: NodeId,
        meeting: VisitContext,
        *,
        reads: Collection[str] = (),
        writes: Collection[str] = (),
    ) -> None:
        super().__init__(node_id, meeting.reach_grounds)
        self.meeting = meeting.seen_by(
            self, reads=("bindings", "values", *DONE, *reads), writes=("base", "declined", *writes)
        )
        self._account: Account | None = None
        self._blocked_since_s: float | None = None
        self._blocked_by: str | None = None
        """The fault present when the motion was blocked; it may end before `blocked_s` is over."""
        self._bindings = 0
        self._goal: GoalId | None = None
        self.commanded_s = 0.0

    def begin(self) -> None:
        """Reset the state; a subclass then sends its goal."""
        self._goal = None
        self._bindings = self.meeting.memory.bindings
        self._account = None
        self._blocked_since_s = None

    def go(self, goal: MotionGoal) -> None:
        """Send a goal to the base, which may take some time to accept it."""
        self.commanded_s, self._goal = self.meeting.senses.now_s(), None
        self.meeting.senses.require_fresh()
        others = other_parameters(self.meeting.values)
        self._goal = self.meeting.drive.go(self, replace(goal, parameters=others))

    def motion(self) -> Motion:
        """Progress of the goal.

        Raises:
            GoalLostError: If it will not be reached, the base never accepted it, or stopped reporting it.
            StateError: If the state is an unknown word.
        """
        motion, limits = known_motion(self.meeting.robot), self.meeting.limits
        now_s = self.meeting.senses.now_s()
        if motion.goal != self._goal or self._goal is None:
            if now_s - self.commanded_s < limits.accept_s:
                return MotionStatus(self._goal, "accepted", stamp_s=now_s)
            raise GoalLostError(f"the base has not taken its goal up within {limits.accept_s:g} s")
        if motion.state in LOST:
            after = f": {motion.text}" if motion.text else ""
            raise GoalLostError(f"the base says {motion.state} of its goal{after}")
        if (age_s := now_s - motion.stamp_s) > limits.feedback_s:
            raise GoalLostError(f"the base last spoke of its goal {age_s:.1f} s ago")
        return motion

    def explain(self) -> Account | None:
        """The explanation left by `say`."""
        return self._account

    def say(self, account: Account) -> None:
        """Store an explanation of the step's result for the trace."""
        self._account = account

    def trouble(self, *parts: str) -> str | None:
        """The fault of the robot or obstruction of its path, among these parts, or None."""
        return trouble_of(self.meeting.robot, *parts)

    def is_outdated(self) -> bool:
        """Whether the parameters of the goal are outdated; reported once."""
        before, self._bindings = self._bindings, self.meeting.memory.bindings
        return before != self._bindings

    def is_stuck(self, *, unasked: bool = False) -> bool:
        """Whether the motion has been blocked for longer than `blocked_s`, or was declined.

        Args:
            unasked: Whether blocking people count because no one asks them to make way; otherwise `passing`
                handles them.

        Raises:
            GoalLostError: As in `motion`.
        """
        motion = self.motion()
        if motion.state == DECLINED:
            self.meeting.memory.declined = motion.text  # `given_up?` ends the branch in the next tick
            self.say(Account(self.meeting.why or motion.text))
            return True
        if not motion.is_blocked or (motion.blocked_by and not unasked):
            self._blocked_since_s = None
            return False
        now = self.meeting.senses.now_s()
        if self._blocked_since_s is None:
            self._blocked_since_s, self._blocked_by = now, self.trouble(WAY, SENSORS, BASE)
        text = f"blocked: {motion.text}" if motion.text else "blocked"
        self.say(Account(text, fault=self._blocked_by))
        return now - self._blocked_since_s >= self.meeting.limits.blocked_s
