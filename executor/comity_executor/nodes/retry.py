"""Trying again, a limited number of times."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

from comity_executor.nodes.cause import Account, Grounds


class Retry(Decorator):
    """RUNNING after a failure, with the next attempt in the next tick; FAILURE after the last attempt.

    Args:
        name: The decorator's name.
        child: What is attempted.
        attempts: How often at most, the first time included.
        grounds: The plan step that the child carries out.
    """

    def __init__(self, name: str, child: Behaviour, *, attempts: int, grounds: Grounds | None = None) -> None:
        if attempts < 1:
            raise ValueError(f"{name} needs at least one attempt, got {attempts}")
        super().__init__(name, child)
        self.grounds = grounds
        self.attempts = attempts
        self._failures = 0

    def initialise(self) -> None:
        """Forget the failures of the last round."""
        self._failures = 0

    def update(self) -> Status:
        """Count a failure, pass on everything else."""
        if self.decorated.status != Status.FAILURE:
            return self.decorated.status
        self._failures += 1
        return Status.RUNNING if self._failures < self.attempts else Status.FAILURE

    def account(self) -> Account | None:
        """How many attempts failed, if any."""
        if not self._failures:
            return None
        return Account(f"{self._failures} of {self.attempts} attempts failed", float(self._failures))
