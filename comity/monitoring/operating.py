"""The operator's words carried out between two ticks, and put on record with what came of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.answers.run import Disturbance
from comity.live.operator import OF_PEOPLE, STOPPED, UNAPPROVED, Operator, OperatorCommand
from comity.monitoring.consenting import consenting
from comity.monitoring.nudging import nudged
from comity_executor import PlanUpdate
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.monitoring.guarding import Guarding
    from comity.monitoring.replanning import WorldPlanner
    from comity.preparation import PlannedEpisode
    from comity.schedule import Schedule
    from comity_executor import Execution, ExecutionState, NoPlanUpdate, Planner

LEFT = "the operator left before the plan was approved"


class Operating:
    """Carries out what one operator says.

    Args:
        operator: Who says it.
        planner: Leaves people out.
        guard: Is told of distances.
        schedule: Keeps the record.
        execution: Is stopped, and goes on.
        prepared: The scenario.
        tolerance_m: How exactly the robot stops.
    """

    def __init__(
        self,
        operator: Operator,
        planner: WorldPlanner,
        guard: Guarding,
        schedule: Schedule,
        execution: Execution,
        *,
        prepared: PlannedEpisode,
        tolerance_m: float,
    ) -> None:
        self._operator = operator
        self._prepared = prepared
        self._planner = planner
        self._guard = guard
        self._schedule = schedule
        self._execution = execution
        self._tolerance_m = tolerance_m
        self._has_to_resume = False
        operator.note_plan(execution.plan)

    def carry_out(self, now_s: float) -> None:
        """Do what was said since the last tick."""
        for word in self._operator.words():
            text = self._done(word, now_s)
            self._schedule.record(Disturbance(now_s, now_s, "operator", word.about, text))
        if self._has_to_resume and not self._operator.holds():
            # What the operator held is read as released in the next tick; no stop of the robot is waited for.
            goes_on = self._execution.resume()
            self._has_to_resume = not goes_on and self._execution.stopped_by in (UNAPPROVED, STOPPED)
        if self._operator.has_left and self._operator.holds() == UNAPPROVED:
            self._execution.stop(LEFT)

    def _done(self, word: OperatorCommand, now_s: float) -> str:
        """What came of a word, in words."""
        if word.order in OF_PEOPLE and word.about not in self._execution.values:
            return f"{word.order} {word.about}: refused, nobody is called so"
        match word.order:
            case "approve" | "resume":
                self._has_to_resume = True
                return "the operator approved the plan" if word.order == "approve" else "the operator resumed"
            case "stop":
                return STOPPED
            case "mark":
                return f"the operator marked: {word.about}"
            case "skip":
                self._planner.skip(word.about, f"the operator skipped {word.about}")
                return f"the operator skipped {word.about}"
        return self._nudge(word) if word.order in ("nearer", "farther") else self._touch(word, now_s)

    def _touch(self, word: OperatorCommand, now_s: float) -> str:
        given = word.order == "consents"
        does = "consents" if given else "does not consent"
        told = f"the operator says that {word.about} {does} to touch in this meeting"
        try:
            own = self._guard.own(word.about)
            values = consenting(self._prepared, own, word.about, given=given, t=now_s)
        except InputError as error:
            return f"{told}: refused, {error}"
        self._guard.tell(word.about, values, told)
        return told

    def _nudge(self, word: OperatorCommand) -> str:
        by_m = word.metres if word.order == "farther" else -word.metres
        told = f"the operator wants the robot {word.order} to {word.about} by {word.metres:.2f} m"
        visit = next((each for each in self._execution.visits if each.person == word.about), None)
        moved = nudged(self._guard.own(word.about), by_m, visit=visit, tolerance_m=self._tolerance_m)
        if isinstance(moved, str):
            return f"{told}: refused, {moved}"
        self._guard.tell(word.about, moved, told)
        return told


@dataclass(frozen=True, slots=True)
class Approved:
    """A planner whose new plans the operator is told of, before any of them begins."""

    planner: Planner
    operator: Operator

    def has_news(self, t: float) -> bool:
        """As the planner says."""
        return self.planner.has_news(t)

    def review(self, course: ExecutionState) -> PlanUpdate | None:
        """As the planner says."""
        revision = self.planner.review(course)
        if revision is not None and revision.replanned:
            self.operator.note_plan(revision.plan)
        return revision

    def permitted(self, course: ExecutionState) -> PlanUpdate | None:
        """As the planner says: what a person no longer permits needs no approval to be left out."""
        return self.planner.permitted(course)

    def replan(self, course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        """As the planner says."""
        answer = self.planner.replan(course)
        if isinstance(answer, PlanUpdate):
            self.operator.note_plan(answer.plan)
        return answer
