"""The paper's three cases of defining a linguistic variable (Bruno et al. 2017, section III).

(a) All is known: every value is a term. (b) The terms are known but not their shapes: stages become
trapezoids. (c) Nothing is known: terms are derived from data.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from math import isfinite
from typing import Literal

from comity_fis.errors import InputError, WrongValueError
from comity_fis.membership.function import Categories, Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.variables.measurement import Coercion, Level, effective_level, level_of
from comity_fis.variables.partitioning import numbers, partition
from comity_fis.variables.scale import too_low
from comity_fis.variables.variable import NominalVariable, NumericVariable, OrdinalVariable, Partition

Kind = Literal["culture", "situation"]

METHOD = (
    "Subtractive clustering (MATLAB's defaults), fuzzy c-means with m = 2, least squares of "
    "a1 exp(-((x-b1)/c1)^2) + a2 exp(-((x-b2)/c2)^2) with a1, a2 at least 0; each term is [a, b, c] twice."
)
HELD = (
    " Held terms: a1, a2 at most 1 and |b1-b2| at most sqrt(2) min(c1, c2), so that there is one peak; "
    "least squares over the degrees that c-means gives the whole range, 0 beyond the neighbours' centres."
)
LEAST_VALUES = 4
"""Minimum number of distinct values (our choice): a scale of five answers, one never given, suffices."""


def all_known(
    name: str,
    categories: Sequence[str],
    *,
    ordered: bool = False,
    numbered_from: int | None = None,
    groups: Mapping[str, Iterable[str]] | None = None,
    kind: Kind = "culture",
    reason: str,
) -> NominalVariable:
    """Case a: the values are categories, and each is a term (gender; ISCED's levels of education).

    Args:
        name: Name of the variable.
        categories: All values, in order if they have one.
        ordered: Whether the level is ordinal rather than nominal.
        numbered_from: Number of the first ordered category, if they are commonly numbered.
        groups: Additional terms for several categories, which must be consecutive if ordered.
        kind: Whether it describes the person or the current situation.
        reason: Source of the categories, or that they are a design choice.

    Raises:
        InputError: A category occurs twice, or the level does not allow a group.
    """
    _check_reason(reason)
    terms = {group: Categories(frozenset(members)) for group, members in (groups or {}).items()}
    words = tuple(categories)
    if odd := [word for word in words if not isinstance(word, str) or not word.strip()]:
        raise WrongValueError(
            expected="categories in words", got=repr(odd[0]), remedy="Name it; `numbered_from` takes numbers."
        )
    if ordered:
        return OrdinalVariable(
            name=name, kind=kind, categories=words, groups=terms, numbered_from=numbered_from, reason=reason
        )
    if numbered_from is not None:
        raise WrongValueError(expected="no numbers for categories without an order", got=numbered_from)
    return NominalVariable(name=name, kind=kind, categories=words, groups=terms, reason=reason)


def terms_known(
    name: str,
    domain: tuple[float, float],
    *,
    terms: Sequence[str],
    boundaries: Sequence[float],
    overlaps: Sequence[float] | float,
    level: Level | str,
    coercion: Coercion | None = None,
    unit: str | None = None,
    kind: Kind = "culture",
    reason: str,
) -> NumericVariable:
    """Case b: the terms and their approximate boundaries are known, but not their shapes (stages of life).

    Between neighbours, degrees change linearly over an interval centred on their boundary, so that the
    degrees of every value add up to 1 and are equal at the boundary.

    Args:
        name: Name of the variable.
        domain: Lowest and highest value, in the unit.
        terms: Names of the terms, ascending.
        boundaries: Boundaries between consecutive terms, ascending, one fewer than terms.
        overlaps: Width of each transition, or one width for all; 0 is a sharp boundary.
        level: Level of measurement; at least interval, if necessary by coercion.
        coercion: Declared treatment at a higher level.
        unit: Unit of the values.
        kind: Whether it describes the person or the current situation.
        reason: Source of boundaries and overlaps, or that they are a design choice.

    Raises:
        InputError: Transitions exceed the domain or overlap, or the level does not allow numbers.
    """
    _check_reason(reason)
    widths = [overlaps] * len(boundaries) if isinstance(overlaps, int | float) else list(overlaps)
    if not len(terms) == len(boundaries) + 1 == len(widths) + 1 or len(set(terms)) < len(terms):
        raise WrongValueError(
            expected="different terms, and one boundary and overlap between each two",
            got=f"{len(terms)} terms, {len(boundaries)} boundaries, {len(widths)} overlaps",
        )
    passages = [(at - width / 2, at + width / 2) for at, width in zip(boundaries, widths, strict=True)]
    low, high = domain
    ends = [(low, low), *passages, (high, high)]
    if not all(start <= end for start, end in passages) or not all(a[1] <= b[0] for a, b in pairwise(ends)):
        raise WrongValueError(expected=f"ascending passages inside {low:g}..{high:g}", got=passages)
    return NumericVariable(
        name=name,
        kind=kind,
        level=level_of(level),
        coercion=coercion,
        domain=Interval(low, high),
        terms={term: Trapezoid(*a, *b) for term, (a, b) in zip(terms, pairwise(ends), strict=True)},
        unit=unit,
        reason=reason,
    )


def from_data(
    name: str,
    values: Iterable[float],
    *,
    radius: float = 0.5,
    domain: tuple[float, float] | None = None,
    level: Level | str,
    coercion: Coercion | None = None,
    unit: str | None = None,
    kind: Kind = "culture",
    data: str = "",
    reason: str,
) -> NumericVariable:
    """Case c: only data are known, from which the terms are derived (individualism).

    Args:
        name: Name of the variable.
        values: One value per case; duplicates count.
        radius: Radius of the subtractive clustering, as a fraction of the data's range.
        domain: Lowest and highest value; None: those of the data.
        level: Level of measurement; at least interval, if necessary by coercion.
        coercion: Declared treatment at a higher level, as in the paper for individualism.
        unit: Unit of the values.
        kind: Whether it describes the person or the current situation.
        data: Name of the data.
        reason: What the values measure, in which population, and their source.

    Raises:
        OneClusterError: The data form only one cluster.
        InputError: The level does not allow distances, or no terms fit the data.
    """
    _check_reason(reason)
    level = level_of(level)
    if effective_level(level, coercion) < Level.INTERVAL:
        raise too_low(name, level, Level.INTERVAL, "partition")
    scores = _enough(name, numbers(values))
    low, high = domain or (min(scores), max(scores))
    whole = _holding(name, scores, Interval(low, high))
    found = partition(scores, radius)
    held = {name: fit.because for name, fit in zip(found.terms, found.fits, strict=True) if fit.because}
    return NumericVariable(
        name=name,
        kind=kind,
        level=level,
        coercion=coercion,
        domain=whole,
        terms=found.terms,
        unit=unit,
        shapes="fitted",
        reason=reason,
        partition=Partition(
            data or f"{len(scores)} values",
            radius,
            found.centres,
            found.squared_errors,
            METHOD + HELD if held else METHOD,
            tuple(fit.largest_error for fit in found.fits),
            held,
        ),
    )


def _enough(name: str, scores: Sequence[float]) -> Sequence[float]:
    if len(set(scores)) < LEAST_VALUES:
        raise InputError(
            expected=f"at least {LEAST_VALUES} different values of {name}",
            got=f"{len(set(scores))} among {len(scores)}",
            remedy="So few say nothing about groups: name the terms yourself (`terms_known`).",
        )
    return scores


def _holding(name: str, scores: Sequence[float], domain: Interval) -> Interval:
    """A range that contains all data."""
    if not isfinite(domain.low) or not isfinite(domain.high):
        raise WrongValueError(
            expected="a finite range", got=domain, remedy="Give its lowest and highest value."
        )
    outside = [score for score in scores if not domain.low <= score <= domain.high]
    if outside:
        raise InputError(
            expected=f"values of {name} in {domain.low:g}..{domain.high:g}",
            got=f"{outside[0]:g}",
            remedy="Widen the range, or correct the value.",
        )
    return domain


def _check_reason(reason: str) -> None:
    if not isinstance(reason, str) or not reason.strip():
        raise WrongValueError(
            expected="a reason: a source, or that it is a design choice",
            got=repr(reason),
            remedy="Say where categories, boundaries or data come from.",
        )
