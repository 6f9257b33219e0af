"""Trying again, a limited number of times."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from py_trees import decorators
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.nodes.cause import Account, Provenance
from comity_executor.nodes.identity import NodeId, as_id
from comity_executor.nodes.leaf import Action
from comity_executor.nodes.node import preorder


class Retry(decorators.Retry):
    """RUNNING after a failure, with the next attempt in the next tick; FAILURE after the last attempt.

    An attempt that an exception ended is followed by a pause: a service that restarts raises in every tick,
    and would use up all attempts within two.

    Args:
        name: The decorator's identity, or its name alone.
        child: What is attempted.
        attempts: How often at most, the first time included.
        pause_s: After an exception, in the clock's seconds.
        clock: The world's time.
        provenance: The plan step that the child carries out.
    """

    def __init__(
        self,
        name: NodeId | str,
        child: Behaviour,
        *,
        attempts: int,
        pause_s: float,
        clock: Callable[[], float],
        provenance: Provenance | None = None,
    ) -> None:
        if attempts < 1:
            raise ValueError(f"{as_id(name).name} needs at least one attempt, got {attempts}")
        self.node_id = as_id(name)
        super().__init__(self.node_id.name, child, num_failures=attempts)
        self.provenance = provenance
        self._pause_s = pause_s
        self._clock = clock
        self._again_s = 0.0

    def initialise(self) -> None:
        """Begin without a pause."""
        super().initialise()
        self._again_s = 0.0

    def tick(self) -> Iterator[Behaviour]:
        """Leave the child alone during a pause."""
        if self.status is Status.RUNNING and self._clock() < self._again_s - 1e-9:
            yield self
        else:
            yield from super().tick()

    def update(self) -> Status:
        """Count the attempts that failed."""
        if any(isinstance(leaf, Action) and leaf.broke_down for leaf in preorder(self.decorated)):
            self._again_s = self._clock() + self._pause_s
        return super().update()

    def account(self) -> Account | None:
        """How many attempts failed, if any."""
        if not self.failures:
            return None
        return Account(f"{self.failures} of {self.num_failures} attempts failed", float(self.failures))
