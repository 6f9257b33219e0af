"""PDDL files as a problem of unified-planning, every complaint with its file and line."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from comity_domain.custom.pddl.check import check
from comity_domain.custom.pddl.declared import OBJECT, Declared
from comity_domain.custom.pddl.document import Stated, as_domain, as_problem
from comity_domain.custom.pddl.effects import TOTAL_COST
from comity_domain.custom.pddl.form import Form, complaint, read_form
from comity_domain.custom.pddl.joined import with_joined_conditions
from comity_domain.custom.pddl.normal import (
    Renaming,
    Text,
    domain_text,
    problem_text,
    quantifies_objects,
    renaming,
)
from comity_domain.custom.pddl.places import Places, places

if TYPE_CHECKING:
    from collections.abc import Iterator

    from unified_planning.environment import Environment
    from unified_planning.model import Problem


Kind = Literal["action", "object", "function"]


@dataclass(frozen=True, slots=True)
class CustomProblem:
    """A domain and a problem, read."""

    problem: Problem
    """In an environment of its own."""
    domain_name: str
    problem_name: str
    written: Mapping[str, str]
    """What the files call types, objects, actions and functions, by name in `problem`, where it differs."""
    places: Places

    def as_written(self, name: str) -> str:
        """A name as the files have it."""
        return self.written.get(name, name)

    def own_name(self, kind: Kind, written: str) -> str:
        """A name of the files, in whatever case, as `problem` has it; an unknown one in lower case."""
        wanted = written.lower()
        named = {
            "action": self.problem.actions,
            "object": self.problem.all_objects,
            "function": self.problem.fluents,
        }
        names = (one.name for one in named[kind])
        return next((name for name in names if self.as_written(name).lower() == wanted), wanted)


def read_custom(domain: Path, problem: Path) -> CustomProblem:
    """Read a domain and a problem.

    Args:
        domain: A PDDL file; sections may stand in any order.
        problem: A PDDL file for this domain.

    Raises:
        InputError: with file, line and remedy, for whatever cannot be used.
    """
    return from_forms(read_form(domain), read_form(problem))


def from_forms(domain: Form, problem: Form) -> CustomProblem:
    """The same for forms that are read already.

    Raises:
        InputError: as `read_custom`.
    """
    written = as_domain(domain)
    stated = as_problem(problem)
    check(written, stated)
    declared = with_joined_conditions(written)
    names = renaming(declared, stated)
    has_costs = TOTAL_COST in declared.functions
    texts = (
        domain_text(declared, names, with_object=_needs_object(stated, (domain, problem))),
        problem_text(stated, names, has_costs=has_costs),
    )
    return CustomProblem(
        _with_goals_that_matter(_parsed(*texts), stated),
        declared.name.written,
        stated.name.written,
        _written(declared, stated, names),
        places(declared, stated, names),
    )


def _needs_object(problem: Stated, forms: tuple[Form, ...]) -> bool:
    """Whether `object` is used where unified-planning's reader does not look for it."""
    return any(typed.type == OBJECT for typed in problem.objects) or quantifies_objects(forms)


def _parsed(domain: Text, problem: Text) -> Problem:
    from unified_planning.io import PDDLReader

    whole = not any(word == "/" or _is_fraction(word) for word in (*domain.lines, *problem.lines))
    with fresh_environment(whole=whole) as environment, deep_enough(), _placed(domain, problem):
        return PDDLReader(environment).parse_problem_string(str(domain), str(problem))


def _with_goals_that_matter(problem: Problem, stated: Stated) -> Problem:
    """The problem without goals that are always true: unified-planning cannot write them.

    Raises:
        InputError: if one of them is never true.
    """
    goals = [problem.environment.simplifier.simplify(goal) for goal in problem.goals]
    if any(goal.is_false() for goal in goals):
        remedy = "Look for parts that exclude each other, or for an empty (or)."
        raise complaint(stated.goal.where, "a goal that can be true", f"'{stated.goal}'", remedy)
    problem.clear_goals()
    for goal in goals:
        problem.add_goal(goal)
    return problem


@contextmanager
def fresh_environment(*, whole: bool) -> Iterator[Environment]:
    """A fresh environment: in a shared one, a failed call can make the next one fail, too.

    Args:
        whole: Whether all numbers are whole: the reader takes them for reals, which most engines refuse.
    """
    from unified_planning.environment import Environment

    fresh = Environment()
    fresh.credits_stream = None
    if whole:
        fresh.type_manager.RealType = fresh.type_manager.IntType
    with as_global(fresh):
        yield fresh


_FRAMES_DEEPER = 3000
"""unified-planning's reader takes about 20 for a pair of brackets, of which `MAX_DEPTH` may be nested."""


@contextmanager
def deep_enough() -> Iterator[None]:
    """Let the reader nest as deep as files may, however deep the caller is already."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(before + _FRAMES_DEEPER)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


@contextmanager
def as_global(environment: Environment) -> Iterator[None]:
    """Make an environment the global one meanwhile: the reader and the simulator build parts there."""
    import unified_planning.environment as up

    before = up.GLOBAL_ENVIRONMENT
    up.GLOBAL_ENVIRONMENT = environment
    try:
        yield
    finally:
        up.GLOBAL_ENVIRONMENT = before


def _is_fraction(word: str) -> bool:
    return "." in word and word.lstrip("+-").replace(".", "", 1).isdigit() and float(word) % 1 != 0


@contextmanager
def _placed(domain: Text, problem: Text) -> Iterator[None]:
    """Whatever unified-planning refuses although we took it for right, with the place where that was."""
    from pyparsing import ParseBaseException
    from unified_planning.exceptions import UPException

    try:
        yield
    except ParseBaseException as refusal:
        text = domain if "domain" in refusal.pstr[:30] and "problem" not in refusal.pstr[:30] else problem
        raise complaint(
            text.origin(refusal.lineno),
            "PDDL that unified-planning reads",
            f"'{text.lines[min(refusal.lineno, len(text.lines)) - 1]}'",
            "Write this part as PDDL 2.1 has it.",
        ) from None
    except (
        UPException,
        SyntaxError,
        AssertionError,
        LookupError,
        ValueError,
        TypeError,
        ArithmeticError,
    ) as refusal:
        line = re.search(r"line:? (\d+)", str(refusal))
        text = problem if "init" in str(refusal) or "goal" in str(refusal) else domain
        said = without_place(str(refusal).split("\n")[0])[:160] or type(refusal).__name__
        raise complaint(
            text.origin(int(line[1]) if line else 1),
            "PDDL that unified-planning reads",
            f"something it refuses ({said})",
            "Write this part as PDDL 2.1 has it.",
        ) from None


def without_place(said: str) -> str:
    """What unified-planning says, without its place: that is one in the text that it was given."""
    return " ".join(_PLACE.sub("", said).split())


_PLACE = re.compile(r"[,.]?( found at| at| [Ff]rom)? line:? \d+,? col:? \d+( to line:? \d+,? col:? \d+)?\.?")


def _written(domain: Declared, problem: Stated, names: Renaming) -> Mapping[str, str]:
    objects = {
        names.objects.get(typed.word.text, typed.word.text): typed.word.written
        for typed in (*domain.constants, *problem.objects)
    }
    actions = {
        names.actions.get(action.word.text, action.word.text): action.word.written
        for action in domain.actions
    }
    functions = {one.word.text: one.word.written for one in domain.functions.values()}
    types = {new: old for old, new in names.types.items()}
    everything = {**types, **functions, **actions, **objects}
    return {name: word for name, word in everything.items() if name != word}
