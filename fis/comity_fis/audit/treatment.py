"""Differences in treatment between people who differ in one attribute alone."""

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
"""Values closer than this share of the parameter's range count as equal treatment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect(Record):
    """The effect of one attribute on one parameter, all else being equal."""

    parameter: str
    attribute: str
    people: int
    """Number of combinations of the other relevant facts that were tried."""
    complete: bool
    """Whether these are all combinations of levels, not a sample."""
    changed: float
    """Share of them for which the attribute makes a difference."""
    largest: float | None
    """Largest range of the value, in the parameter's unit; None for a nominal parameter."""
    median: float | None
    relative: float | None
    """Largest range as a share of the range that the rules can give."""
    words: int | None
    """For a nominal parameter, the largest number of different words for one person."""


@dataclass(frozen=True, slots=True)
class UnequalPair(Record):
    """Two people who differ in one attribute alone, and are treated differently."""

    first: str
    second: str
    """Values of the attribute."""
    otherwise: Mapping[str, str]
    """The facts that they share."""
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
    """Share of pairs that are treated differently."""
    largest: float | None
    """Difference, in the parameter's unit; None for a nominal parameter."""
    median: float | None
    example: UnequalPair | None
    """The pair with the largest difference, or the first that differs; None where all are treated alike."""


def effect(parameter: Parameter, swept: Sweep) -> Effect:
    """Effect on a parameter when the attribute takes all its values."""
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
    """Compare every pair of values of the attribute, all else being equal."""
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
