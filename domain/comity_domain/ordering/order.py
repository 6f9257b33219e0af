"""What an engine found, and where such findings may be kept: the order of a request that was met before."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from comity_domain.tours.tour import Stop


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
