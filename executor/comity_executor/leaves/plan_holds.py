"""`plan_holds?`: the first condition of the Goal; an outdated plan makes the tree fail at once."""

from __future__ import annotations

from comity_executor.memory.shared import SharedMemory
from comity_executor.nodes.cause import Account
from comity_executor.nodes.leaf import Condition


class DoesPlanHold(Condition):
    """Whether the plan is still valid, as decided by the planner."""

    def __init__(self, memory: SharedMemory) -> None:
        super().__init__("plan_holds?")
        self._memory = memory.seen_by(self, reads=("outdated",))

    def check(self) -> bool:
        """True unless the planner has invalidated the plan."""
        return self._memory.outdated is None

    def explain(self) -> Account | None:
        """Why the plan is invalid."""
        outdated = self._memory.outdated
        return Account(outdated) if outdated else None
