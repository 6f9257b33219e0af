"""What each rule contributes to a value: the parts add up to the value itself.

Each point under the aggregated set belongs to the rule that attains the maximum there (to several in equal
parts where they tie). A rule's share is its part of the area; its contribution is the moment of its part
over the whole area, so that the sum of all contributions is the centre of area. A set that is above 0 at
single places only is divided by their degrees, as if each place were 1 wide. Of a Sugeno system each rule has
the place and the strength that it gives: its share is its part of all strengths.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, groupby
from math import inf
from typing import NamedTuple

from comity_fis.defuzzification.curve import Point
from comity_fis.inference.value import ParameterValue
from comity_fis.membership.function import Singleton, is_straight
from comity_fis.rules.antecedent import TIE
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Rule
from comity_fis.variables.parameter import NumericParameter


class Portion(NamedTuple):
    """What one rule owns of the aggregated set."""

    share: float
    """Of the area, in [0, 1]."""
    contribution: float
    """In the parameter's unit."""


class GivenTerm(NamedTuple):
    """A rule, a term that it gives, and how strongly."""

    rule: Rule
    term: str
    strength: float


class Piece(NamedTuple):
    """A stretch of the output's range over which the same rules attain the maximum."""

    outline: tuple[Point, ...]
    """Places from its left end to its right end with their degrees, which straight lines join, nearly."""
    area: float
    moment: float
    """About 0: the integral of `x mu(x)`."""
    owners: tuple[Rule, ...]
    """None where the aggregated set is 0."""
    terms: tuple[str, ...]
    """That the owners give."""
    flat: bool
    """Whether the owners' strength is the height here, and not the slope of their term."""
    spike: bool = False
    """Whether it is a single place of a set without area."""

    @property
    def left(self) -> float:
        """Where it starts."""
        return self.outline[0][0]

    @property
    def right(self) -> float:
        """Where it ends."""
        return self.outline[-1][0]

    @property
    def width(self) -> float:
        """That of a spike is 1."""
        return 1.0 if self.spike else self.right - self.left


@dataclass(frozen=True, slots=True)
class Attribution:
    """The aggregated set of one numeric parameter, divided among the rules that fired."""

    given: tuple[GivenTerm, ...]
    """What was divided."""
    pieces: tuple[Piece, ...]
    """The outline from left to right."""
    area: float
    """Of the whole set."""
    moment: float
    """Of the whole set about 0."""

    @property
    def centre(self) -> float:
        """Of the area."""
        return self.moment / self.area

    def portions(self) -> dict[int, Portion]:
        """Each rule's portion, by its number."""
        areas = {one.rule.number: 0.0 for one in self.given}
        moments = dict(areas)
        for piece in self.pieces:
            for rule in piece.owners:
                areas[rule.number] += piece.area / len(piece.owners)
                moments[rule.number] += piece.moment / len(piece.owners)
        return {number: Portion(areas[number] / self.area, moments[number] / self.area) for number in areas}


Layer = tuple[str, float]
"""A term and a strength with which rules give it."""

_Panel = tuple[tuple[tuple[Layer, ...], bool], tuple[Point, ...], float, float]
"""Whose it is and whether it is flat; its outline, area and moment."""

NOTHING = Attribution((), (), 0.0, 0.0)
"""Where no rule decided."""


def attribute(value: ParameterValue, parameter: NumericParameter) -> Attribution:
    """Divide what the rules gave; nothing is divided where no rule decided the value."""
    if not value.decided_by_rules:
        return NOTHING
    given = (
        GivenTerm(rule, is_.term, strength)
        for rule, strength in value.fired
        for is_ in rule.consequents
        if is_.name == parameter.name and is_.term in parameter.terms
    )
    return divided(given, parameter)


def divided(
    given: Iterable[GivenTerm], parameter: NumericParameter, methods: Methods = MAMDANI
) -> Attribution:
    """Divide what rules gave, strongest first."""
    if methods.aggregation == "sum":
        return _averaged(tuple(given), parameter)
    levelled = tuple(_levelled(given))
    by_layer: dict[Layer, list[Rule]] = {}
    for rule, term, strength in levelled:
        by_layer.setdefault((term, strength), []).append(rule)
    pieces = tuple(_pieces(by_layer, parameter))
    if levelled and not any(piece.area for piece in pieces):
        pieces = tuple(_spikes(by_layer, parameter))
    area, moment = sum(piece.area for piece in pieces), sum(piece.moment for piece in pieces)
    return Attribution(levelled, pieces, area, moment)


