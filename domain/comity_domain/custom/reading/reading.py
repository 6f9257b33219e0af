"""Reads PDDL files with unified-planning's reader; every error gets its file and line."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity_domain.custom.reading.checks import refuse_misread
from comity_domain.custom.reading.places import TOTAL_COST, DomainPlaces
from comity_domain.custom.reading.text import Form, PddlText, read_text
from comity_fis.errors import InputError, Where, closest

if TYPE_CHECKING:
    from unified_planning.environment import Environment
    from unified_planning.model import Problem

COST = "total_cost"
"""Name of `total-cost` in the problem: one that unified-planning's reader does not treat specially.

For `total-cost`, the reader takes the first increase as the action's cost and drops further ones.
"""


@dataclass(frozen=True, slots=True)
class CustomProblem:
    """A domain and a problem read from PDDL."""

    problem: Problem
    """The problem in its own environment; all names in lower case."""
    domain_name: str
    problem_name: str
    written: Mapping[str, str]
    """Names as written in the files, by name in `problem`."""
    places: DomainPlaces

    def as_written(self, name: str) -> str:
        """A name as the files write it at its first occurrence."""
        return self.written.get(name, name)


def read_custom(domain: Path, problem: Path) -> CustomProblem:
    """Read a domain and a problem.

    Args:
        domain: A PDDL file.
        problem: A PDDL file for this domain.

    Raises:
        InputError: Something cannot be used; with file, line and remedy.
    """
    texts = read_text(domain), read_text(problem)
    refuse_misread(*texts)
    read = _with_goals_that_matter(_read(*texts), texts[1])
    written = dict(_written(*texts))
    names = (text.define.items[1].items[1].word for text in texts)
    domain_name, problem_name = (written.get(name, name) for name in names)
    return CustomProblem(read, domain_name, problem_name, written, DomainPlaces(*texts))


def _written(domain: PddlText, problem: PddlText) -> Iterator[tuple[str, str]]:
    for text in (problem, domain):  # the text given last takes precedence
        for form in reversed(list(text.define.all())):
            if form.word:
                yield form.word, text.text[form.start : form.start + len(form.word)]
    yield COST, TOTAL_COST


def _read(domain: PddlText, problem: PddlText) -> Problem:
    from unified_planning.io import PDDLReader

    texts = [text.text.replace("\t", " ").lower().replace(TOTAL_COST, COST) for text in (domain, problem)]
    words = {form.word for text in (domain, problem) for form in text.define.all()}
    whole = not any(word == "/" or _is_fraction(word) for word in words)
    # The domain first, alone: the reader does not say which of two files an error is in.
    for read, blamed in ((texts[:1], domain), (texts, problem)):
        with fresh_environment(whole=whole) as environment:
            try:
                found = PDDLReader(environment).parse_problem_string(*read)
            except Exception as refusal:  # the reader raises a dozen kinds, AttributeError among them
                raise _complaint(refusal, blamed, domain) from None
    return found


def _is_fraction(word: str) -> bool:
    return bool(re.fullmatch(r"[+-]?\d*\.\d*[1-9]\d*", word))


def _with_goals_that_matter(problem: Problem, text: PddlText) -> Problem:
    """The problem without goals that are always true, which unified-planning cannot write.

    Raises:
        InputError: A goal is never true.
    """
    goals = [problem.environment.simplifier.simplify(goal) for goal in problem.goals]
    if any(goal.is_false() for goal in goals):
        stated = text.section(":goal") or text.define
        remedy = "Look for parts that exclude each other, or for an empty (or)."
        raise text.refused(stated, "a goal that can be true", f"'{stated}'", remedy)
    problem.clear_goals()
    for goal in goals:
        problem.add_goal(goal)
    return problem


@contextmanager
def fresh_environment(*, whole: bool) -> Iterator[Environment]:
    """A new unified-planning environment: in a shared one, a failed call can make the next one fail.

    Args:
        whole: Whether to make all numbers integers: the reader makes them reals, which most engines reject.
    """
    from unified_planning.environment import Environment

    fresh = Environment()
    fresh.credits_stream = None
    if whole:
        fresh.type_manager.RealType = fresh.type_manager.IntType
    with as_global(fresh):
        yield fresh


@contextmanager
def as_global(environment: Environment) -> Iterator[None]:
    """Temporarily make an environment the global one, which the reader and the simulator use."""
    import unified_planning.environment as up

    before = up.GLOBAL_ENVIRONMENT
    up.GLOBAL_ENVIRONMENT = environment
    try:
        yield
    finally:
        up.GLOBAL_ENVIRONMENT = before


def _complaint(refusal: Exception, text: PddlText, domain: PddlText) -> InputError:
    """An error of unified-planning's reader, with its location if known."""
    from pyparsing import ParseBaseException

    if isinstance(refusal, ParseBaseException):
        at = _form_at(text, refusal.lineno, refusal.col)
        return _refused(text, at, refusal.msg, _out_of_order(at))
    if isinstance(refusal, RecursionError):
        remedy = "Look for types in a circle, or for brackets that are nested without need."
        return _refused(text, None, "it is nested too deep", remedy)
    said = str(refusal)
    form = _form_of(text, refusal, said)
    return _refused(text, form, _in_short(said), _remedy(form, said, text, domain))


