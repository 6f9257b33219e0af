"""Sweeps: one parameter as a function of one attribute, with all other facts fixed."""

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
"""Maximum number of people in one sweep; beyond it, a sample with a fixed seed is used."""
MOST_SLOWLY = 5000
"""The same for parameters without a closed form, which take 0.1 ms per person."""

UNSAID = "not disclosed"


@dataclass(frozen=True, slots=True)
class Sweep:
    """One parameter for many people; each row varies one attribute alone."""

    attribute: Attribute
    others: tuple[Attribute, ...]
    """Other attributes that affect the parameter."""
    contexts: NDArray[np.int64]
    """Rows: fixed contexts; columns: indices of the other attributes' values, -1 for undisclosed."""
    values: NDArray[Any]
    """One row per context, one column per value of the attribute."""
    complete: bool
    """Whether all combinations are included."""

    def context(self, row: int) -> dict[str, str]:
        """Known facts of one row, apart from the attribute."""
        return {
            other.name: UNSAID if place < 0 else other.labels[place]
            for other, place in zip(self.others, self.contexts[row].tolist(), strict=True)
        }


def decided_by(rulebook: Rulebook, parameter: str, known: Mapping[str, Attribute]) -> dict[str, Attribute]:
    """The attributes that can change a parameter, also via other parameters and guards."""
    inputs = set(reading(rulebook, rulebook.infer({}), parameter).inputs)
    return {name: attribute for name, attribute in known.items() if inputs & attribute.columns.keys()}


def sweep(rulebook: Rulebook, parameter: str, attribute: Attribute, others: Sequence[Attribute]) -> Sweep:
    """Vary one attribute over all its values, for every combination of the others' levels."""
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
    """Whether all numeric parameters have a closed form."""
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
