"""Another planner, uniform-cost search over typed STRIPS with costs; it shares no code with the packages."""

from __future__ import annotations

import heapq
import itertools
import re
from dataclasses import dataclass, field
from typing import Any


def forms(text: str) -> Any:
    """Nested lists of words."""
    words = re.findall(r"[()]|[^\s()]+", re.sub(r";.*", "", text).lower())
    stack: list[list[Any]] = [[]]
    for word in words:
        if word == "(":
            stack.append([])
        elif word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(word)
    return stack[0][0]


def typed(words: list[str]) -> list[tuple[str, str]]:
    found, group = [], []
    items = iter(words)
    for word in items:
        if word == "-":
            above = next(items)
            found += [(name, above) for name in group]
            group = []
        else:
            group.append(word)
    return found + [(name, "object") for name in group]


@dataclass
class Task:
    """A domain and a problem."""

    actions: list[Any]
    above: dict[str, str]
    objects: dict[str, str]
    facts: frozenset[tuple[str, ...]]
    numbers: dict[tuple[str, ...], int]
    goal: list[Any]
    by_type: dict[str, list[str]] = field(default_factory=dict)

    def of_type(self, type_: str) -> list[str]:
        def is_a(name: str | None) -> bool:
            return name is not None and (name == type_ or is_a(self.above.get(name)))

        return [name for name, own in self.objects.items() if type_ == "object" or is_a(own)]


def read(domain: str, problem: str) -> Task:
    parts = {part[0]: part[1:] for part in forms(domain)[2:] if part[0] != ":action"}
    stated = {part[0]: part[1:] for part in forms(problem)[2:]}
    facts, numbers = set(), {}
    for fact in stated[":init"]:
        if fact[0] == "=":
            numbers[tuple(fact[1])] = int(fact[2])  # whole numbers, or this fails
        else:
            facts.add(tuple(fact))
    return Task(
        actions=[part for part in forms(domain)[2:] if part[0] == ":action"],
        above=dict(typed(parts.get(":types", []))),
        objects=dict(typed(parts.get(":constants", [])) + typed(stated.get(":objects", []))),
        facts=frozenset(facts),
        numbers=numbers,
        goal=stated[":goal"][0],
    )


def cheapest(domain: str, problem: str) -> int | None:
    """The least cost; None where there is no plan."""
    task = read(domain, problem)
    steps = [step for action in task.actions for step in _grounded(task, action)]
    tie = itertools.count()
    queue, seen = [(0, next(tie), task.facts)], set()
    while queue:
        cost, _, state = heapq.heappop(queue)
        if state in seen:
            continue
        seen.add(state)
        if _holds(task.goal, {}, state):
            return cost
        for conditions, added, removed, price in steps:
            if all(_holds(one, {}, state) for one in conditions):
                after = (state - removed) | added
                heapq.heappush(queue, (cost + price, next(tie), after))
    return None


def _grounded(task: Task, action: Any) -> Any:
    parts = dict(zip(action[2::2], action[3::2], strict=True))
    variables = typed(parts[":parameters"])
    for names in itertools.product(*(task.of_type(type_) for _, type_ in variables)):
        bound = dict(zip((name for name, _ in variables), names, strict=True))
        added, removed, price = set(), set(), 0
        for effect in _flat(parts[":effect"]):
            if effect[0] == "increase":
                amount = effect[2]
                value = int(amount) if isinstance(amount, str) else task.numbers.get(_put(amount, bound))
                price = None if value is None or price is None else price + value
            elif effect[0] == "not":
                removed.add(_put(effect[1], bound))
            else:
                added.add(_put(effect, bound))
        if price is not None:
            conditions = [_put_all(one, bound) for one in _flat(parts.get(":precondition", []))]
            yield conditions, frozenset(added), frozenset(removed), price


def _flat(form: Any) -> list[Any]:
    if not form:
        return []
    return [inner for part in form[1:] for inner in _flat(part)] if form[0] == "and" else [form]


def _put(form: Any, bound: dict[str, str]) -> tuple[str, ...]:
    return tuple(bound.get(word, word) for word in form)


def _put_all(form: Any, bound: dict[str, str]) -> Any:
    return [_put_all(one, bound) if isinstance(one, list) else bound.get(one, one) for one in form]


def _holds(form: Any, bound: dict[str, str], state: frozenset[tuple[str, ...]]) -> bool:
    if form[0] == "and":
        return all(_holds(part, bound, state) for part in form[1:])
    if form[0] == "not":
        return not _holds(form[1], bound, state)
    if form[0] == "=":
        return bool(form[1] == form[2])
    return tuple(form) in state
