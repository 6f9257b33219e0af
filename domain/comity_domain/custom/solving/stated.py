"""Copies a problem with only its explicit initial values, so that it is written in linear time."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem


def stated(problem: Problem) -> Problem:
    """A copy of a problem for unified-planning's PDDL writer.

    The writer asks for the value of every possible atom, true or not: for a predicate with five arguments and
    40 objects these are 10^8. The copy returns explicit values only, and enumerates atoms only of fluents
    whose default is not false.

    Args:
        problem: Any problem that PDDL can express; it is not changed.
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
