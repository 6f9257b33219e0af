"""What an engine answers: a plan, and what is known about better ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class GroundAction:
    """An action of a plan, in the words of the planning problem."""

    name: str
    arguments: tuple[str, ...]
    start_s: float | None = None
    """When it starts; None where the plan is a mere order."""
    duration_s: float | None = None


@dataclass(frozen=True, slots=True)
class Solution:
    """The best plan that an engine found."""

    engine: str
    """By its name in unified-planning."""
    actions: tuple[GroundAction, ...]
    finished: bool
    """It is proven that no plan is better by the problem's metric."""
    bound: int = 0
    """What no plan costs less than, as far as the engine says so; 0 where it says nothing."""
    killed: bool = False
    """The engine was killed from outside: there might have been time for more."""
    metric_ignored: bool = False
    """The problem has a metric, and the engine did not look at it."""


def ground_actions(plan: Any) -> Iterator[GroundAction]:
    """The actions of a plan of unified-planning, in its order or with its times."""
    timed = getattr(plan, "timed_actions", None)
    if timed is None:
        timed = ((None, action, None) for action in plan.actions)
    for start, action, duration in timed:
        yield GroundAction(
            action.action.name,
            tuple(argument.object().name for argument in action.actual_parameters),
            None if start is None else float(start),
            None if start is None else float(duration or 0),
        )
