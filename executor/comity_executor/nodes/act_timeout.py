"""A timeout for acts: an aborted act is retried after a pause, as long as time is left."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.nodes.cause import Provenance
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.simulated_timeout import SimulatedTimeout


class ActTimeout(SimulatedTimeout):
    """RUNNING also after a failure of its child, until no time is left for another attempt.

    Args:
        name: The decorator's identity, or its name alone.
        child: The act.
        duration_s: Total time for all attempts, in the clock's seconds.
        pause_s: Time between two attempts [s].
        clock: The world's time.
        provenance: The plan step that the child carries out.
    """

    def __init__(
        self,
        name: NodeId | str,
        child: Behaviour,
        *,
        duration_s: float,
        pause_s: float,
        clock: Callable[[], float],
        provenance: Provenance | None = None,
    ) -> None:
        super().__init__(
            name, child, duration_s=duration_s, clock=clock, provenance=provenance, limit="act_s"
        )
        self.pause_s = pause_s
        self._again_s = 0.0
        self._begun = 1

    @property
    def attempts(self) -> int:
        """Maximum number of attempts: each begins at least a pause after the one before."""
        return max(1, math.ceil(self.duration_s / self.pause_s - 1e-9))

    def initialise(self) -> None:
        """Start the clock, without a pause."""
        super().initialise()
        self._again_s, self._begun = 0.0, 1

    def next_attempt(self) -> tuple[int, float] | None:
        """Number and start [s] of the attempt after a failure now, or None."""
        again_s = self._clock() + self.pause_s
        return (self._begun + 1, again_s) if again_s < self._end_s else None

    def pauses(self) -> bool:
        """Whether it waits for the next attempt."""
        return self.status is Status.RUNNING and self._clock() < self._again_s - 1e-9

    def tick(self) -> Iterator[Behaviour]:
        """Leave the child alone during a pause."""
        if self.pauses():
            yield self
        else:
            yield from super().tick()

    def update(self) -> Status:
        """A failure is final only where there is no time for another attempt."""
        status = super().update()
        if status is not Status.FAILURE or self.timed_out or (again := self.next_attempt()) is None:
            return status
        self._begun, self._again_s = again
        return Status.RUNNING
