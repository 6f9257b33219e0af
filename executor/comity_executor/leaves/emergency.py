"""The emergency stop: a guard above the goal that halts everything at once.

    Safe ?
    |- Stop ->
    |  |- <> emergency?
    |  '- Stand_still           always RUNNING
    '- Goal

Goal is halted in the tick in which `emergency?` turns true, with its whole subtree: every leaf stops what it
started. A stop latches: it stays true after its release, until `Execution.resume`. Goal then starts again; as
its conditions read the world and the visits' memory, it continues where it was and repeats nothing.
"""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Selector, Sequence

from comity_executor.memory.drive import Drive
from comity_executor.memory.shared import SharedMemory
from comity_executor.nodes.cause import Account
from comity_executor.nodes.leaf import Action, Condition
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import Senses
from comity_executor.robots.status import has_stopped
from comity_executor.robots.stop_button import StopButton


class EmergencyGuard(Selector):
    """Halts the goal in an emergency; if halted itself, it stops the base.

    Args:
        goal: The subtree executed while there is no emergency.
        robot: The robot whose base is stopped.
        senses: The readings, including the stop.
        memory: Records which leaf holds the base.
    """

    def __init__(self, goal: Behaviour, robot: Robot, senses: Senses, memory: SharedMemory) -> None:
        stop = Sequence(
            "Stop",
            memory=False,
            children=[IsEmergency(senses.stop_button), StandStill(robot, senses, memory)],
        )
        super().__init__("Safe", memory=False, children=[stop, goal])
        self._robot = robot

    def stop(self, new_status: Status = Status.INVALID) -> None:
        """Stop the base when halted from above: the tree no longer commands it."""
        super().stop(new_status)
        if new_status is Status.INVALID:
            self._robot.stop()


class IsEmergency(Condition):
    """`emergency?`: was the robot's stop pressed, and not resumed since its release?"""

    if_it_raises = Status.SUCCESS

    def __init__(self, button: StopButton) -> None:
        super().__init__("emergency?")
        self._button = button

    def check(self) -> bool:
        """Use the stop as read at the start of the tick."""
        return self._button.reason is not None

    def explain(self) -> Account | None:
        """Who or what stopped the robot."""
        return Account(self._button.reason) if self._button.reason else None


class StandStill(Action):
    """Always RUNNING: takes the base from the leaf that held it, and keeps it at rest.

    It never fails, so that nothing below the goal is ticked during a stop. It commands the stop in every tick
    until the base reports that it has stopped, and whenever the base moves again.
    """

    def __init__(self, robot: Robot, senses: Senses, memory: SharedMemory) -> None:
        super().__init__("Stand_still")
        self._robot = robot
        self._senses = senses
        self._told_s: float | None = None
        """Time of the first stop command [s]."""
        self._drive = Drive(robot, memory.seen_by(self, writes=("base",)))

    def begin(self) -> None:
        """Reset, so that the first stop is commanded whatever the base reports."""
        self._told_s = None

    def step(self) -> Status:
        """Command the stop until the robot may continue."""
        if self._told_s is None or not has_stopped(self._robot, self._told_s):
            self._told_s = self._senses.now_s() if self._told_s is None else self._told_s
            self._drive.stop(self)
        return Status.RUNNING

    def update(self) -> Status:
        """Take a step; after an exception it is retried in the next tick."""
        self._error = None
        super().update()
        return Status.RUNNING
