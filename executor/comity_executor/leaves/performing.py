"""An act of the robot as seen by a leaf: started, polled and stopped by its identifier."""

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
        """Identifier of the act; None before it starts."""

    def begin(self, act: ActGoal, values: Inference | None) -> None:
        """Start the act, unless the previous act, whose end was unknown, turns out to be done.

        Args:
            act: The act.
            values: The addressee's parameters.
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
        """Poll the progress of the act.

        Raises:
            StateError: The state is an unknown word.
        """
        if self.goal is not None:
            self._state = known_performance(self._robot, self.goal).state

    def end(self) -> None:
        """Abort the act unless it is over; it may have ended since the last tick."""
        if self.goal is None or self.is_done:
            return
        try:
            self.look()
        except Exception:  # a robot that cannot report the act's progress is told to stop it
            self._is_in_doubt = True
        if not self.is_done:
            self._robot.stop(self.goal)

    @property
    def is_done(self) -> bool:
        """Whether it was completed."""
        return self._state == "succeeded"

    @property
    def is_lost(self) -> bool:
        """Whether it was rejected or aborted."""
        return self._state in LOST
