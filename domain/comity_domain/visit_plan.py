"""A plan of visits: it knows what was asked, and so its problem."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from comity_domain.classical.problem import to_unified_planning
from comity_domain.plans.plan import Plan
from comity_domain.problem.request import VisitRequest

if TYPE_CHECKING:
    from unified_planning.model import Problem
    from unified_planning.plans import SequentialPlan


@dataclass(frozen=True, slots=True, repr=False)
class VisitPlan(Plan):
    """A plan for a request."""

    request: VisitRequest = field(kw_only=True, compare=False)
    """What was asked; a rest of the plan keeps the request of the whole."""

    def to_unified_planning(self) -> tuple[Problem, SequentialPlan]:
        """The visits as a problem of unified-planning, and the plan for it: its validator takes both.

        Deadlines are not in the problem.
        """
        return to_unified_planning(self, self.request)
