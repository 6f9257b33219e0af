"""Trying again, a limited number of times."""

from __future__ import annotations

from py_trees import decorators
from py_trees.behaviour import Behaviour

from comity_executor.nodes.cause import Account, Grounds


class Retry(decorators.Retry):
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
        super().__init__(name, child, num_failures=attempts)
        self.grounds = grounds

    def account(self) -> Account | None:
        """How many attempts failed, if any."""
        if not self.failures:
            return None
        return Account(f"{self.failures} of {self.num_failures} attempts failed", float(self.failures))
