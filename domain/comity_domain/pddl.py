"""A request as PDDL text, for other planners and for reading."""

from __future__ import annotations

from comity_domain.naming import Names
from comity_domain.options import Options, options
from comity_domain.request import VisitRequest
from comity_domain.skipping import left_out
from comity_domain.visit_problem import visit_names, visit_problem


def plan_pddl(request: VisitRequest) -> tuple[str, str]:
    """The domain, with comments, and the problem; any planner with action costs finds the same cost on them.

    Deadlines are not in it: a comment lists them, and its optimum may then be cheaper than the plan.

    Raises:
        ValueError: The request holds a person whom no plan can serve.
    """
    from unified_planning.io import PDDLWriter

    leaving = left_out(request)
    choices = options(request.without(leaving))
    names = visit_names(choices)
    problem = PDDLWriter(visit_problem(choices, names)).get_problem()
    skipped = "".join(f"; left out at a price: {name!a}\n" for name in leaving)
    return domain_pddl(), _legend(names) + _deadlines(choices) + skipped + problem


def _deadlines(choices: Options) -> str:
    """A comment that says what classical planning cannot hold."""
    return "".join(
        f"; not stated below: {name!a} must be greeted within {person.by_s:g} s\n"
        for name, person in choices.people.items()
        if person.by_s is not None
    )


def domain_pddl() -> str:
    """The committed text of the domain, which a test keeps equal to `visit_domain`."""
    from importlib.resources import files

    return files("comity_domain").joinpath("visit.pddl").read_text(encoding="ascii")


def _legend(names: Names) -> str:
    """A comment that says who is who, where PDDL could not keep a name."""
    changed = {id_: word for id_, word in names.words.items() if id_ != word.name}
    return "".join(f"; {id_}: the {word.kind} {word.name!a}\n" for id_, word in changed.items())
