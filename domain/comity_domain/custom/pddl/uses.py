"""Whether conditions, effects and durations are put together as PDDL has them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from comity_domain.custom.pddl.atoms import TIMES, Atoms, Scope, brackets, counted_parts
from comity_domain.custom.pddl.declared import OBJECT
from comity_domain.custom.pddl.form import Form, Word, complaint
from comity_domain.custom.pddl.listing import typed_list
from comity_domain.custom.pddl.names import each_once

_COMPARISONS = ("<", ">", "<=", ">=")


@dataclass(frozen=True, slots=True)
class Uses(Atoms):
    """Checks what atoms and numbers are joined to; whatever is wrong raises an `InputError` at its place."""

    def timed(self, form: Form, inside: Callable[[Form], None]) -> None:
        """`(and (at start ...) (over all ...))`."""
        if not form.items:
            return
        if form.head == "and":
            for part in form.rest:
                self.timed(brackets(part), inside)
            return
        times = tuple(str(item).lower() for item in form.items[:2])
        if len(form.items) != 3 or times not in TIMES:
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


def _refuse_nested(effect: Form) -> None:
    """Effects for all of many things inside such effects: unified-planning does not take them."""
    for part in effect.rest[1:] if effect.head == "when" else effect.rest:
        if isinstance(part, Form):
            _refuse_nested(part)
    if effect.head == "forall":
        remedy = "Join the two: (forall (?x - one ?y - other) ...)."
        raise complaint(effect.where, "one forall around an effect", "a second one inside it", remedy)
