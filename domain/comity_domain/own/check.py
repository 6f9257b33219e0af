"""Whether everything that a domain and a problem use is declared, and used as it is declared."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from comity_domain.own.declared import OBJECT, Action, Declared, Signature, Typed, typed_list
from comity_domain.own.document import Stated
from comity_domain.own.form import Form, Item, Word, complaint
from comity_fis.errors import InputError, closest

Scope = Mapping[str, str]
"""Variables in scope, with their types."""

_NO_VARIABLES: Scope = {}
_COMPARISONS = ("<", ">", "<=", ">=")
_CHANGES = ("increase", "decrease", "assign", "scale-up", "scale-down")
_TIMES = (("at", "start"), ("at", "end"), ("over", "all"))


def check(domain: Declared, problem: Stated) -> None:
    """Refuse the first use of something that is not declared, or is declared otherwise.

    Raises:
        InputError: with its place.
    """
    _Check(domain, _objects(domain, problem)).all(problem)


def _objects(domain: Declared, problem: Stated) -> dict[str, str]:
    objects = {typed.word.text: typed.type for typed in domain.constants}
    for typed in problem.objects:
        if typed.word.text in objects:
            raise complaint(
                typed.word.where,
                "each object once",
                f"'{typed.word}', which is a constant",
                "Remove it here.",
            )
        objects[typed.word.text] = typed.type
    return objects


@dataclass(frozen=True, slots=True)
class _Check:
    domain: Declared
    objects: Mapping[str, str]

    def all(self, problem: Stated) -> None:
        self.types(problem)
        for action in self.domain.actions:
            self.action(action)
        name = self.domain.name
        if problem.domain.text != name.text:
            raise complaint(
                problem.domain.where,
                f"the domain {name}",
                f"'{problem.domain}'",
                f"Write (:domain {name}), or name the other domain's file with --domain.",
            )
        for fact in problem.init:
            self.fact(fact)
        self.condition(problem.goal, _NO_VARIABLES)
        self.metric(problem.metric)

    def types(self, problem: Stated) -> None:
        parents = self.domain.parents()
        for typed in self.domain.types:
            seen, type_ = [typed.word.text], typed.type
            while type_ != OBJECT:
                if type_ in seen:
                    circle = " - ".join((*seen, type_))
                    raise complaint(
                        typed.word.where, "types without a circle", circle, "Remove one of the types above."
                    )
                seen.append(type_)
                type_ = parents.get(type_, OBJECT)
        declared = (*self.domain.predicates.values(), *self.domain.functions.values(), *self.domain.actions)
        for owner in declared:
            self.typed(owner.parameters)
        self.typed((*self.domain.constants, *problem.objects))

    def typed(self, several: Sequence[Typed]) -> None:
        known = {OBJECT, *self.domain.parents()}
        for typed in several:
            if typed.type not in known:
                where = typed.type_word.where if typed.type_word else typed.word.where
                raise complaint(where, "a declared type", f"'{typed.type}'", closest(typed.type, known))

    def action(self, action: Action) -> None:
        scope = {typed.word.text: typed.type for typed in action.parameters}
        if ":precondition" in action.parts:
            self.condition(action.parts[":precondition"], scope)
        if ":duration" in action.parts:
            self.duration(action.parts[":duration"], scope)
        if ":condition" in action.parts:
            self.timed(action.parts[":condition"], lambda form: self.condition(form, scope))
        if ":effect" in action.parts and action.durative:
            self.timed(action.parts[":effect"], lambda form: self.effect(form, scope))
        elif ":effect" in action.parts:
            self.effect(action.parts[":effect"], scope)

    def timed(self, form: Form, inside: Callable[[Form], None]) -> None:
        """`(and (at start ...) (over all ...))`."""
        if not form.items:
            return
        if form.head == "and":
            for part in form.rest:
                self.timed(_brackets(part), inside)
            return
        times = tuple(str(item).lower() for item in form.items[:2])
        if len(form.items) != 3 or times not in _TIMES:
            raise complaint(
                form.where,
                "(at start ...), (over all ...) or (at end ...)",
                f"'{form}'",
                "Say when it holds.",
            )
        inside(_brackets(form.items[2]))

    def condition(self, form: Form, scope: Scope) -> None:
        match form.head:
            case "" if not form.items:
                return
            case "and" | "or":
                for part in form.rest:
                    self.condition(_brackets(part), scope)
            case "not" | "imply":
                _count(form, 1 if form.head == "not" else 2)
                for part in form.rest:
                    self.condition(_brackets(part), scope)
            case "exists" | "forall":
                self.condition(_brackets(_count(form, 2)[1]), self.bound(form, scope))
            case "=" if all(isinstance(part, Word) and not part.is_number for part in form.rest):
                for part in _count(form, 2):
                    self.argument(part, OBJECT, scope, form)
            case "=" | "<" | ">" | "<=" | ">=":
                for part in _count(form, 2):
                    self.number(part, scope)
            case _:
                self.atom(form, self.domain.predicates, "predicate", scope)

    def bound(self, form: Form, scope: Scope) -> Scope:
        """The scope inside a quantifier."""
        variables = typed_list(_brackets(form.items[1]).items, "a variable", variables=True)
        self.typed(variables)
        return {**scope, **{typed.word.text: typed.type for typed in variables}}

    def effect(self, form: Form, scope: Scope) -> None:
        match form.head:
            case "" if not form.items:
                return
            case "and":
                for part in form.rest:
                    self.effect(_brackets(part), scope)
            case "not":
                self.atom(_brackets(_count(form, 1)[0]), self.domain.predicates, "predicate", scope)
            case "forall":
                self.effect(_brackets(_count(form, 2)[1]), self.bound(form, scope))
            case "when":
                condition, effect = _count(form, 2)
                self.condition(_brackets(condition), scope)
                self.effect(_brackets(effect), scope)
            case "increase" | "decrease" | "assign":
                changed, value = _count(form, 2)
                self.number(_brackets(changed), scope)
                self.number(value, scope)
            case _:
                self.atom(form, self.domain.predicates, "predicate", scope)

    def duration(self, form: Form, scope: Scope) -> None:
        if form.head == "and":
            for part in form.rest:
                self.duration(_brackets(part), scope)
            return
        if form.head not in ("=", *_COMPARISONS) or len(form.items) != 3 or str(form.items[1]) != "?duration":
            raise complaint(form.where, "(= ?duration NUMBER)", f"'{form}'", "Write the duration like this.")
        self.number(form.items[2], scope)

    def number(self, item: Item, scope: Scope) -> None:
        if isinstance(item, Word):
            if not item.is_number and item.text not in self.domain.functions:
                raise complaint(
                    item.where, "a number or a function in brackets", f"'{item}'", "Write 3 or (f ?x)."
                )
        elif item.head in ("+", "-", "*", "/"):
            for part in item.rest:
                self.number(part, scope)
        else:
            self.atom(item, self.domain.functions, "function", scope)

    def atom(self, form: Form, known: Mapping[str, Signature], what: str, scope: Scope) -> None:
        head = form.items[0] if form.items else form
        if not isinstance(head, Word) or head.text not in known:
            raise _undeclared(head, form, known, what)
        signature = known[head.text]
        if len(form.rest) != len(signature.parameters):
            raise complaint(
                form.where,
                f"{_counted(len(signature.parameters), 'argument')} of {what} {head}",
                str(len(form.rest)),
                f"It is declared in line {signature.word.where.line}.",
            )
        for item, parameter in zip(form.rest, signature.parameters, strict=True):
            self.argument(item, parameter.type, scope, form)

    def argument(self, item: Item, wanted: str, scope: Scope, around: Form) -> None:
        if not isinstance(item, Word) or item.is_number:
            raise complaint(item.where, "an object or a variable", f"'{item}'", f"Check '{around}'.")
        known = scope if item.is_variable else self.objects
        if item.text not in known:
            what = "a variable in scope" if item.is_variable else "a declared object"
            raise complaint(item.where, what, f"'{item}'", closest(item.text, known))
        if wanted != OBJECT and not self.domain.is_a(known[item.text], wanted):
            raise complaint(
                item.where,
                f"something of type {wanted} in '{around}'",
                f"'{item}' of type {known[item.text]}",
                "Change the type where it is declared, or name something else.",
            )

    def fact(self, form: Form) -> None:
        """One line of `:init`."""
        if form.head == "=":
            function, value = _count(form, 2)
            self.number(_brackets(function), _NO_VARIABLES)
            if not isinstance(value, Word) or not value.is_number:
                raise complaint(value.where, "a number", f"'{value}'", "Write the number out.")
        elif form.head == "not":
            self.fact(_brackets(_count(form, 1)[0]))
        elif form.head == "at" and len(form.items) == 3 and str(form.items[1])[:1].isdigit():
            inner = _brackets(form.items[2])
            self.effect(inner, _NO_VARIABLES)
        else:
            self.atom(form, self.domain.predicates, "predicate", _NO_VARIABLES)

    def metric(self, items: Sequence[Item]) -> None:
        if not items:
            return
        direction = items[0]
        if len(items) != 2 or str(direction).lower() not in ("minimize", "maximize"):
            raise complaint(
                direction.where, "minimize or maximize and one expression", f"'{direction}'",
                "Write (:metric minimize (total-cost)).",
            )  # fmt: skip
        if str(items[1]).lower() not in ("total-time", "(total-time)"):
            self.number(items[1], _NO_VARIABLES)


def _brackets(item: Item) -> Form:
    if isinstance(item, Form):
        return item
    raise complaint(item.where, "an expression in brackets", f"'{item}'", f"Write ({item}).")


def _count(form: Form, wanted: int) -> tuple[Item, ...]:
    if len(form.rest) == wanted:
        return form.rest
    raise complaint(
        form.where,
        f"{_counted(wanted, 'part')} after '{form.head}'",
        str(len(form.rest)),
        "Check the brackets." if form.head != "not" else "Write (not (...)).",
    )


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _undeclared(head: Item, form: Form, known: Mapping[str, Signature], what: str) -> InputError:
    where = head.where if isinstance(head, Word) else form.where
    if isinstance(head, Word) and head.text in ("preference", "always", "sometime", *_CHANGES, *_TIMES[0]):
        return complaint(where, f"a {what}", f"'{head}'", "It cannot stand here: use what PDDL 2.1 has.")
    remedy = closest(str(head).lower(), chain(known)) if known else f"Declare it under (:{what}s ...)."
    return complaint(where, f"a declared {what}", f"'{head}'", remedy)
