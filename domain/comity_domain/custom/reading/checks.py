"""Rejects PDDL that unified-planning's reader would misread, or reject without a helpful message."""

from __future__ import annotations

import re
from collections.abc import Iterator

from comity_domain.custom.reading.text import Form, PddlText
from comity_fis.errors import closest

REQUIREMENTS = (
    ":strips",
    ":typing",
    ":negative-preconditions",
    ":disjunctive-preconditions",
    ":equality",
    ":existential-preconditions",
    ":universal-preconditions",
    ":quantified-preconditions",
    ":conditional-effects",
    ":fluents",
    ":numeric-fluents",
    ":adl",
    ":durative-actions",
    ":duration-inequalities",
    ":timed-initial-literals",
    ":action-costs",
    ":time",
)
_DERIVED = "Let the actions that change what it depends on change the predicate, too."
_ORDER = "Write the actions alone, with preconditions that keep their order."
_PRICE = "State as goals what must be, and price what should not be: (increase (total-cost) 5)."
_CONSTRAINT = (
    "Write what must hold as preconditions, and what must have happened as a fact that an action makes true "
    "and the goal asks for."
)
_ONCE = "Let the action change the number once, at its end."
INSTEAD = {
    ":object-fluents": "Write a predicate, (where ?r ?s), and let an action delete the fact that was true.",
    ":preferences": _PRICE,
    "preference": _PRICE,
    ":constraints": _CONSTRAINT,
    ":derived-predicates": _DERIVED,
    ":domain-axioms": _DERIVED,
    ":derived": _DERIVED,
    ":continuous-effects": _ONCE,
    "#t": _ONCE,
    ":process": "Use durative actions.",
    ":event": "Use actions.",
    ":hierarchy": _ORDER,
    ":htn": _ORDER,
    ":task": _ORDER,
    ":method": _ORDER,
    ":contingent": "State what is true at the start; what is not stated is false.",
    ":observe": "State what is true at the start; what is not stated is false.",
    ":length": "Leave it out: it has no effect.",
}
"""What to write instead of known but unsupported PDDL features."""
_PARTS = {
    **dict.fromkeys(("not",), 1),
    **dict.fromkeys(("when", "forall", "exists", "imply", "increase", "decrease", "assign"), 2),
    **dict.fromkeys(("<", ">", "<=", ">=", "="), 2),
}
"""Number of arguments of these keywords: the reader silently drops further ones."""
_NUMBER = re.compile(r"[+-]?[\d.]+([e/][+-]?\d+)?")
_PLAIN_NUMBER = re.compile(r"[+-]?(\d{1,15}(\.\d{0,12})?|\.\d{1,12})")


def refuse_misread(domain: PddlText, problem: PddlText) -> None:
    """Reject the first construct that would be misread.

    Raises:
        InputError: With its location and what to write instead.
    """
    for text, kind, other in ((domain, "domain", "problem"), (problem, "problem", "domain")):
        _refuse_other_file(text, kind, other)
        _refuse_requirements(text)
        for form in text.define.all():
            _refuse_form(text, form)
    for action in domain.actions().values():
        _refuse_twice(domain, action)
    _refuse_other_domain(domain, problem)
    metric = problem.section(":metric")
    for word in (item for item in metric.rest[1:] if item.word) if metric else ():
        raise problem.refused(word, "an expression in brackets", f"'{word}'", "Write (total-cost).")
    _refuse_second_values(problem)


def _refuse_other_file(text: PddlText, kind: str, other: str) -> None:
    head = text.define.rest[0] if text.define.rest else text.define
    expected = f"(define ({kind} NAME) ...)"
    if head.head == other:
        remedy = "Name the domain with --domain and the problem with --problem: they seem to be swapped."
        raise text.refused(head, expected, f"a {other}", remedy)
    if text.define.head != "define" or head.head != kind or len(head.items) != 2 or not head.rest[0].word:
        raise text.refused(text.define, expected, f"'{text.define}'", f"Name the {kind} file.")


def _refuse_requirements(text: PddlText) -> None:
    section = text.section(":requirements")
    for item in section.rest if section else ():
        if item.word not in REQUIREMENTS:
            remedy = INSTEAD.get(item.word) or closest(str(item), REQUIREMENTS)
            raise text.refused(item, "a requirement that can be met", f"'{item}'", remedy)


def _refuse_form(text: PddlText, form: Form) -> None:
    word = form.word if form.word.startswith((":", "#")) else form.head
    if word in INSTEAD:
        raise text.refused(form, "what can be planned with", f"'{word}'", INSTEAD[word])
    if form.head == "either":
        names = " ".join(map(str, form.rest))
        remedy = f"Declare a type above them, (:types {names} - thing), and write '- thing' here."
        raise text.refused(form, "one type", f"'{form}'", remedy)
    if _NUMBER.fullmatch(form.word) and not _PLAIN_NUMBER.fullmatch(form.word):
        expected = "a number such as 12 or 0.5, of at most 15 digits before the point and 12 behind it"
        remedy = "Write it out without an exponent; where it is too large, measure in a larger unit."
        raise text.refused(form, expected, repr(form.word[:40]), remedy)
    wanted = _PARTS.get(form.head, len(form.rest))
    if len(form.rest) != wanted:
        expected = f"{wanted} part{'s' if wanted > 1 else ''} after '{form.head}'"
        raise text.refused(form, expected, str(len(form.rest)), "Check the brackets.")
    if form.head == "when" and (inner := _when(form.rest[1])) is not None:
        remedy = "Write one (when (and ...) ...) with both conditions: the outer one would be forgotten."
        raise text.refused(inner, "one condition around an effect", "a second one inside it", remedy)


def _when(effect: Form) -> Form | None:
    return next((form for form in effect.all() if form.head == "when"), None)


def _refuse_twice(domain: PddlText, action: Form) -> None:
    """Reject a duplicate parameter: the reader would silently drop one of the two."""
    at = next((i for i, item in enumerate(action.items) if item.word == ":parameters"), None)
    listed = action.items[at + 1].items if at is not None and at + 1 < len(action.items) else ()
    seen: set[str] = set()
    for item in (one for one in listed if one.word.startswith("?")):
        if item.word in seen:
            remedy = "Remove or rename one of them."
            raise domain.refused(item, "each parameter once", f"'{item}' again", remedy)
        seen.add(item.word)


def _refuse_other_domain(domain: PddlText, problem: PddlText) -> None:
    section, name = problem.section(":domain"), domain.define.items[1].items[1]
    if section is not None and section.rest and section.rest[0].word != name.word:
        remedy = f"Write (:domain {name}), or name the other domain's file with --domain."
        raise problem.refused(section.rest[0], f"the domain {name}", f"'{section.rest[0]}'", remedy)


def _refuse_second_values(problem: PddlText) -> None:
    """Reject a second value of a function, which would silently override the first."""
    seen: dict[str, Form] = {}
    for function, value in stated_numbers(problem):
        key = " ".join(item.word for item in function.items)
        if key in seen:
            got = f"a second one (the first is at {problem.where(seen[key])})"
            raise problem.refused(function, f"one value of {function}", got, "Remove one of them.")
        seen[key] = value


def stated_numbers(problem: PddlText) -> Iterator[tuple[Form, Form]]:
    """Each function with its value in the initial state."""
    section = problem.section(":init")
    for fact in section.rest if section else ():
        if fact.head == "=" and len(fact.items) == 3:
            yield fact.rest[0], fact.rest[1]
