"""Where in the files the things of a problem stand, for complaints that only planning gives rise to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from comity_domain.custom.reading.checks import stated_numbers
from comity_domain.custom.reading.text import Form, PddlText
from comity_fis.errors import Where

TOTAL_COST = "total-cost"
Atom = tuple[str, ...]
"""A function and its objects."""
_CHANGES = ("increase", "decrease", "assign")
_COMPARISONS = ("<", ">", "<=", ">=")
_SUMS = (("minimize", TOTAL_COST), ("minimize", "total-time"))
"""Metrics that are the sum of what actions cost, or their number."""


@dataclass(frozen=True, slots=True)
class DomainPlaces:
    """Of one domain and one problem; names in lower case."""

    domain: PddlText
    problem: PddlText

    @property
    def init(self) -> Where:
        """The section with the initial state."""
        return self.problem.where(self.problem.section(":init") or self.problem.define)

    def of_cost(self, action: str) -> Where:
        """Where an action's cost is stated, or else the action's name."""
        form = self.domain.actions()[action]
        return self.domain.where(next(_costs(form), form.items[1]))

    def numbers(self) -> dict[Atom, Where]:
        """Where the initial state gives functions their values."""
        return {
            tuple(item.word for item in function.items): self.problem.where(value)
            for function, value in stated_numbers(self.problem)
        }

    def beyond(self) -> Where | None:
        """The first thing that is more than classical planning; None where nothing is."""
        metric = self.problem.section(":metric")
        if metric is not None and tuple(one.word for one in metric.all() if one.word)[1:] not in _SUMS:
            return self.problem.where(metric.rest[0])
        for action in self.domain.actions().values():
            if action.head == ":durative-action":
                return self.domain.where(action.items[1])
            if (form := next(_numeric(action), None)) is not None:
                return self.domain.where(form)
        timed = next((one for one in _facts(self.problem) if _is_timed(one)), None)
        goal = self.problem.section(":goal")
        form = timed or (next(_numeric(goal), None) if goal is not None else None)
        return self.problem.where(form) if form is not None else None


def _costs(action: Form) -> Iterator[Form]:
    """Each `(increase (total-cost) ...)`."""
    return (form for form in action.all() if form.head == "increase" and _changed(form) == TOTAL_COST)


def _changed(form: Form) -> str:
    return form.rest[0].head or form.rest[0].word


def _numeric(form: Form) -> Iterator[Form]:
    """Numbers that change, other than the cost, or that are compared."""
    for one in form.all():
        numbers = any(part.items or part.word[:1].isdigit() for part in one.rest)
        if one.head in _COMPARISONS or (one.head == "=" and numbers):
            yield one
        if one.head in _CHANGES and not (one.head == "increase" and _changed(one) == TOTAL_COST):
            yield one


def _facts(problem: PddlText) -> tuple[Form, ...]:
    section = problem.section(":init")
    return section.rest if section else ()


def _is_timed(fact: Form) -> bool:
    return fact.head == "at" and fact.rest[0].word[:1].isdigit()
