"""Sweeps: one parameter while only one attribute changes, for everybody in whom the rest stays as it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.audit.attributes import Attribute
from comity_fis.rulebook.dependencies import reading
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.rulebook.rulebook import Rulebook

MOST = 50_000
"""People in one sweep; of more, a sample with a fixed seed is taken."""
MOST_SLOWLY = 5000
"""The same where a parameter has no closed form: a person then takes 0.1 ms."""

UNSAID = "not disclosed"


@dataclass(frozen=True, slots=True)
class Sweep:
    """One parameter of many people, in rows that differ in one attribute alone."""

    attribute: Attribute
    others: tuple[Attribute, ...]
    """What else decides the parameter."""
    contexts: NDArray[np.int64]
    """Rows: what is the same along a row of values; columns: places of the other attributes' values, -1 for
    not disclosed."""
    values: NDArray[Any]
    """One row per context, one column per value of the attribute."""
    complete: bool
    """Whether every combination is there."""

    def context(self, row: int) -> dict[str, str]:
        """What is known in one row beside the attribute."""
        return {
            other.name: UNSAID if place < 0 else other.labels[place]
            for other, place in zip(self.others, self.contexts[row].tolist(), strict=True)
        }


def decided_by(rulebook: Rulebook, parameter: str, known: Mapping[str, Attribute]) -> dict[str, Attribute]:
    """The attributes that can change a parameter, also through other parameters and through guards."""
    inputs = set(reading(rulebook, rulebook.infer({}), parameter).inputs)
    return {name: attribute for name, attribute in known.items() if inputs & attribute.columns.keys()}


def sweep(rulebook: Rulebook, parameter: str, attribute: Attribute, others: Sequence[Attribute]) -> Sweep:
    """Change one attribute over all its values, for every combination of the others' levels."""
    choices = [np.array([-1, *other.levels]) for other in others]
    width = len(attribute.labels)
    contexts, complete = combinations(choices, max(1, (MOST if is_quick(rulebook) else MOST_SLOWLY) // width))
    columns = {
        name: np.repeat(column[contexts[:, i]], width)
        for i, other in enumerate(others)
        for name, column in other.columns.items()
    }
    columns |= {name: np.tile(column[:-1], len(contexts)) for name, column in attribute.columns.items()}
    values = rulebook.infer_many(columns)[parameter]
    return Sweep(attribute, tuple(others), contexts, values.reshape(len(contexts), width), complete)


def is_quick(rulebook: Rulebook) -> bool:
    """Whether every number has a closed form."""
    return all(
        block.form is not None
        for block in rulebook.program.blocks.values()
        if isinstance(block.parameter, NumericParameter)
    )


def combinations(choices: Sequence[NDArray[np.int64]], most: int) -> tuple[NDArray[np.int64], bool]:
    """All ways to take one of each, as rows, and whether they are all: beyond `most`, a sample with seed 0.

    The first row takes the first of each.
    """
    if not choices:
        return np.empty((1, 0), dtype=np.int64), True
    if prod(len(each) for each in choices) <= most:
        return np.stack(np.meshgrid(*choices, indexing="ij"), axis=-1).reshape(-1, len(choices)), True
    source = np.random.default_rng(0)
    drawn = np.stack([source.choice(each, most) for each in choices], axis=1)
    drawn[0] = [each[0] for each in choices]
    return drawn, False
