"""An act of the robot as a leaf follows it: begun, asked for and stopped by its id."""

from __future__ import annotations

from dataclasses import replace

from comity_executor.robots.goals import LOST, ActGoal, GoalId
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import Senses
from comity_executor.robots.status import known_performance
from comity_executor.speech.other_parameters import other_parameters
from comity_fis.inference.value import Inference


class Performing:
    """One act at a time."""

    def __init__(self, robot: Robot, senses: Senses) -> None:
        self._robot = robot
        self._senses = senses
        self._state = ""
        self._is_in_doubt = False
        self.goal: GoalId | None = None
        """What the robot calls the act; None before it has begun."""

    def begin(self, act: ActGoal, values: Inference | None) -> None:
        """Have the robot begin, unless the act before, of which it could not say how it ended, was done.

        Args:
            act: What to do.
            values: The parameters of the person whom it is for.
        """
        if self._is_in_doubt:
            self.look()
            self._is_in_doubt = False
            if self.is_done:
                return
        self.goal, self._state = None, ""
        self._senses.require_fresh()
        self.goal = self._robot.perform(
            replace(act, parameters={**other_parameters(values), **act.parameters})
        )

    def look(self) -> None:
        """Ask the robot how the act goes.

        Raises:
            StateError: The state is an unknown word.
        """
        if self.goal is not None:
            self._state = known_performance(self._robot, self.goal).state

    def end(self) -> None:
        """Break the act off unless it is over; it may have ended since the last tick."""
        if self.goal is None or self.is_done:
            return
        try:
            self.look()
        except Exception:  # a robot that cannot say how the act goes is told to stop it
            self._is_in_doubt = True
        if not self.is_done:
            self._robot.stop(self.goal)

    @property
    def is_done(self) -> bool:
        """Whether it came to its end."""
        return self._state == "succeeded"

    @property
    def is_lost(self) -> bool:
        """Whether it was refused or broken off."""
        return self._state in LOST
