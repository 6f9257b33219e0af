"""Where in the files the things of a problem stand, for complaints that only planning gives rise to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from comity_domain.custom.pddl.declared import Action, Declared
from comity_domain.custom.pddl.document import Stated
from comity_domain.custom.pddl.effects import TOTAL_COST, cost_increases
from comity_domain.custom.pddl.form import Form, Item, Word
from comity_domain.custom.pddl.normal import Renaming
from comity_fis.errors import Where

Atom = tuple[str, ...]
"""A function and its objects, as the problem names them."""


@dataclass(frozen=True, slots=True)
class Places:
    """By names of the problem, which may not be those of the files."""

    init: Where
    """The section with the initial state."""
    actions: Mapping[str, Where]
    costs: Mapping[str, Where]
    """Where each action that has a cost of its own states it."""
    functions: Mapping[str, Where]
    numbers: Mapping[Atom, Where]
    """Where the initial state gives a function its value."""
    beyond: Where | None
    """The first thing that is more than classical planning; None where nothing is."""
    computed: Where | None
    """The first change of a number by anything but a number, beside the cost; None where there is none."""

    def of_cost(self, action: str) -> Where:
        """Where an action's cost is stated, or else the action."""
        return self.costs.get(action, self.actions[action])


def places(domain: Declared, problem: Stated, names: Renaming) -> Places:
    """The places of a domain and a problem.

    Args:
        domain: What it declares.
        problem: What it states.
        names: What is called otherwise in the problem.
    """
    actions = {names.actions.get(action.word.text, action.word.text): action for action in domain.actions}
    found = {name: _cost(action) for name, action in actions.items()}
    return Places(
        init=problem.init_where,
        actions={name: action.word.where for name, action in actions.items()},
        costs={name: where for name, where in found.items() if where is not None},
        functions={name: one.word.where for name, one in domain.functions.items()},
        numbers=dict(_numbers(problem, names)),
        beyond=next(_beyond(domain, problem), None),
        computed=next(_computed(domain), None),
    )


def _numbers(problem: Stated, names: Renaming) -> Iterator[tuple[Atom, Where]]:
    for fact in problem.init:
        if fact.head == "=":
            function, value = fact.rest
            words = [item.text for item in _words(function)]
            yield (words[0], *(names.objects.get(word, word) for word in words[1:])), value.where


def _words(item: Item) -> Iterator[Word]:
    if isinstance(item, Word):
        yield item
    else:
        yield from (part for part in item.items if isinstance(part, Word))


def _cost(action: Action) -> Where | None:
    """Where an action states its cost."""
    effect = action.parts.get(":effect")
    return next((form.where for form, _ in cost_increases(effect)), None) if effect is not None else None


CHANGES = ("increase", "decrease", "assign", "scale-up", "scale-down")
COMPARISONS = ("<", ">", "<=", ">=")


def _beyond(domain: Declared, problem: Stated) -> Iterator[Where]:
    """What is more than classical planning, in the order of the files."""
    if problem.metric and _words_of(problem.metric) not in SUMS:
        yield problem.metric[0].where
    for action in domain.actions:
        if action.durative:
            yield action.word.where
        for part in action.parts.values():
            yield from _numeric(part)
    for fact in problem.init:
        if fact.head == "at" and str(fact.rest[0])[:1].isdigit():
            yield fact.where
    yield from _numeric(problem.goal)


def _computed(domain: Declared) -> Iterator[Where]:
    for action in domain.actions:
        effect = action.parts.get(":effect")
        costs = {id(form) for form, _ in cost_increases(effect)} if effect is not None else set()
        for form in _changes(effect) if effect is not None else ():
            by = form.items[-1]
            if id(form) not in costs and not (isinstance(by, Word) and by.is_number):
                yield by.where


def _changes(form: Form) -> Iterator[Form]:
    if form.head in CHANGES:
        yield form
    for part in form.items:
        if isinstance(part, Form):
            yield from _changes(part)


SUMS = (["minimize", TOTAL_COST], ["minimize", "total-time"])
"""Metrics that are the sum of what actions cost, or their number."""


def _words_of(metric: Sequence[Item]) -> list[str]:
    return [str(item).lower().strip("()") for item in metric]


def _numeric(form: Form) -> Iterator[Where]:
    """Numbers that change, but what is added to the cost, or that are compared."""
    compared = form.head == "=" and any(isinstance(part, Form) or part.is_number for part in form.rest)
    if compared or form.head in COMPARISONS:
        yield form.where
    if form.head in CHANGES:
        added = any(one is form for one, _ in cost_increases(form))
        if not added or TOTAL_COST in str(form.items[-1]).lower():
            yield form.where
    conditional = form.head == "when"
    for part in form.items:
        if isinstance(part, Form):
            yield from (one.where for one, _ in cost_increases(part) if conditional)
            yield from _numeric(part)
