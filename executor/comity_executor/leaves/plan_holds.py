"""`plan_holds?`: the first question of the Goal; a plan that is outdated makes the tree fail at once."""

from __future__ import annotations

from comity_executor.nodes.cause import Account
from comity_executor.nodes.leaf import Condition


class DoesPlanHold(Condition):
    """Does the plan still hold? It is for the planner to say that it does not (`outdated`)."""

    def __init__(self) -> None:
        super().__init__("plan_holds?")
        self.outdated: str | None = None
        """Why not, in words; None while it does."""

    def check(self) -> bool:
        """Whether nobody has said otherwise."""
        return self.outdated is None

    def explain(self) -> Account | None:
        """Why it does not."""
        return Account(self.outdated) if self.outdated else None
