"""Whether predicates, functions and objects are used as they are declared, and numbers are numbers."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from comity_domain.custom.pddl.declared import OBJECT, Declared, Signature, Typed
from comity_domain.custom.pddl.form import Form, Item, Word, complaint
from comity_fis.errors import InputError, closest

Scope = Mapping[str, str]
"""Variables in scope, with their types."""

TIMES = (("at", "start"), ("at", "end"), ("over", "all"))
"""When something of a durative action holds."""
_CHANGES = ("increase", "decrease", "assign", "scale-up", "scale-down")


@dataclass(frozen=True, slots=True)
class Atoms:
    """Checks the smallest expressions; whatever is wrong raises an `InputError` at its place."""

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

    def type_of(self, item: Item, scope: Scope) -> str:
        """Of an object or a variable that is known."""
        text = str(item).lower()
        return scope[text] if text in scope else self.objects[text]

    def number(self, item: Item, scope: Scope) -> None:
        """A numeric expression."""
        if isinstance(item, Word):
            if not item.is_number and item.text not in self.domain.functions:
                remedy = "Write 3 or (f ?x)."
                if item.text == "?duration":
                    remedy = f"Write here what stands under :duration, as in (= ?duration 10). {remedy}"
                raise complaint(item.where, "a number or a function in brackets", f"'{item}'", remedy)
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
    if isinstance(head, Word) and head.text in ("preference", "always", "sometime", *_CHANGES, *TIMES[0]):
        return complaint(where, f"a {what}", f"'{head}'", "It cannot stand here: use what PDDL 2.1 has.")
    remedy = closest(str(head).lower(), chain(known)) if known else f"Declare it under (:{what}s ...)."
    return complaint(where, f"a declared {what}", f"'{head}'", remedy)
