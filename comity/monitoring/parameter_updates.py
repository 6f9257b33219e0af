"""What people say on the way, as it counts from then on: for pictures, and for judging an episode."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.parameters.passing import own_distance_m

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class ParameterUpdate:
    """A person's parameters are others from a time on."""

    t: float
    """In the world's time [s]."""
    person: str
    values: Inference
    """All their parameters, from then on."""
    text: str
    """What they said, or what else happened, in words."""


def values_at(
    start: Mapping[str, Inference], told: Iterable[ParameterUpdate], person: str, t: float
) -> Inference:
    """A person's parameters at a time [s].

    Args:
        start: Everybody's, at the start.
        told: What was said, in order of time.
        person: Who.
        t: What was said then counts already.
    """
    values = start[person]
    for one in told:
        if one.person == person and one.t <= t:
            values = one.values
    return values


def later_distances_m(told: Iterable[ParameterUpdate]) -> dict[str, tuple[tuple[float, float], ...]]:
    """Since when [s] a person likes another distance [m], by name and in order of time."""
    later: dict[str, tuple[tuple[float, float], ...]] = {}
    for one in told:
        later[one.person] = (*later.get(one.person, ()), (one.t, own_distance_m(one.values)))
    return later