def _averaged(given: tuple[GivenTerm, ...], parameter: NumericParameter) -> Attribution:
    """Constants with the strengths of their rules, one upon the other where they stand at the same place."""
    heights: dict[float, float] = {}
    pieces = []
    for rule, term, strength in given:
        shape = parameter.conclusions[term]
        assert isinstance(shape, Singleton)
        x, base = shape.place, heights.get(shape.place, 0.0)
        heights[x] = base + strength
        pieces.append(
            Piece(
                outline=((x, base), (x, base + strength), (x, 0.0)),
                area=strength,
                moment=strength * x,
                owners=(rule,),
                terms=(term,),
                flat=True,
                spike=True,
            )
        )
    pieces.sort(key=lambda piece: piece.outline[:2])
    return Attribution(given, tuple(pieces), sum(p.area for p in pieces), sum(p.moment for p in pieces))


def _levelled(given: Iterable[GivenTerm]) -> Iterator[GivenTerm]:
    """With strengths that differ by rounding made equal: such rules tie."""
    level = inf
    for one in given:
        if level - one.strength > TIE:
            level = one.strength
        yield one._replace(strength=level)


def _pieces(by_layer: Mapping[Layer, Sequence[Rule]], parameter: NumericParameter) -> Iterator[Piece]:
    """Neighbouring panels that the same rules own, as one."""
    for (owners, flat), panels in groupby(_panels(by_layer, parameter), key=lambda panel: panel[0]):
        outlines, areas, moments = zip(*(panel[1:] for panel in panels), strict=True)
        rules = {rule.number: rule for layer in owners for rule in by_layer[layer]}
        yield Piece(
            outline=tuple(chain.from_iterable(outlines)),
            area=sum(areas),
            moment=sum(moments),
            owners=tuple(rules.values()),
            terms=tuple(dict.fromkeys(term for term, _ in owners)),
            flat=flat,
        )


def _spikes(by_layer: Mapping[Layer, Sequence[Rule]], parameter: NumericParameter) -> Iterator[Piece]:
    """The places at which a set without area is above 0, from left to right."""
    low, high = parameter.rules.ends
    terms = {term: parameter.terms[term] for term, _ in by_layer}
    places = sorted({x for term in terms.values() for x in (*term.turns, low, high) if low <= x <= high})
    for x in places:
        degrees = {layer: min(terms[layer[0]](x), layer[1]) for layer in by_layer}
        top = max(degrees.values())
        if top > 0:
            owners = [layer for layer, degree in degrees.items() if degree == top]
            rules = {rule.number: rule for layer in owners for rule in by_layer[layer]}
            yield Piece(
                outline=((x, 0.0), (x, top), (x, 0.0)),
                area=top,
                moment=top * x,
                owners=tuple(rules.values()),
                terms=tuple(dict.fromkeys(term for term, _ in owners)),
                flat=True,
                spike=True,
            )


def _panels(by_layer: Mapping[Layer, Sequence[Rule]], parameter: NumericParameter) -> Iterator[_Panel]:
    """From left to right."""
    import numpy as np

    from comity_fis.defuzzification.gauss_kronrod import places_in
    from comity_fis.defuzzification.ground import INSIDE, ground_of
    from comity_fis.defuzzification.panels import panels_of
    from comity_fis.defuzzification.sets import Sets

    layers, names = list(by_layer), list(parameter.terms)
    if not layers:
        return
    ground = ground_of(tuple(parameter.terms.values()), *parameter.rules.ends, MAMDANI)
    strengths = np.array([[strength] for _, strength in layers])
    sets = Sets(ground, MAMDANI, [names.index(term) for term, _ in layers], strengths)
    panels = panels_of(sets)
    shaped = np.stack(list(sets.shaped(panels.person, (panels.left + panels.right) / 2)))
    owned = (shaped == shaped.max(axis=0)) & (shaped > 0)
    flat = ~owned.any(axis=0) | np.any(owned & (shaped == strengths), axis=0)
    inside = INSIDE * (panels.right - panels.left)
    xs = np.column_stack([panels.left + inside, panels.right - inside])
    if not all(is_straight(parameter.terms[term]) for term, _ in layers):
        xs = np.insert(xs, 1, places_in(panels.left, panels.right).T, axis=1)
    degrees = sets.at(panels.person, xs)
    xs[:, 0], xs[:, -1] = panels.left, panels.right
    moments = panels.moment + ground.low * panels.area
    for i in range(panels.person.size):
        owners = tuple([layer for layer, owns in zip(layers, owned[:, i].tolist(), strict=True) if owns])
        outline = tuple(zip(xs[i].tolist(), degrees[i].tolist(), strict=True))
        yield (owners, bool(flat[i])), outline, float(panels.area[i]), float(moments[i])
