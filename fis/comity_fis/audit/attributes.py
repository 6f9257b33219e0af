"""Attributes: facts about a person or a meeting, as columns of values for batch inference.

Several variables may derive from one fact: a named culture gives its name and its score. An audit varies the
fact, and all of them with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import floor, isnan, log10, nan
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from comity_fis.inference.column import UNDISCLOSED
from comity_fis.scores.population_table import PopulationTable, Score
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook

GRID = 49
"""Number of evenly spaced values over the domain of a number, besides the knots of its terms."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """One fact that can be disclosed, with all its possible values."""

    name: str
    kind: Literal["culture", "situation"]
    labels: tuple[str, ...]
    """Labels of its values: a country's code, a category, a number."""
    columns: Mapping[str, NDArray[Any]]
    """Values of each derived variable: one entry per value of the fact, and a last one for undisclosed;
    numbers, or indices of categories."""
    levels: tuple[int, ...]
    """Indices of representative values, used when another attribute is varied: every word and culture; of a
    number one per term."""

    def facts(self, place: int) -> dict[str, object]:
        """The variables of a person who disclosed the value at an index; missing ones are left out."""
        told = {name: column.item(place) for name, column in self.columns.items()}
        return {
            name: value
            for name, value in told.items()
            if not (isnan(value) if isinstance(value, float) else value == UNDISCLOSED)
        }


def attributes(rulebook: Rulebook) -> dict[str, Attribute]:
    """All facts that can be disclosed, in the order of the variables."""
    groups: dict[str, list[Variable]] = {}
    for variable in rulebook.variables.values():
        fact = variable.derived_from.fact if variable.derived_from else variable.name
        groups.setdefault(fact, []).append(variable)
    return {fact: _attribute(fact, variables) for fact, variables in groups.items()}


def _attribute(fact: str, variables: Sequence[Variable]) -> Attribute:
    first = variables[0]
    if isinstance(first, NumericVariable) and not _table(first):
        return _number(fact, first)
    labels: dict[str, None] = {}
    for variable in variables:
        if table := _table(variable):
            labels |= dict.fromkeys(row.key for row in table.rows)
        elif isinstance(variable, NominalVariable):
            labels |= dict.fromkeys(variable.categories)
    return Attribute(
        name=fact,
        kind=first.kind,
        labels=tuple(labels),
        columns={variable.name: _column(variable, tuple(labels)) for variable in variables},
        levels=tuple(range(len(labels))),
    )


def _table(variable: Variable) -> PopulationTable[Score] | None:
    """The score table that translates the fact; None if the fact is the value itself."""
    return variable.derived_from.table if variable.derived_from else None


def _column(variable: Variable, labels: Sequence[str]) -> NDArray[Any]:
    if isinstance(variable, NominalVariable):
        numbers = {category: i for i, category in enumerate(variable.categories, variable.first_number)}
        return np.array([*(numbers.get(label, UNDISCLOSED) for label in labels), UNDISCLOSED], dtype=np.int64)
    table = _table(variable)
    scores = {row.key: row.value for row in table.rows} if table else {}
    return np.array([*(scores.get(label, nan) for label in labels), nan])


def _number(fact: str, variable: NumericVariable) -> Attribute:
    low, high = variable.domain.ends
    knots = [x for term in variable.terms.values() for x in term.knots if low <= x <= high]
    decimals = max(0, 2 - floor(log10(high - low)))
    even = np.round(np.linspace(low, high, GRID), decimals)
    places = np.unique(np.clip([low, high, *even, *knots], low, high))
    return Attribute(
        name=fact,
        kind=variable.kind,
        labels=tuple(f"{place:.4g}" for place in places),
        columns={variable.name: np.append(places, nan)},
        levels=tuple(
            dict.fromkeys(_middle([term(float(x)) for x in places]) for term in variable.terms.values())
        ),
    )


def _middle(degrees: Sequence[float]) -> int:
    """The middle index of those with the largest degree."""
    best = max(degrees)
    places = [i for i, degree in enumerate(degrees) if best - degree < 1e-9]
    return places[len(places) // 2]
