"""Whether everything that a domain and a problem use is declared, and used as it is declared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from comity_domain.custom.pddl.atoms import Scope, brackets, counted_parts
from comity_domain.custom.pddl.declared import OBJECT, Action, Declared
from comity_domain.custom.pddl.document import Stated
from comity_domain.custom.pddl.effects import TOTAL_COST, require_one_cost
from comity_domain.custom.pddl.form import Form, Item, Word, complaint
from comity_domain.custom.pddl.uses import Uses

_NO_VARIABLES: Scope = {}


def check(domain: Declared, problem: Stated) -> None:
    """Refuse the first use of something that is not declared, or is declared otherwise.

    Raises:
        InputError: with its place.
    """
    objects = _objects(domain, problem)
    constants = {typed.word.text: typed.type for typed in domain.constants}
    _Check(domain, Uses(domain, constants, objects), Uses(domain, objects)).all(problem)


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


def _each_value_once(init: Sequence[Form]) -> None:
    """Refuse a second value of a function, which would silently win, and costs that do not start at 0."""
    seen: dict[str, Form] = {}
    for fact in init:
        if fact.head != "=":
            continue
        function, value = fact.rest
        text = str(function).lower()
        if text in seen:
            got = f"a second one (the first is at {seen[text].where})"
            raise complaint(fact.where, f"one value of {function}", got, "Remove one of them.")
        if text == f"({TOTAL_COST})" and float(str(value)) != 0.0:
            remedy = "Write 0, or leave it out: the cost of a plan is what its actions add up to."
            raise complaint(value.where, f"({TOTAL_COST}) to start at 0", f"'{value}'", remedy)
        seen[text] = fact


@dataclass(frozen=True, slots=True)
class _Check:
    domain: Declared
    inside: Uses
    """Of expressions of the domain."""
    uses: Uses
    """Of those of the problem."""

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
        _each_value_once(problem.init)
        self.uses.condition(problem.goal, _NO_VARIABLES)
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
        for signature in (*self.domain.predicates.values(), *self.domain.functions.values()):
            self.uses.typed(signature.parameters)
        for action in self.domain.actions:
            self.uses.typed(action.parameters)
        self.uses.typed((*self.domain.constants, *problem.objects))

    def action(self, action: Action) -> None:
        scope = {typed.word.text: typed.type for typed in action.parameters}
        if ":precondition" in action.parts:
            self.inside.condition(action.parts[":precondition"], scope)
        if ":duration" in action.parts:
            self.inside.duration(action.parts[":duration"], scope)
        if ":condition" in action.parts:
            self.inside.timed(action.parts[":condition"], lambda form: self.inside.condition(form, scope))
        if ":effect" in action.parts and action.durative:
            self.inside.timed(action.parts[":effect"], lambda form: self.inside.effect(form, scope))
        elif ":effect" in action.parts:
            self.inside.effect(action.parts[":effect"], scope)
        if not action.durative:
            require_one_cost(action)

    def fact(self, form: Form) -> None:
        """One line of `:init`."""
        if form.head == "=":
            function, value = counted_parts(form, 2)
            self.uses.number(brackets(function), _NO_VARIABLES)
            if not isinstance(value, Word) or not value.is_number:
                raise complaint(value.where, "a number", f"'{value}'", "Write the number out.")
        elif form.head == "not":
            self.fact(brackets(counted_parts(form, 1)[0]))
        elif form.head == "at" and len(form.items) == 3 and str(form.items[1])[:1].isdigit():
            inner = brackets(form.items[2])
            self.uses.effect(inner, _NO_VARIABLES)
        else:
            self.uses.atom(form, self.domain.predicates, "predicate", _NO_VARIABLES)

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
            self.uses.number(brackets(items[1]), _NO_VARIABLES)
