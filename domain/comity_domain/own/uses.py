"""Whether an expression uses what is declared as it is declared."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from comity_domain.own.declared import OBJECT, Declared, Signature, Typed
from comity_domain.own.form import Form, Item, Word, complaint
from comity_domain.own.listing import typed_list
from comity_domain.own.names import each_once
from comity_fis.errors import InputError, closest

Scope = Mapping[str, str]
"""Variables in scope, with their types."""

_COMPARISONS = ("<", ">", "<=", ">=")
_CHANGES = ("increase", "decrease", "assign", "scale-up", "scale-down")
_TIMES = (("at", "start"), ("at", "end"), ("over", "all"))


@dataclass(frozen=True, slots=True)
class Uses:
    """Checks expressions; whatever is wrong raises an `InputError` at its place."""

    domain: Declared
    objects: Mapping[str, str]
    """With their types."""
    of_problem: Collection[str] = ()
    """Objects that are declared where these expressions cannot know of them."""

    def typed(self, several: Sequence[Typed]) -> None:
        """Types behind names."""
        known = {OBJECT, *self.domain.parents()}
        for typed in several:
            if typed.type not in known:
                where = typed.type_word.where if typed.type_word else typed.word.where
                raise complaint(where, "a declared type", f"'{typed.type}'", closest(typed.type, known))

    def timed(self, form: Form, inside: Callable[[Form], None]) -> None:
        """`(and (at start ...) (over all ...))`."""
        if not form.items:
            return
        if form.head == "and":
            for part in form.rest:
                self.timed(brackets(part), inside)
            return
        times = tuple(str(item).lower() for item in form.items[:2])
        if len(form.items) != 3 or times not in _TIMES:
            raise complaint(
                form.where,
                "(at start ...), (over all ...) or (at end ...)",
                f"'{form}'",
                "Say when it holds.",
            )
        inside(brackets(form.items[2]))

    def condition(self, form: Form, scope: Scope) -> None:
        """A condition of an action, or a goal."""
        match form.head:
            case "" if not form.items:
                return
            case "and" | "or" | "not" | "imply":
                number = {"not": 1, "imply": 2}.get(form.head, len(form.rest))
                for part in counted_parts(form, number):
                    self.condition(brackets(part), scope)
            case "exists" | "forall":
                self.condition(brackets(counted_parts(form, 2)[1]), self.bound(form, scope))
            case "=" | "<" | ">" | "<=" | ">=":
                self.comparison(form, scope)
            case _:
                self.atom(form, self.domain.predicates, "predicate", scope)

    def comparison(self, form: Form, scope: Scope) -> None:
        """Of numbers, or whether two objects are the same."""
        parts = counted_parts(form, 2)
        if form.head == "=" and all(isinstance(part, Word) and not part.is_number for part in parts):
            for part in parts:
                self.argument(part, OBJECT, scope, form)
            self.comparable(form, *(self.type_of(part, scope) for part in parts))
        else:
            for part in parts:
                self.number(part, scope)

    def comparable(self, form: Form, one: str, other: str) -> None:
        """Two types, one of which is the other's or above it: nothing else can be the same."""
        if not (self.domain.is_a(one, other) or self.domain.is_a(other, one)):
            remedy = "They are never the same: remove the comparison, or change a type where it is declared."
            raise complaint(form.where, f"two of one type in '{form}'", f"{one} and {other}", remedy)

    def type_of(self, item: Item, scope: Scope) -> str:
        """Of an object or a variable that is known."""
        text = str(item).lower()
        return scope[text] if text in scope else self.objects[text]

    def bound(self, form: Form, scope: Scope) -> Scope:
        """The scope inside a quantifier."""
        written = brackets(form.items[1])
        variables = typed_list(written.items, "a variable", variables=True)
        if not variables:
            raise complaint(written.where, f"a variable behind {form.head}", "none", "Name one, as in (?x).")
        each_once((typed.word for typed in variables), "variable")
        self.typed(variables)
        return {**scope, **{typed.word.text: typed.type for typed in variables}}

    def effect(self, form: Form, scope: Scope) -> None:
        """An effect."""
        match form.head:
            case "" if not form.items:
                return
            case "and":
                for part in form.rest:
                    self.effect(brackets(part), scope)
            case "not":
                self.atom(brackets(counted_parts(form, 1)[0]), self.domain.predicates, "predicate", scope)
            case "forall":
                inner = brackets(counted_parts(form, 2)[1])
                _refuse_nested(inner)
                self.effect(inner, self.bound(form, scope))
            case "when":
                condition, effect = counted_parts(form, 2)
                self.condition(brackets(condition), scope)
                self.effect(brackets(effect), scope)
            case "increase" | "decrease" | "assign":
                changed, value = counted_parts(form, 2)
                self.number(brackets(changed), scope)
                self.number(value, scope)
            case _:
                self.atom(form, self.domain.predicates, "predicate", scope)

    def duration(self, form: Form, scope: Scope) -> None:
        """What bounds a duration."""
        if form.head == "and":
            for part in form.rest:
                self.duration(brackets(part), scope)
            return
        if form.head not in ("=", *_COMPARISONS) or len(form.items) != 3 or str(form.items[1]) != "?duration":
            raise complaint(form.where, "(= ?duration NUMBER)", f"'{form}'", "Write the duration like this.")
        self.number(form.items[2], scope)

    def number(self, item: Item, scope: Scope) -> None:
        """A numeric expression."""
        if isinstance(item, Word):
            if not item.is_number and item.text not in self.domain.functions:
                raise complaint(
                    item.where, "a number or a function in brackets", f"'{item}'", "Write 3 or (f ?x)."
                )
        elif item.head in ("+", "-", "*", "/"):
            self.reckoned(item)
            for part in item.rest:
                self.number(part, scope)
        else:
            self.atom(item, self.domain.functions, "function", scope)

    def reckoned(self, form: Form) -> None:
        """How many numbers an operation takes, and that none is divided by 0."""
        if not form.rest:
            raise complaint(form.where, f"a number after '{form.head}'", "none", f"Write ({form.head} 3 4).")
        if form.head == "-" and len(form.rest) > 1:
            counted_parts(form, 2)
        if form.head == "/":
            divisor = counted_parts(form, 2)[1]
            if isinstance(divisor, Word) and divisor.is_number and float(divisor.written) == 0.0:
                raise complaint(divisor.where, "a divisor that is not 0", f"'{divisor}'", "Write another.")

    def atom(self, form: Form, known: Mapping[str, Signature], what: str, scope: Scope) -> None:
        """A predicate or a function with its arguments."""
        head = form.items[0] if form.items else form
        if not isinstance(head, Word) or head.text not in known:
            raise _undeclared(head, form, known, what)
        signature = known[head.text]
        if len(form.rest) != len(signature.parameters):
            raise complaint(
                form.where,
                f"{_counted(len(signature.parameters), 'argument')} of {what} {head}",
                str(len(form.rest)),
                f"It is declared at {signature.word.where}.",
            )
        for item, parameter in zip(form.rest, signature.parameters, strict=True):
            self.argument(item, parameter.type, scope, form)

    def argument(self, item: Item, wanted: str, scope: Scope, around: Form) -> None:
        """An object or a variable of the type that is wanted."""
        if not isinstance(item, Word) or item.is_number:
            raise complaint(item.where, "an object or a variable", f"'{item}'", f"Check '{around}'.")
        known = scope if item.is_variable else self.objects
        if item.text not in known:
            what = "a variable in scope" if item.is_variable else "a declared object"
            remedy = closest(item.text, known)
            if item.text in self.of_problem:
                what, remedy = "a constant of the domain", "Move it from the problem into (:constants ...)."
            raise complaint(item.where, what, f"'{item}'", remedy)
        if wanted != OBJECT and not self.domain.is_a(known[item.text], wanted):
            raise complaint(
                item.where,
                f"something of type {wanted} in '{around}'",
                f"'{item}' of type {known[item.text]}",
                "Change the type where it is declared, or name something else.",
            )


def _refuse_nested(effect: Form) -> None:
    """Effects for all of many things inside such effects: unified-planning does not take them."""
    for part in effect.rest[1:] if effect.head == "when" else effect.rest:
        if isinstance(part, Form):
            _refuse_nested(part)
    if effect.head == "forall":
        remedy = "Join the two: (forall (?x - one ?y - other) ...)."
        raise complaint(effect.where, "one forall around an effect", "a second one inside it", remedy)


def brackets(item: Item) -> Form:
    """What must be a form."""
    if isinstance(item, Form):
        return item
    raise complaint(item.where, "an expression in brackets", f"'{item}'", f"Write ({item}).")


def counted_parts(form: Form, wanted: int) -> tuple[Item, ...]:
    """The parts behind a head, which must be so many."""
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
