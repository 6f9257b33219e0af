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
    """The progress of an execution."""

    t: float
    """The world's time [s]."""
    plan: Plan
    """The plan under way, from its first step on."""
    values: Mapping[str, Inference]
    """Everyone's parameters, as the tree has them."""
    done: tuple[str, ...]
    """People who were served or declined: not to be approached again."""
    failures: Mapping[str, str]
    """Reasons of the visits that were given up, by person."""
    may_replan: bool
    """Whether another plan because of a change is within the cap."""
    progress: Mapping[str, VisitProgress] = field(default_factory=dict)
    """Progress of unfinished visits, of all people with an agenda."""
    unserved: Mapping[str, str] = field(default_factory=dict)
    """People who are left but not in the plan, and why."""
    in_pause: bool = False
    """Whether this is asked during a pause because of news: no new plan is needed if the news concerns no one
    who is left."""
    asked: tuple[str, ...] = ()
    """People who were asked to make way: whether they still stand there affects the routes."""
    refused: tuple[str, ...] = ()
    """Those asked the maximum number of times without success: no plan may rely on them."""

    @property
    def failed(self) -> tuple[Cause, ...]:
        """Whose visit was given up, as links of a chain."""
        return tuple(
            Cause("reading", f"{person} was not served: {why}", None) for person, why in self.failures.items()
        )


@dataclass(frozen=True, slots=True)
class PlanUpdate:
    """The update that takes effect."""

    plan: Plan
    """The plan for those who are left: the same choices with updated parameters, or a new plan."""
    values: Mapping[str, Inference]
    replanned: bool
    """Whether it is a new plan: the tree is then built again."""
    because: tuple[Cause, ...]
    """What changed, how this affects the choice, and the values before and after."""
    unserved: Mapping[str, str] = field(default_factory=dict)
    """People who currently cannot be served, and why."""
    was_asked_for: bool = False
    """Whether it follows from a person's request: then it does not count against the cap."""
    moved: tuple[str, ...] = ()
    """People who have moved: they may be asked again to make way."""


@dataclass(frozen=True, slots=True)
class NoPlanUpdate:
    """There is no plan for those who are left."""

    because: tuple[Cause, ...]
    may_pass: bool = False
    """Whether asking again may help although nothing changed: an exception or overlapping people."""
    awaits: str | None = None
    """What may still open a route to people who have none, in words: then the execution waits for it.

    None if nothing is known.
    """
    look_for: str | None = None
    """A person who may have moved or go unnoticed while the robot looks elsewhere: it turns to them."""


class Planner(Protocol):
    """Decides what to do when things change. Implementations need not import this module."""

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
