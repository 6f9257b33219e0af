"""The exchange between an execution and its planner after a change of the world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from comity_domain.plans.plan import Plan
from comity_domain.plans.rest import VisitProgress
from comity_executor.nodes.cause import Cause
from comity_fis.inference.value import Inference


@dataclass(frozen=True, slots=True)
class ExecutionState:
    """How far an execution is."""

    t: float
    """The world's time [s]."""
    plan: Plan
    """The plan under way, from its first step on."""
    values: Mapping[str, Inference]
    """Everyone's parameters, as the tree has them."""
    done: tuple[str, ...]
    """Who was served, or declined: not to be approached again."""
    failures: Mapping[str, str]
    """Whose visit was given up, and why."""
    may_replan: bool
    """Whether another plan because of a change would be within the cap."""
    progress: Mapping[str, VisitProgress] = field(default_factory=dict)
    """How far the visits are that are not over, of everybody with an agenda."""
    unserved: Mapping[str, str] = field(default_factory=dict)
    """Who is left and not in the plan, and why."""
    in_pause: bool = False
    """Whether this is asked before a pause is over, only because there is news: a planner need not answer
    with another plan where the news bears on nobody who is left."""
    asked: tuple[str, ...] = ()
    """Who was asked to let the robot pass: it bears on the way whether they still stand there."""
    refused: tuple[str, ...] = ()
    """Those of them who were asked as often as anybody is, in vain: no plan is to count on them."""

    @property
    def failed(self) -> tuple[Cause, ...]:
        """Whose visit was given up, as links of a chain."""
        return tuple(
            Cause("reading", f"{person} was not served: {why}", None) for person, why in self.failures.items()
        )


@dataclass(frozen=True, slots=True)
class PlanUpdate:
    """What is to hold from now on."""

    plan: Plan
    """For those who are left. The same choices with new numbers, or a new plan."""
    values: Mapping[str, Inference]
    replanned: bool
    """Whether it is a new plan: the tree is then built again."""
    because: tuple[Cause, ...]
    """What changed, how the choice is known to stand or to fall, and the numbers before and after."""
    unserved: Mapping[str, str] = field(default_factory=dict)
    """Who is left and cannot be served as things stand, and why."""
    was_asked_for: bool = False
    """Whether a person said what it follows from: then it is not held against the cap."""
    moved: tuple[str, ...] = ()
    """Who stands elsewhere than before: they may be asked again to let the robot pass."""


@dataclass(frozen=True, slots=True)
class NoPlanUpdate:
    """There is no plan for those who are left."""

    because: tuple[Cause, ...]
    may_pass: bool = False
    """Whether it is worth asking again although nothing changed: something broke or overlaps."""
    awaits: str | None = None
    """What may still give a route to people who have none, in words: then the route is waited for.

    None where nothing is known that would.
    """
    look_for: str | None = None
    """Who may stand otherwise than the robot believes, or go unnoticed, while it looks elsewhere: it turns to
    them."""


class Planner(Protocol):
    """Who knows what to do when things change. An implementation need not import this module."""

    def has_news(self, t: float) -> bool:
        """Asked before every tick: is it time to review the plan?"""
        ...

    def review(self, course: ExecutionState) -> PlanUpdate | None:
        """Asked when there is news: does the plan still hold? None where nothing follows from it.

        Where `may_replan` is not so, the revision has to keep the choices of the plan, unless a person no
        longer permits one of them or asked for another.
        """
        ...

    def permitted(self, course: ExecutionState) -> PlanUpdate | None:
        """Asked where `review` broke down: the plan without what a person no longer permits.

        None where all of it is still permitted, so that the plan stays as it is.
        """
        ...

    def replan(self, course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        """Asked when the tree has failed, within the cap: another plan from the world as it is, or none."""
        ...
