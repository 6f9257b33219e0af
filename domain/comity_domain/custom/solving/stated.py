"""A problem whose values are those that are stated, so that it is written in a time that grows with them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem


def stated(problem: Problem) -> Problem:
    """A copy of a problem for unified-planning's PDDL writer.

    The writer asks for the value of every atom that the objects could make, true or not: of a predicate with
    five arguments and 40 objects that is 10^8. The copy gives those that are stated, and enumerates atoms
    only of what has a value by default that is not false.

    Args:
        problem: Any that PDDL can say; it is left as it is.
    """
    from unified_planning.model import Problem
    from unified_planning.model.fluent import get_all_fluent_exp

    class StatedProblem(Problem):  # type: ignore[misc]  # unified-planning has no types
        @property
        def initial_values(self) -> dict[FNode, FNode]:
            values = dict(self.explicit_initial_values)
            for fluent, default in self.fluents_defaults.items():
                if not default.is_false():
                    for atom in get_all_fluent_exp(self, fluent):
                        values.setdefault(atom, default)
            return values

    copy = problem.clone()
    copy.__class__ = StatedProblem
    return copy
