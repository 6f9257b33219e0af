"""Contradictions: rules that fire together for one person with incompatible conclusions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations as pairs_of
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.audit.coverage import said
from comity_fis.audit.sweep import combinations, decided_by
from comity_fis.record import Record
from comity_fis.variables.parameter import NumericParameter

if TYPE_CHECKING:
    from comity_fis.audit.attributes import Attribute
    from comity_fis.inference.value import FiredRule
    from comity_fis.membership.function import NumericMembership
    from comity_fis.membership.interval import Interval
    from comity_fis.rulebook.rulebook import Rulebook
    from comity_fis.variables.parameter import Parameter

HALF = 0.5
"""Two rules contradict each other if both fire with more than this strength, and no value belongs to both
conclusions to more than this degree (our choice). Neighbouring terms that cross at 0.5 do not contradict."""
MOST = 2000
"""Maximum number of combinations tried per parameter; beyond it, a sample with a fixed seed is used."""
POINTS = 401


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict(Record):
    """Two rules that fire together with incompatible conclusions."""

    parameter: str
    first: int
    """Number of a rule."""
    second: int
    first_term: str
    second_term: str
    people: int
    """Number of tried people for whom both fire with more than 0.5."""
    tried: int
    strength: float
    """Largest strength of the weaker rule."""
    example: Mapping[str, str]
    """Facts about an example person."""


def conflicts(rulebook: Rulebook, known: Mapping[str, Attribute]) -> tuple[Conflict, ...]:
    """Search all fully known people for conflicts, parameter by parameter."""
    return tuple(
        conflict
        for parameter in rulebook.parameters.values()
        for conflict in _of_parameter(rulebook, parameter, decided_by(rulebook, parameter.name, known))
    )


def _of_parameter(
    rulebook: Rulebook, parameter: Parameter, decides: Mapping[str, Attribute]
) -> Iterator[Conflict]:
    people, _ = combinations([np.array(attribute.levels) for attribute in decides.values()], MOST)
    excluding: dict[tuple[str, str], bool] = {}
    found: dict[tuple[int, str, int, str], list[tuple[float, int]]] = {}
    for person, places in enumerate(people.tolist()):
        for one, other in pairs_of(_holding(rulebook, parameter, decides, places), 2):
            terms = (one[1], other[1])
            if terms not in excluding:
                excluding[terms] = _exclude(parameter, *terms)
            if excluding[terms]:
                first, second = sorted((one, other), key=lambda held: held[0].rule.number)
                key = (first[0].rule.number, first[1], second[0].rule.number, second[1])
                found.setdefault(key, []).append((min(one[0].strength, other[0].strength), -person))
    for (first_rule, first_term, second_rule, second_term), held in sorted(found.items()):
        strength, person = max(held)
        places = zip(decides.values(), people[-person].tolist(), strict=True)
        yield Conflict(
            parameter=parameter.name,
            first=first_rule,
            second=second_rule,
            first_term=first_term,
            second_term=second_term,
            people=len(held),
            tried=len(people),
            strength=strength,
            example={attribute.name: attribute.labels[place] for attribute, place in places},
        )


def _holding(
    rulebook: Rulebook, parameter: Parameter, decides: Mapping[str, Attribute], places: list[int]
) -> list[tuple[FiredRule, str]]:
    """Rules that fire with more than 0.5 for one person, each with a term that it concludes."""
    facts: dict[str, object] = {}
    for attribute, place in zip(decides.values(), places, strict=True):
        facts |= said(rulebook, attribute, place)
    value = rulebook.infer(facts)[parameter.name]
    shift = value.shift
    return [
        (fired, is_.term)
        for fired in (*value.fired, *(shift.fired if shift else ()))
        if fired.strength > HALF
        for is_ in fired.rule.consequents
        if is_.name == parameter.name
    ]


def _exclude(parameter: Parameter, first: str, second: str) -> bool:
    """Whether no value belongs to both terms to more than 0.5; False for terms of different scales."""
    if first == second:
        return False
    if not isinstance(parameter, NumericParameter):
        return True
    shift = parameter.shift
    for terms, domain in [
        (parameter.terms, parameter.rules),
        *([(shift.terms, shift.range)] if shift else []),
    ]:
        if first in terms and second in terms:
            return _common(terms[first], terms[second], domain) <= HALF + 1e-9
    return False


def _common(one: NumericMembership, other: NumericMembership, domain: Interval) -> float:
    """Largest degree to which one value belongs to both terms."""
    places = [*np.linspace(domain.low, domain.high, POINTS).tolist(), *one.knots, *other.knots]
    return max(min(one(place), other(place)) for place in places if place in domain)
