"""Give_up: end a visit that failed, so that the next person is still visited."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Parallel

from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.cause import Account, explains
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action


class GiveUp(Action):
    """SUCCESS at once: the failure is recorded, and `all_greeted?` reports it at the end.

    Args:
        meeting: Context of the visit.
        failed: The branch that failed before this leaf is reached.
    """

    def __init__(self, meeting: VisitContext, failed: Behaviour) -> None:
        super().__init__(NodeId.of("Give_up", meeting.person), meeting.reach_grounds)
        self._memory = meeting.memory.seen_by(self, writes=("given_up", "failure"))
        self._failed = failed

    def step(self) -> Status:
        """Record the reason."""
        self._memory.given_up = True
        self._memory.failure = why_failed(self._failed) or f"{self._failed.name} failed"
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """Why the visit failed."""
        return Account(self._memory.failure) if self._memory.failure else None


def why_failed(node: Behaviour) -> str | None:
    """The account of the deepest node that made a branch fail."""
    failed = [child for child in node.children if child.status == Status.FAILURE]
    if failed:
        # The first failure ends a parallel; a fallback fails with its last child.
        return why_failed(failed[0] if isinstance(node, Parallel) else failed[-1])
    account = node.account() if explains(node) else None
    return account.words if account else None
