"""Which conditions stand in the way: found by lifting them and looking whether it is possible then."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

Condition = TypeVar("Condition")


@dataclass(frozen=True, slots=True)
class InTheWay(Generic[Condition]):
    """What would have to change."""

    any_of: tuple[Condition, ...]
    """Each of these alone stands in the way: without it there is a way."""
    all_of: tuple[Condition, ...] = ()
    """Where no single one is enough: without all of these there is a way, and not with one of them left."""


def in_the_way(
    conditions: Sequence[Condition], possible_without: Callable[[Sequence[Condition]], bool]
) -> InTheWay[Condition]:
    """Lift the conditions one at a time; where that is not enough, find a smallest set to lift together.

    Args:
        conditions: All that hold; the earlier ones are put back first.
        possible_without: Whether there is a way once these are lifted; lifting more never hurts.

    Returns:
        Both empty where lifting all of them does not help: the reason is another one.
    """
    alone = tuple(condition for condition in conditions if possible_without([condition]))
    if alone or not possible_without(conditions):
        return InTheWay(alone)
    needed = list(conditions)
    for condition in conditions:
        fewer = [each for each in needed if each is not condition]
        if possible_without(fewer):
            needed = fewer
    return InTheWay((), tuple(needed))
