"""What leaves of different visits share: the base, the plan's validity, and requests for passage."""

from __future__ import annotations

from dataclasses import dataclass
from uuid import UUID

from comity_executor.memory.board import Board, Entry
from comity_executor.robots.goals import GoalId


@dataclass(frozen=True, slots=True)
class PassageRequest:
    """A person in the way was asked to let the robot pass."""

    t: float
    """When, in the world's time [s]."""
    person: str
    way: tuple[str, ...]
    """Where to, in the words that nodes have in brackets: a thing, the person."""

    def __str__(self) -> str:
        return f"{self.person} at {self.t:.2f} s"


@dataclass(frozen=True, slots=True)
class BaseHolder:
    """The leaf that commands the base, as a value: on the blackboard a leaf would keep its tree alive."""

    leaf: str
    """Its name."""
    id: UUID
    """Its identity: leaves of two plans may have one name."""
    goal: GoalId | None = None
    """What the robot calls its goal; None where it has none, or the call raised."""

    def __str__(self) -> str:
        return self.leaf


class SharedMemory(Board):
    """Entries of the whole execution."""

    outdated = Entry[str | None](None)
    """Why the plan does not hold any more; None while it does."""
    base = Entry[BaseHolder | None](None)
    """The leaf that commands the base; None while it is at rest."""
    announced = Entry[str | None](None)
    """Who does not see, was told that the robot comes, and not yet that it leaves; None: nobody."""
    stopped_s = Entry[float | None](None)
    """The time of the docking of which such a person was told [s]."""
    asked = Entry[tuple[PassageRequest, ...]](())
    """Requests for passage, in order."""
    in_vain = Entry[frozenset[str]](frozenset())
    """People who had time to make way, and did not."""
