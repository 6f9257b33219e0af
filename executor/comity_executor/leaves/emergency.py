"""The emergency stop: a guard above the goal that halts everything at once, and lets it go on when released.

    Safe ?
    |- Stop ->
    |  |- <> emergency?
    |  '- Stand_still           always RUNNING
    '- Goal

Goal is halted in the tick in which `emergency?` turns true, with all that runs below it: every leaf stops
what it began. When the stop is released Goal starts again, and as its conditions read the world and the
visits' memory, it goes on where it was: what was done is not done again.
"""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Selector, Sequence

from comity_executor.memory.drive import Drive
from comity_executor.memory.shared import SharedMemory
from comity_executor.nodes.cause import Account
from comity_executor.nodes.leaf import Action, Condition
from comity_executor.robots.pressed import is_false
from comity_executor.robots.robot import Robot
from comity_executor.robots.status import has_stopped


class EmergencyGuard(Selector):
    """Whatever it halts is halted by an emergency; halted itself, it leaves the base at rest.

    Args:
        goal: What is carried out while there is none.
        robot: It knows.
        memory: Where it stands who has its base.
    """

    def __init__(self, goal: Behaviour, robot: Robot, memory: SharedMemory) -> None:
        stop = Sequence("Stop", memory=False, children=[IsEmergency(robot), StandStill(robot, memory)])
        super().__init__("Safe", memory=False, children=[stop, goal])
        self._robot = robot

    def stop(self, new_status: Status = Status.INVALID) -> None:
        """Halted from above, stop the base: the tree commands it no more."""
        super().stop(new_status)
        if new_status is Status.INVALID:
            self._robot.stop()


class IsEmergency(Condition):
    """`emergency?`: only an explicit False is "not pressed"; a robot that cannot tell is in one."""

    if_it_raises = Status.SUCCESS

    def __init__(self, robot: Robot) -> None:
        super().__init__("emergency?")
        self._read = robot.emergency  # a robot without the call is refused here
        self._reason: str | None = None

    def check(self) -> bool:
        """Ask the robot."""
        try:
            said: object = self._read()
        except Exception as error:
            said = f"the emergency stop cannot be read: {type(error).__name__}: {error}"
        self._reason = None if is_false(said) else _in_words(said)
        return self._reason is not None

    def explain(self) -> Account | None:
        """Who or what stopped the robot."""
        return Account(self._reason) if self._reason else None


def _in_words(said: object) -> str:
    if isinstance(said, str) and said:
        return said
    return f"the emergency stop says {said!r}, and only False is not pressed"


class StandStill(Action):
    """Always RUNNING: the base is taken from the leaf that had it, and stays at rest.

    It never fails, so that nothing of the goal is ticked while the stop is pressed. The stop is commanded
    again in every tick until the base says that it has stopped, and whenever it no longer has.
    """

    def __init__(self, robot: Robot, memory: SharedMemory) -> None:
        super().__init__("Stand_still")
        self._robot = robot
        self._is_told = False
        self._drive = Drive(robot, memory.seen_by(self, writes=("base",)))

    def begin(self) -> None:
        """Whatever the base says, the first stop is still to come."""
        self._is_told = False

    def step(self) -> Status:
        """Stop, until the stop button is released."""
        if not (self._is_told and has_stopped(self._robot)):
            self._drive.stop(self)
            self._is_told = True
        return Status.RUNNING

    def update(self) -> Status:
        """Take a step; what raised is tried again in the next tick."""
        self._error = None
        super().update()
        return Status.RUNNING
