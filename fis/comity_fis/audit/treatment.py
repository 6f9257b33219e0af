"""How differently people are treated who differ in one attribute alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.record import Record
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.audit.sweep import Sweep
    from comity_fis.variables.parameter import Parameter

ALIKE = 1e-9
"""Numbers closer than that share of the parameter's range are one treatment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect(Record):
    """What one attribute can do to one parameter, everything else being equal."""

    parameter: str
    attribute: str
    people: int
    """For whom it was tried: combinations of what else decides the parameter."""
    complete: bool
    """Whether these are all combinations of levels, and not a sample."""
    changed: float
    """The share of them whose treatment depends on the attribute."""
    largest: float | None
    """Of the ranges of the value, in the parameter's unit; None for a nominal parameter."""
    median: float | None
    relative: float | None
    """The largest range as a share of what the rules can give."""
    words: int | None
    """Of a nominal parameter, the most different words that one person can get."""


@dataclass(frozen=True, slots=True)
class UnequalPair(Record):
    """Two people who differ in one attribute alone, and are treated differently."""

    first: str
    second: str
    """Their values of the attribute."""
    otherwise: Mapping[str, str]
    """What is the same about them."""
    first_value: float | str
    second_value: float | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Pairs(Record):
    """All pairs of people who differ in one attribute alone."""

    parameter: str
    attribute: str
    pairs: int
    complete: bool
    differing: float
    """The share of pairs that are not treated alike."""
    largest: float | None
    """Difference, in the parameter's unit; None for a nominal parameter."""
    median: float | None
    example: UnequalPair | None
    """The pair with the largest difference, or the first that differs; None where all are treated alike."""


def effect(parameter: Parameter, swept: Sweep) -> Effect:
    """How far a parameter moves when the attribute takes all its values."""
    numeric = isinstance(parameter, NumericParameter)
    values = swept.values
    if numeric:
        ranges = values.max(axis=1) - values.min(axis=1)
        changed = ranges > _alike(parameter)
    else:
        ranges = np.array([len(set(row)) for row in values.tolist()])
        changed = ranges > 1
    return Effect(
        parameter=parameter.name,
        attribute=swept.attribute.name,
        people=len(values),
        complete=swept.complete,
        changed=float(changed.mean()),
        largest=float(ranges.max()) if numeric else None,
        median=float(np.median(ranges)) if numeric else None,
        relative=float(ranges.max()) / _width(parameter) if numeric else None,
        words=None if numeric else int(ranges.max()),
    )


def pairs(parameter: Parameter, swept: Sweep) -> Pairs:
    """Every pair of values of the attribute, for everybody else being equal."""
    numeric = isinstance(parameter, NumericParameter)
    first, second = np.triu_indices(len(swept.attribute.labels), k=1)
    one, other = swept.values[:, first], swept.values[:, second]
    apart = np.abs(one - other) if numeric else (one != other).astype(np.float64)
    differing = apart > (_alike(parameter) if numeric else 0)
    example = None
    if apart.size and differing.any():
        row, pair = np.unravel_index(int(apart.argmax()), apart.shape)
        example = _example(swept, int(row), int(first[pair]), int(second[pair]))
    return Pairs(
        parameter=parameter.name,
        attribute=swept.attribute.name,
        pairs=int(apart.size),
        complete=swept.complete,
        differing=float(differing.mean()) if apart.size else 0.0,
        largest=float(apart.max(initial=0)) if numeric else None,
        median=(float(np.median(apart)) if apart.size else 0.0) if numeric else None,
        example=example,
    )


def _example(swept: Sweep, row: int, first: int, second: int) -> UnequalPair:
    values: NDArray[Any] = swept.values[row]
    labels = swept.attribute.labels
    return UnequalPair(
        labels[first], labels[second], swept.context(row), _plain(values[first]), _plain(values[second])
    )


def _plain(value: Any) -> float | str:
    return value if isinstance(value, str) else float(value)


def _width(parameter: Parameter) -> float:
    assert isinstance(parameter, NumericParameter)
    return parameter.rules.high - parameter.rules.low


def _alike(parameter: Parameter) -> float:
    return ALIKE * _width(parameter)
