"""Locations of a problem's parts in its files, for errors found only during planning."""

from __future__ import annotations

from dataclasses import dataclass

from comity_domain.custom.reading.checks import stated_numbers
from comity_domain.custom.reading.text import PddlText
from comity_fis.errors import Where

TOTAL_COST = "total-cost"
Atom = tuple[str, ...]
"""A function and its objects."""


@dataclass(frozen=True, slots=True)
class DomainPlaces:
    """Locations in one domain file and one problem file; names in lower case."""

    domain: PddlText
    problem: PddlText

    def of(self, part: str) -> Where:
        """Location of an action's name, or of a section of the problem."""
        if (action := self.domain.actions().get(part)) is not None:
            return self.domain.where(action.items[1])
        return self.problem.where(self.problem.section(part) or self.problem.define)

    def of_cost(self, action: str) -> Where:
        """Location of an action's cost, or else of its name."""
        form = self.domain.actions()[action]
        increases = (one for one in form.all() if one.head == "increase")
        costs = (one for one in increases if TOTAL_COST in (one.rest[0].head, one.rest[0].word))
        return self.domain.where(next(costs, form.items[1]))

    def numbers(self) -> dict[Atom, Where]:
        """Locations of the initial values of functions."""
        return {
            tuple(item.word for item in function.items): self.problem.where(value)
            for function, value in stated_numbers(self.problem)
        }