_PLACE = re.compile(r"[,.]?( found at| at| [Ff]rom)? line:? \d+,? col:? \d+( to line:? \d+,? col:? \d+)?\.?")
_NAMED = re.compile(r"(?:Name|Type) '?([\w-]+)'? (?:already|is)|variable's type: .*'([\w-]+)'")
_TYPE = re.compile(r"Undefined .* type: ([\w-]*)|^'object'$")
_AT = re.compile(r"line:? (\d+),? col:? (\d+)")
SECTIONS = (":requirements", ":types", ":constants", ":predicates", ":functions", ":action",
            ":domain", ":objects", ":init", ":goal", ":metric")  # fmt: skip
PARTS = (":parameters", ":precondition", ":duration", ":condition", ":effect")


def _in_short(said: str) -> str:
    """The reader's message without its own location, error name and advice for programmers."""
    first = _PLACE.sub("", said.split("\n", maxsplit=1)[0]).split("! ")[0]
    inner = re.fullmatch(r"\w+\([\"'](.*)[\"']\)", first)
    return inner[1] if inner else first


def _refused(text: PddlText, form: Form | None, said: str, remedy: str) -> InputError:
    shown = "something" if form is None else f"'{form}'"
    return InputError(
        expected="PDDL that unified-planning reads",
        got=f"{shown}, which it refuses ({' '.join(said.split())[:160]})",
        remedy=remedy,
        where=Where(text.name) if form is None else text.where(form),
    )


def _form_of(text: PddlText, refusal: Exception, said: str) -> Form | None:
    """The form that the error is about: found by its location, or by a name in the message."""
    named = _NAMED.search(said)
    place = _AT.search(said)
    if place and not named:
        return _form_at(text, int(place[1]), int(place[2]))
    name = (
        str(refusal.args[0]) if isinstance(refusal, KeyError) else (named[1] or named[2]) if named else None
    )
    found = [form for form in text.define.all() if form.word == name]
    return found[min(1, len(found) - 1)] if found else None  # the second one, for a duplicate name


def _form_at(text: PddlText, line: int, column: int) -> Form:
    """The innermost form that starts at or before a position."""
    lines = text.text.split("\n")
    offset = sum(len(one) + 1 for one in lines[: line - 1]) + column - 1
    return [form for form in text.define.all() if form.start <= max(offset, text.define.start)][-1]


def _out_of_order(form: Form) -> str:
    """The remedy where the file departs from the grammar."""
    word = form.word or form.head
    if word.startswith(":") and word not in (*SECTIONS, ":durative-action", *PARTS):
        return closest(word, (*SECTIONS, *PARTS))
    return (
        f"Write sections in this order, each once: {', '.join(SECTIONS[:6])} in a domain, "
        f"{', '.join(SECTIONS[6:])} in a problem; and {', '.join(PARTS)} in an action."
    )


def _remedy(form: Form | None, said: str, text: PddlText, domain: PddlText) -> str:
    """The remedy: the name probably meant, for an undeclared name."""
    declared = {name for one in (text, domain) for name in _declared(one)}
    if missing := _TYPE.search(said):
        if missing[1] in (None, "", "object"):
            return "Give it a type that is declared under :types."
        return closest(missing[1], declared)
    if form is None:
        return "Write this part as PDDL 2.1 has it."
    word = form.word or form.head
    if word == "?duration":
        return "Write here what stands under :duration, as in (= ?duration 10)."
    if word in declared or "already" in said:
        return "Check it against where it is declared; no two things may have one name."
    return closest(word, declared)


def _declared(text: PddlText) -> Iterator[str]:
    for section in text.define.items:
        if section.head in (":types", ":constants", ":objects"):
            yield from (item.word for item in section.rest if item.word not in ("", "-"))
        elif section.head in (":predicates", ":functions"):
            yield from (item.head for item in section.rest if item.head)
