"""What the leaves that move the base share: they watch the motion, and stop the base when they end."""

from __future__ import annotations

from collections.abc import Collection

from comity_executor.memory.meeting import Meeting
from comity_executor.nodes.cause import Account
from comity_executor.nodes.fault import BASE, SENSORS, WAY, trouble_of
from comity_executor.nodes.leaf import Action


class MotionAction(Action):
    """A motion command under way.

    Args:
        verb: Names the node, together with the person.
        meeting: Whose branch it belongs to.
        reads: What it reads on the blackboard.
        writes: What it writes there, besides that it has the base.
    """

    def __init__(
        self,
        verb: str,
        meeting: Meeting,
        *,
        reads: Collection[str] = (),
        writes: Collection[str] = (),
    ) -> None:
        super().__init__(f"{verb}({meeting.person})", meeting.reach_grounds)
        self.meeting = meeting.seen_by(self, reads=("bindings", *reads), writes=("base", *writes))
        self._account: Account | None = None
        self._blocked_since_s: float | None = None
        self._blocked_by: str | None = None
        """The fault that was there when it was blocked; it may be over before patience is."""
        self._bindings = 0

    def begin(self) -> None:
        """Take the base and forget the last round; a subclass then gives its command."""
        self.meeting.drive.take(self)
        self._bindings = self.meeting.memory.bindings
        self._account = None
        self._blocked_since_s = None

    def end(self) -> None:
        """Stop the base, unless another leaf commands it already."""
        self.meeting.drive.release(self)

    def explain(self) -> Account | None:
        """What `say` left."""
        return self._account

    def say(self, account: Account) -> None:
        """Leave a word for the trace on how the step came out."""
        self._account = account

    def trouble(self, *parts: str) -> str | None:
        """What is wrong with the robot or its way, where it is with one of these parts."""
        return trouble_of(self.meeting.robot, *parts)

    def is_outdated(self) -> bool:
        """Whether the numbers that the command was given with are old; told once."""
        before, self._bindings = self._bindings, self.meeting.memory.bindings
        return before != self._bindings

    def is_stuck(self, *, unasked: bool = False) -> bool:
        """Whether something has blocked the motion for longer than the limits' patience.

        Args:
            unasked: Whether somebody who blocks it counts, as nobody asks them to let the robot pass; else
                that is the business of `passing`.
        """
        motion = self.meeting.robot.motion()
        if motion.state != "blocked" or (motion.blocked_by and not unasked):
            self._blocked_since_s = None
            return False
        now = self.meeting.senses.now_s()
        if self._blocked_since_s is None:
            self._blocked_since_s, self._blocked_by = now, self.trouble(WAY, SENSORS, BASE)
        text = f"blocked: {motion.text}" if motion.text else "blocked"
        self.say(Account(text, fault=self._blocked_by))
        return now - self._blocked_since_s >= self.meeting.limits.blocked_s
