"""Problems of unified-planning as PDDL, in a time that grows with what they state."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.io import PDDLWriter
    from unified_planning.model import FNode, Problem


def writer_of(problem: Problem) -> PDDLWriter:
    """What writes a problem as PDDL.

    unified-planning's writer asks for the value of every atom that the objects could make, true or not: of
    a predicate with five arguments and 40 objects that is 10^8. Here it gets those that are stated, and
    atoms are enumerated only of what has a value by default that is not false.

    Args:
        problem: Any that PDDL can say; it is left as it is.
    """
    from unified_planning.io import PDDLWriter
    from unified_planning.model import Problem
    from unified_planning.model.fluent import get_all_fluent_exp

    class Stated(Problem):  # type: ignore[misc]  # unified-planning has no types
        @property
        def initial_values(self) -> dict[FNode, FNode]:
            values = dict(self.explicit_initial_values)
            for fluent, default in self.fluents_defaults.items():
                if not default.is_false():
                    for atom in get_all_fluent_exp(self, fluent):
                        values.setdefault(atom, default)
            return values

    stated = problem.clone()
    stated.__class__ = Stated
    return PDDLWriter(stated)
