"""Diagnoses an unsolvable problem: which goal has no plan, and which action's condition prevents it.

As for visits (`relaxing`), goals and conditions are removed one at a time, and any plan is searched for.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from comity_domain.custom.solving.bound import Bound, require, with_goals
from comity_domain.custom.solving.choosing import FAST_DOWNWARD
from comity_domain.custom.solving.engines import solve
from comity_domain.custom.solving.ruled_out import reason, ruled_out_steps
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.errors import NoPlan, PlanningFailed
from comity_domain.explanation.relaxing import in_the_way
from comity_fis.listing import listed

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem

MOST_NAMED = 3
"""Maximum number of excluded steps to name."""
EACH_S, ALL_S = 5.0, 30.0
"""Time for one search, and for all of them [s] (our choice); a search that times out proves nothing."""


@dataclass(frozen=True, slots=True)
class Needed:
    """One precondition of one action."""

    action: str
    condition: FNode


def no_plan(bound: Bound, *, patience_s: float = ALL_S) -> NoPlan:
    """The error for a problem without a plan: the failing goals, and what would have to change.

    Args:
        bound: A problem without a plan.
        patience_s: Wall-clock time for all searches [s], > 0.
    """
    return _Search(bound, time.monotonic() + patience_s).told()


@dataclass(frozen=True, slots=True)
class _Search:
    bound: Bound
    until: float

    def told(self) -> NoPlan:
        goals = _parts(self.bound.problem.goals)
        reached = {goal: self.reaches([goal]) for goal in goals}
        failing = [goal for goal in goals if reached[goal] is False]
        if not failing and None in reached.values():
            remedy = "Allow more time to be told which goal stands in the way."
            return NoPlan("no plan reaches all goals", remedy=remedy)
        if not failing:
            return self._conflict(goals)
        names = listed(map(self.words, failing))
        never = [goal for goal in failing if goal.is_fluent_exp() and not self._is_made(goal)]
        if never:
            remedy = f"No action makes {self.words(never[0])} true: add one, or state it in the problem."
            return NoPlan(f"no plan reaches the goal {names}", remedy=remedy)
        return NoPlan(f"no plan reaches the goal {names}", remedy=self._remedy(failing))

    def _conflict(self, goals: Sequence[FNode]) -> NoPlan:
        """The diagnosis if each goal alone has a plan, but all of them together have none."""
        found = in_the_way(
            goals, lambda lifted: bool(self.reaches([one for one in goals if one not in lifted]))
        )
        names = listed(map(self.words, found.any_of), "or") or listed(map(self.words, found.all_of))
        if not names:
            return NoPlan(
                "no plan reaches all goals",
                remedy="Each of them has a plan of its own: look for what one of them uses up.",
            )
        return NoPlan(
            "each goal has a plan, and no plan reaches all of them",
            remedy=f"It would be possible without {names}.",
        )

    def _remedy(self, failing: Sequence[FNode]) -> str:
        ruled_out = ruled_out_steps(self.bound, failing, time_limit_s=max(1.0, self.left_s / 2))
        if ruled_out:
            return self._if_open(ruled_out)
        needed = [
            Needed(action.name, condition)
            for action in self.bound.problem.actions
            if self.bound.classical
            for condition in _parts(action.preconditions)
        ]
        found = {one: self.reaches(failing, [one]) for one in needed}
        texts = [
            f"{self._name(one.action)} did not need {self.words(one.condition)}"
            for one in needed
            if found[one]
        ]
        if texts:
            return f"It would be possible if {', or if '.join(texts)}."
        if None in found.values():
            return "Allow more time to be told which condition of an action stands in the way."
        return "No single condition of an action stands in the way: look for what several of them need."

    def _if_open(self, steps: Sequence[GroundAction]) -> str:
        """The diagnosis if the plan depends on steps that have no cost or are not permitted."""
        reasons = dict(reason(step, self.bound) for step in steps)
        conditions = listed([*reasons][:MOST_NAMED])
        more = f" and {len(reasons) - MOST_NAMED} more" if len(reasons) > MOST_NAMED else ""
        return f"It would be possible if {conditions}{more}. {next(iter(reasons.values()))}"

    @property
    def left_s(self) -> float:
        """Time left for all searches [s]."""
        return self.until - time.monotonic()

    def reaches(self, goals: Sequence[FNode], without: Sequence[Needed] = ()) -> bool | None:
        """Whether there is a plan for these goals, with these action conditions removed.

        Returns:
            None if that is not known in time.
        """
        if self.left_s <= 0.0:
            return None
        problem = with_goals(self.bound.problem, goals)
        problem.clear_quality_metrics()  # any plan suffices
        for one in without:
            action = problem.action(one.action)
            require(action, [part for part in _parts(action.preconditions) if part != one.condition])
        return self._has_plan(problem, min(EACH_S, self.left_s))

    def _has_plan(self, problem: Problem, limit_s: float) -> bool | None:
        try:
            engine = FAST_DOWNWARD if self.bound.classical else None
            solve(problem, engine=engine, time_limit_s=limit_s, any_plan=True)
        except NoPlan:
            return False
        except PlanningFailed:
            return None
        return True

    def _is_made(self, goal: FNode) -> bool:
        """Whether some action can make the goal's predicate true, for any objects."""
        return (
            any(
                effect.fluent.fluent() == goal.fluent() and not effect.value.is_false()
                for action in self.bound.problem.actions
                for effect in getattr(action, "effects", [])
            )
            or not self.bound.classical
        )

    def words(self, node: FNode) -> str:
        """A condition in PDDL syntax."""
        from unified_planning.io.pddl_writer import ConverterToPDDLString
        from unified_planning.model import Parameter, Variable

        def name(item: Any) -> str:
            return f"?{item.name}" if isinstance(item, Parameter | Variable) else self._name(item.name)

        environment = self.bound.problem.environment
        if environment.simplifier.simplify(node).is_bool_constant():  # unified-planning cannot write it
            return f"({node})"
        text: str = ConverterToPDDLString(environment, name).convert(node)
        return " ".join(text.split())

    def _name(self, name: str) -> str:
        return self.bound.own.as_written(name)


def _parts(conditions: Sequence[FNode]) -> list[FNode]:
    """The conjuncts of the conditions."""
    from unified_planning.engines.compilers.utils import split_all_ands

    return list(split_all_ands(list(conditions)))
