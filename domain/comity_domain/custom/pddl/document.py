"""A domain file and a problem file taken apart into what they declare and state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain

from comity_domain.custom.pddl.declared import Action, Declared, Signature, Typed
from comity_domain.custom.pddl.form import Form, Item, Word, complaint
from comity_domain.custom.pddl.listing import signatures, typed_list
from comity_domain.custom.pddl.names import each_once, name_of
from comity_domain.custom.pddl.sections import sections
from comity_fis.errors import Where, closest

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
_INSTEAD = {
    ":object-fluents": "Write a predicate, (where ?r ?s), and let an action delete the fact that was true.",
    ":preferences": "State as goals what must be, and price what should not be: (increase (total-cost) 5).",
    ":constraints": "Write what must hold as preconditions, and what must have happened as a fact that an "
    "action makes true and the goal asks for.",
    ":derived-predicates": "Let the actions that change what it depends on change the predicate, too.",
    ":domain-axioms": "Let the actions that change what it depends on change the predicate, too.",
    ":continuous-effects": "Let the action change the number once, at its end.",
    ":hierarchy": "Write the actions alone, with preconditions that keep their order.",
}
"""What to write where a requirement is known, and cannot be met."""
DOMAIN_SECTIONS = (
    ":requirements",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":action",
    ":durative-action",
)
PROBLEM_SECTIONS = (":domain", ":requirements", ":objects", ":init", ":goal", ":metric")
_PARTS = {
    False: (":parameters", ":precondition", ":effect"),
    True: (":parameters", ":duration", ":condition", ":effect"),
}
"""What an action consists of, by whether it is durative."""


@dataclass(frozen=True, slots=True)
class Stated:
    """A problem."""

    name: Word
    domain: Word
    objects: tuple[Typed, ...]
    init: tuple[Form, ...]
    init_where: Where
    goal: Form
    metric: tuple[Item, ...]
    """`minimize` or `maximize` and an expression; empty where there is no metric."""


def as_domain(form: Form) -> Declared:
    """A domain.

    Raises:
        InputError: naming the place of the first thing that is wrong.
    """
    name = _defined(form, "domain", "problem")
    parts = sections(form, "domain", DOMAIN_SECTIONS, several=(":action", ":durative-action"))
    declared = Declared(
        name=name,
        requirements=_requirements(parts),
        types=typed_list(_items(parts, ":types"), "a type", variables=False),
        constants=typed_list(_items(parts, ":constants"), "a constant", variables=False),
        predicates=_by_name(parts, ":predicates", "predicate"),
        functions=_by_name(parts, ":functions", "function"),
        actions=tuple(map(_action, chain(parts.get(":action", ()), parts.get(":durative-action", ())))),
    )
    each_once((typed.word for typed in declared.types), "type")
    each_once((typed.word for typed in declared.constants), "constant")
    each_once((action.word for action in declared.actions), "action")
    each_once(
        (one.word for one in chain(declared.predicates.values(), declared.functions.values())),
        "predicate or function",
    )
    if not declared.actions:
        raise complaint(form.where, "at least one action", "none", "Add (:action NAME ...) to the domain.")
    return declared


def as_problem(form: Form) -> Stated:
    """A problem.

    Raises:
        InputError: naming the place of the first thing that is wrong.
    """
    name = _defined(form, "problem", "domain")
    parts = sections(form, "problem", PROBLEM_SECTIONS)
    _requirements(parts)
    for missing in (":domain", ":init", ":goal"):
        if missing not in parts:
            raise complaint(form.where, f"a section ({missing} ...)", "none", "Add it to the problem.")
    objects = typed_list(_items(parts, ":objects"), "an object", variables=False)
    each_once((typed.word for typed in objects), "object")
    goal = parts[":goal"][0]
    if len(goal.rest) != 1 or not isinstance(goal.rest[0], Form):
        raise complaint(goal.where, "one goal in brackets", f"'{goal}'", "Join several with (and ...).")
    domain = _items(parts, ":domain")
    if len(domain) != 1:
        raise complaint(parts[":domain"][0].where, "the domain's name", "none", "Write (:domain NAME).")
    return Stated(
        name=name,
        domain=name_of(domain[0], "domain"),
        objects=objects,
        init=tuple(_fact(item) for item in _items(parts, ":init")),
        init_where=parts[":init"][0].where,
        goal=goal.rest[0],
        metric=_items(parts, ":metric"),
    )


def _defined(form: Form, kind: str, other: str) -> Word:
    """The name in `(define (kind NAME) ...)`."""
    expected = f"(define ({kind} NAME) ...)"
    head = form.items[1] if len(form.items) > 1 else form
    if form.head != "define" or not isinstance(head, Form) or head.head not in (kind, other):
        raise complaint(form.where, expected, f"'{form}'", f"Name the {kind} file.")
    if head.head == other:
        remedy = "Name the domain with --domain and the problem with --problem: they seem to be swapped."
        raise complaint(head.where, expected, f"a {other}", remedy)
    if len(head.items) != 2:
        raise complaint(head.where, expected, f"'{head}'", f"Give the {kind} one name.")
    return name_of(head.items[1], kind)


def _items(parts: Mapping[str, list[Form]], section: str) -> tuple[Item, ...]:
    return parts[section][0].rest if section in parts else ()


def _requirements(parts: Mapping[str, list[Form]]) -> tuple[Word, ...]:
    words = []
    for item in _items(parts, ":requirements"):
        if not isinstance(item, Word) or item.text not in REQUIREMENTS:
            written = str(item).lower()
            remedy = _INSTEAD.get(written) or closest(written, REQUIREMENTS)
            raise complaint(item.where, "a requirement that can be met", f"'{item}'", remedy)
        words.append(item)
    return tuple(words)


def _by_name(parts: Mapping[str, list[Form]], section: str, what: str) -> Mapping[str, Signature]:
    found = tuple(signatures(parts[section][0] if section in parts else None, what))
    each_once((signature.word for signature in found), what)
    return {signature.word.text: signature for signature in found}


def _fact(item: Item) -> Form:
    if isinstance(item, Form) and item.items:
        return item
    raise complaint(item.where, "a fact such as (at robot kitchen)", f"'{item}'", "Put it into brackets.")


def _action(form: Form) -> Action:
    durative = form.head == ":durative-action"
    if len(form.items) < 2:
        raise complaint(form.where, "an action's name", "nothing", "Name the action.")
    name, known, parts = name_of(form.items[1], "action"), _PARTS[durative], {}
    items = form.items[2:]
    for position in range(0, len(items), 2):
        key = items[position]
        if not isinstance(key, Word) or key.text not in known:
            remedy = closest(str(key).lower(), known) if isinstance(key, Word) else "Check the brackets."
            raise complaint(key.where, f"a part of the action {name}", f"'{key}'", remedy)
        if key.text in parts:
            raise complaint(key.where, f"one {key}", "a second one", "Join the two.")
        value = items[position + 1] if position + 1 < len(items) else None
        if not isinstance(value, Form):
            got = "nothing" if value is None else f"'{value}'"
            raise complaint(key.where, f"brackets after {key}", got, f"Write {key} (...).")
        parts[key.text] = value
    written = parts.pop(":parameters", None)
    parameters = typed_list(written.items if written else (), "a parameter", variables=True)
    each_once((typed.word for typed in parameters), "parameter")
    if durative and ":duration" not in parts:
        raise complaint(form.where, "a :duration", "none", "Write :duration (= ?duration 5).")
    return Action(name, durative, parameters, parts)
