"""An engine's answer: a plan, and what is known about better ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class GroundAction:
    """A ground action of a plan, with names of the planning problem."""

    name: str
    arguments: tuple[str, ...]
    start_s: float | None = None
    """Start time [s]; None for a plan without times."""
    duration_s: float | None = None


@dataclass(frozen=True, slots=True)
class Solution:
    """The best plan that an engine found."""

    engine: str
    """Its name in unified-planning."""
    actions: tuple[GroundAction, ...]
    finished: bool
    """Whether it is proven that no plan is better by the problem's metric."""
    bound: int = 0
    """Lower bound on the cost of any plan; 0 if the engine gives none."""
    killed: bool = False
    """Whether the engine was killed from outside, so that there might have been time for more."""
    metric_ignored: bool = False
    """Whether the engine ignored the problem's metric."""


def ground_actions(plan: Any) -> Iterator[GroundAction]:
    """The actions of a unified-planning plan, in order or with their times."""
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
