"""Blocking conditions: found by removing them and testing whether a solution then exists."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

Condition = TypeVar("Condition")


@dataclass(frozen=True, slots=True)
class InTheWay(Generic[Condition]):
    """The conditions that would have to change."""

    any_of: tuple[Condition, ...]
    """Conditions each of which alone blocks: without it there is a solution."""
    all_of: tuple[Condition, ...] = ()
    """If no single one is enough: a minimal set to remove together."""


def in_the_way(
    conditions: Sequence[Condition], possible_without: Callable[[Sequence[Condition]], bool]
) -> InTheWay[Condition]:
    """Remove the conditions one at a time; if that is not enough, find a minimal set to remove together.

    Args:
        conditions: All active conditions; earlier ones are restored first.
        possible_without: Whether there is a solution without these; removing more never hurts.

    Returns:
        Both empty if removing all of them does not help: the reason is another one.
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
