"""A request as PDDL text, for other planners and for readers.

The domain is a file, the problem a list of facts. unified-planning reads both and its validator accepts the
plans; Fast Downward, if installed, finds the same cost (tests).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from comity_domain.choices.options import Options, options
from comity_domain.classical.initial_state import Fact, goals, initial_state, tasks, visit_names
from comity_domain.classical.naming import PddlNames
from comity_domain.labelling.skipping import left_out
from comity_domain.problem.agenda import Say
from comity_domain.problem.measuring import fully_measured
from comity_domain.problem.request import VisitRequest


def plan_pddl(request: VisitRequest) -> tuple[str, str]:
    """The commented domain and the problem; any planner with action costs finds the same cost for them.

    Deadlines are only listed in a comment, so its optimum may be cheaper than the plan.

    Raises:
        ValueError: The request includes a person whom no plan can serve.
    """
    choices = options(fully_measured(request.dropping(left_out(request))))
    names = visit_names(choices)
    comments = (*_legend(names), *_messages(choices, names), *_deadlines(choices))
    return domain_pddl(), "".join(f"; {line}\n" for line in comments) + problem_pddl(choices, names)


def problem_pddl(choices: Options, names: PddlNames) -> str:
    """The problem file."""
    lines = (
        "(define (problem visit)",
        "  (:domain visit-domain)",
        "  (:objects",
        *(f"    {id_} - {word.kind}" for id_, word in names.words.items()),
        "  )",
        "  (:init",
        *(f"    {_assigned(fact, names)}" for fact in initial_state(choices)),
        "    (= (total-cost) 0)",
        "  )",
        "  (:goal (and",
        *(f"    {_atom(fact, names)}" for fact in goals(choices)),
        "  ))",
        "  (:metric minimize (total-cost)))",
    )
    return "\n".join(lines) + "\n"


def _assigned(fact: Fact, names: PddlNames) -> str:
    atom = _atom(fact, names)
    return atom if fact.value is True else f"(= {atom} {fact.value})"


def _atom(fact: Fact, names: PddlNames) -> str:
    return f"({' '.join((fact.fluent, *(names.ids[word] for word in fact.arguments)))})"


@cache
def domain_pddl() -> str:
    """The text of the domain."""
    from importlib.resources import files

    return files("comity_domain").joinpath("visit.pddl").read_text(encoding="ascii")


def _messages(choices: Options, names: PddlNames) -> Iterator[str]:
    """Comments with the spoken messages, which PDDL cannot express."""
    for person in choices.people.values():
        for task, word in zip(person.agenda, tasks(person), strict=True):
            if isinstance(task, Say):
                yield f"{names.ids[word]} says {task.text!a}"


def _deadlines(choices: Options) -> Iterator[str]:
    """Comments with the deadlines, which classical planning cannot express."""
    for name, person in choices.people.items():
        if person.by_s is not None:
            yield f"not stated below: {name!a} must be greeted within {person.by_s:g} s"


def _legend(names: PddlNames) -> Iterator[str]:
    """Comments with the original names that PDDL could not keep."""
    for id_, word in names.words.items():
        if id_ != word.name:
            yield f"{id_}: the {word.kind} {word.name!a}"
