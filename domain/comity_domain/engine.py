"""The exact search as an engine of unified-planning: `OneshotPlanner(name="comity")`."""

from __future__ import annotations

from collections.abc import Callable
from typing import IO, Any

from unified_planning.engines import Engine, PlanGenerationResult, PlanGenerationResultStatus
from unified_planning.engines.mixins import OneshotPlannerMixin
from unified_planning.engines.mixins.oneshot_planner import OptimalityGuarantee
from unified_planning.environment import Environment, get_environment
from unified_planning.model import AbstractProblem, Problem, ProblemKind

from comity_domain.classical.solving import solved
from comity_domain.classical.visit_domain import empty_problem
from comity_domain.errors import NoPlan, PlanningFailed
from comity_domain.planner import ENGINE


class ComityEngine(Engine, OneshotPlannerMixin):  # type: ignore[misc]
    """Plans problems of `problem_of`, each to the proven optimum for up to 12 people."""

    def __init__(self, **_options: object) -> None:
        Engine.__init__(self)
        OneshotPlannerMixin.__init__(self)

    @property
    def name(self) -> str:
        """See `ENGINE`."""
        return ENGINE

    @staticmethod
    def supported_kind() -> ProblemKind:
        """The features of the visit domain, with anything in its goals that is a fact."""
        return empty_problem("any").kind.union(ProblemKind({"ACTION_BASED"}))

    @staticmethod
    def supports(problem_kind: ProblemKind) -> bool:
        """Whether the domain may be the visit domain; whether it is, is seen when it is solved."""
        return bool(problem_kind <= ComityEngine.supported_kind())

    @staticmethod
    def satisfies(optimality_guarantee: OptimalityGuarantee) -> bool:
        """Every guarantee: plans are proven to be the cheapest, or called satisficing."""
        return True

    def _solve(
        self,
        problem: AbstractProblem,
        heuristic: Callable[[Any], float | None] | None = None,
        timeout: float | None = None,
        output_stream: IO[str] | None = None,
    ) -> PlanGenerationResult:
        assert isinstance(problem, Problem)
        try:
            plan, order = solved(problem, time_limit_s=timeout or 30.0)
        except NoPlan:
            return PlanGenerationResult(PlanGenerationResultStatus.UNSOLVABLE_PROVEN, None, ENGINE)
        except PlanningFailed:
            return PlanGenerationResult(PlanGenerationResultStatus.TIMEOUT, None, ENGINE)
        status = PlanGenerationResultStatus
        return PlanGenerationResult(
            status.SOLVED_OPTIMALLY if order.proven else status.SOLVED_SATISFICING, plan, ENGINE
        )


def register(environment: Environment | None = None) -> None:
    """Make it known to the factory of an environment; of unified-planning's global one without any."""
    factory = (environment or get_environment()).factory
    if ENGINE not in factory.engines:
        factory.add_engine(ENGINE, __name__, ComityEngine.__name__)
