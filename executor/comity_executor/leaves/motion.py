"""What the leaves that move the base share: they take it, and watch how their command goes."""

from __future__ import annotations

from collections.abc import Collection

from comity_executor.memory.meeting import Meeting
from comity_executor.nodes.cause import Account
from comity_executor.nodes.fault import BASE, SENSORS, WAY, trouble_of
from comity_executor.nodes.leaf import Action
from comity_executor.robots.robot import Motion

IDLE = "idle"
STATES = (IDLE, "moving", "arrived", "blocked")
"""What a robot may say of its motion (see `Motion`)."""


class MotionError(Exception):
    """A robot says of its motion what it may not, or has lost the command."""


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
        self.commanded_s = 0.0
        self._was_accepted = False

    def begin(self) -> None:
        """Take the base and forget the last round; a subclass then gives its command."""
        self.meeting.drive.take(self)
        self._bindings = self.meeting.memory.bindings
        self._account = None
        self._blocked_since_s = None
        self.expect_motion()

    def expect_motion(self) -> None:
        """A command is given now; the base may take some time to accept it."""
        self.commanded_s, self._was_accepted = self.meeting.senses.now_s(), False

    def motion(self) -> Motion:
        """How the command goes.

        Raises:
            MotionError: The state is an unknown word, or the base has dropped the command.
        """
        motion = self.meeting.robot.motion()
        if motion.state not in STATES:
            raise MotionError(f"motion: expected one of {', '.join(STATES)}, got {motion.state!r}")
        if motion.state != IDLE:
            self._was_accepted = True
            return motion
        waited_s = self.meeting.senses.now_s() - self.commanded_s
        if self._was_accepted or waited_s >= self.meeting.limits.accept_s:
            after = f": {motion.text}" if motion.text else ""
            raise MotionError(f"the base is idle, it lost or never accepted its command{after}")
        return motion

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
        if before == self._bindings:
            return False
        self.expect_motion()  # whoever asks gives the command again
        return True

    def is_stuck(self, *, unasked: bool = False) -> bool:
        """Whether something has blocked the motion for longer than the limits' patience.

        Args:
            unasked: Whether somebody who blocks it counts, as nobody asks them to let the robot pass; else
                that is the business of `passing`.

        Raises:
            MotionError: As `motion` does.
        """
        motion = self.motion()
        if motion.state != "blocked" or (motion.blocked_by and not unasked):
            self._blocked_since_s = None
            return False
        now = self.meeting.senses.now_s()
        if self._blocked_since_s is None:
            self._blocked_since_s, self._blocked_by = now, self.trouble(WAY, SENSORS, BASE)
        text = f"blocked: {motion.text}" if motion.text else "blocked"
        self.say(Account(text, fault=self._blocked_by))
        return now - self._blocked_since_s >= self.meeting.limits.blocked_s
