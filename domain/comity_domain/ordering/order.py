"""The order of visits that a search found, and what it knows about it."""

from __future__ import annotations

from dataclasses import dataclass

from comity_domain.tours.tour import Stop


@dataclass(frozen=True, slots=True)
class Order:
    """The stops of the best plan that was found."""

    stops: tuple[Stop, ...]
    proven: bool
    reproducible: bool
    bound: int = 0
    """No plan costs less, as far as the search can tell."""
