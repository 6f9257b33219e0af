"""The order in which people are visited."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes, ordering
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import require_goal
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.episode import Episode


@dataclass(frozen=True, slots=True)
class VisitOrder(Expectation):
    """The order in which the robot docked at the named people; others are ignored."""

    RULE: ClassVar[str] = "_VISITS _IN_THIS_ORDER names"
    EXAMPLE: ClassVar[str] = "visits in this order: host, guest"

    names: tuple[str, ...]

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from names, each once: only the first visit of a person counts."""
        (names,) = parts
        again = next((name for name in names if names.count(name) > 1), None)
        if again is not None:
            got = f"{again!r} more than once"
            raise InputError(expected="everybody once in an order", got=got, remedy="Name them once.")
        return cls(names)

    @property
    def people(self) -> Sequence[str]:
        """All named people."""
        return self.names

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Another order, or a person who was not visited."""
        require_goal(episode.prepared.file.scenario, *self.names)
        order = ordering.visited(episode.events)
        got = tuple(name for name in order if name in self.names)
        if got != self.names:
            missing = [name for name in self.names if name not in got]
            because = (
                *ordering.of_order(episode, self.names),
                *(line for name in missing for line in causes.of_visit(episode, name)),
            )
            yield Finding(", then ".join(self.names), ", then ".join(order) or "nobody", because)
