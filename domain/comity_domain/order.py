"""What an engine found, and where such findings may be kept: the order of a request that was met before."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from comity_domain.initial_state import initial_state
from comity_domain.options import Options
from comity_domain.tour import Stop


@dataclass(frozen=True, slots=True)
class Order:
    """The stops of the best plan that an engine found."""

    engine: str
    stops: tuple[Stop, ...]
    proven: bool
    reproducible: bool
    bound: int = 0
    """No plan costs less, as far as the engine can tell."""
    killed: bool = False
    """Somebody else ended the engine before it was done."""


class Orders(Protocol):
    """Orders that were found earlier, by everything that they depend on."""

    def recall(self, key: str) -> Order | None:
        """The order that was kept; None where none was."""
        ...

    def keep(self, key: str, order: Order) -> None:
        """Keep an order for the next time."""
        ...


def order_key(options: Options) -> str:
    """A digest of all that an engine is told, in the order in which it is told."""
    digest = hashlib.sha256()
    for line in _told(options):
        digest.update(f"{line}\n".encode())
    return digest.hexdigest()


def _told(options: Options) -> Iterator[str]:
    yield options.robot
    yield from (repr(tuple(fact)) for fact in initial_state(options))
    for person in options.people.values():
        yield repr((person.name, person.by_s, person.skip, person.priority, person.agenda))
    yield from map(repr, options.durations_s.items())
