"""Contribution of each rule to a value; the contributions add up to the value.

Each point under the aggregated set belongs to the rule that attains the maximum there (in equal parts to
rules that tie). A rule's share is its part of the area; its contribution is the moment of its part divided by
the whole area, so that the contributions add up to the centroid. A set that is above 0 only at single points
is divided by their degrees, as if each point had width 1. If degrees are summed, as in a Sugeno system, rules
are stacked and each owns its own strength.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, groupby
from math import inf
from typing import NamedTuple

from comity_fis.defuzzification.curve import Point
from comity_fis.inference.value import FiredRule
from comity_fis.membership.function import is_straight
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Rule
from comity_fis.variables.parameter import NumericParameter

TIE = 1e-12
"""Strengths that differ by less are equal: the rules tie."""


class Portion(NamedTuple):
    """The part of the aggregated set that one rule owns."""

    share: float
    """Share of the area, in [0, 1]."""
    contribution: float
    """Contribution in the parameter's unit."""


class Piece(NamedTuple):
    """An interval of the output's range in which the same rules attain the maximum."""

    outline: tuple[Point, ...]
    """Points from the left to the right end with their degrees, joined approximately by straight lines."""
    area: float
    moment: float
    """Moment about 0: the integral of `x mu(x)`."""
    owners: tuple[Rule, ...]
    """The rules that own the piece; empty where the aggregated set is 0."""
    spike: bool = False
    """Whether it is a single point of a set without area, which counts as if it had width 1."""

    @property
    def left(self) -> float:
        """Left end."""
        return self.outline[0][0]

    @property
    def right(self) -> float:
        """Right end."""
        return self.outline[-1][0]


@dataclass(frozen=True, slots=True)
class Attribution:
    """The aggregated set of a numeric parameter, divided among the rules that fired."""

    pieces: tuple[Piece, ...]
    """The pieces from left to right."""

    def portions(self) -> dict[int, Portion]:
        """The portion of each rule that owns any, by rule number."""
        area = sum(piece.area for piece in self.pieces)
        owned: dict[int, Portion] = {}
        for piece in self.pieces:
            for rule in piece.owners:
                share, contribution = owned.get(rule.number, (0.0, 0.0))
                parts = area * len(piece.owners)
                owned[rule.number] = Portion(share + piece.area / parts, contribution + piece.moment / parts)
        return owned


Layer = tuple[str, float]
"""A term and the strength that rules give it."""

NOTHING = Attribution(())
"""No rule decided."""


def attribute(
    fired: Iterable[FiredRule], parameter: NumericParameter, methods: Methods = MAMDANI
) -> Attribution:
    """Divide a parameter's aggregated set among the rules that fired, strongest first.

    Args:
        fired: The rules, strongest first.
        parameter: The concluded parameter.
        methods: Mamdani's, or those of a Sugeno system.
    """
    layers: dict[Layer, list[Rule]] = {}
    level = inf
    for rule, strength in fired:
        if level - strength > TIE:
            level = strength
        for is_ in rule.consequents:
            if is_.name == parameter.name and is_.term in parameter.terms:
                layers.setdefault((is_.term, level), []).append(rule)
    pieces = tuple(_pieces(layers, parameter)) if methods.aggregation == "max" and layers else ()
    if not any(piece.area for piece in pieces):
        pieces = tuple(_spikes(layers, parameter, methods))
    return Attribution(pieces)


def _spikes(
    layers: Mapping[Layer, Sequence[Rule]], parameter: NumericParameter, methods: Methods
) -> Iterator[Piece]:
    """The points at which a set without area is above 0, from left to right."""
    low, high = parameter.rules.ends
    terms = {term: parameter.terms[term] for term, _ in layers}
    for x in sorted({x for term in terms.values() for x in (*term.turns, low, high) if low <= x <= high}):
        degrees = {layer: min(terms[layer[0]](x), layer[1]) for layer in layers}
        top = max(degrees.values())
        if top <= 0:
            continue
        if methods.aggregation == "max":
            owners = [rule for layer in layers if degrees[layer] == top for rule in layers[layer]]
            yield _spike(x, 0.0, top, owners)
            continue
        base = 0.0
        for layer, rules in layers.items():
            for rule in rules if degrees[layer] > 0 else ():
                yield _spike(x, base, degrees[layer], [rule])
                base += degrees[layer]


def _spike(x: float, base: float, height: float, owners: Iterable[Rule]) -> Piece:
    outline = ((x, base), (x, base + height), (x, 0.0))
    return Piece(outline, height, height * x, _each_once(owners), spike=True)


def _each_once(rules: Iterable[Rule]) -> tuple[Rule, ...]:
    return tuple({rule.number: rule for rule in rules}.values())


def _pieces(layers: Mapping[Layer, Sequence[Rule]], parameter: NumericParameter) -> Iterator[Piece]:
    """Merge neighbouring panels that the same rules own."""
    panels = _panels(list(layers), parameter)
    for owners, together in groupby(panels, key=lambda panel: panel[0]):
        outlines, areas, moments = zip(*(panel[1:] for panel in together), strict=True)
        rules = _each_once(rule for layer in owners for rule in layers[layer])
        yield Piece(tuple(chain.from_iterable(outlines)), sum(areas), sum(moments), rules)


def _panels(
    layers: Sequence[Layer], parameter: NumericParameter
) -> Iterator[tuple[tuple[Layer, ...], tuple[Point, ...], float, float]]:
    """Panels from left to right: the highest layers there, the outline, area and moment."""
    import numpy as np

    from comity_fis.defuzzification.gauss_kronrod import places_in
    from comity_fis.defuzzification.ground import INSIDE, ground_of
    from comity_fis.defuzzification.panels import panels_of
    from comity_fis.defuzzification.sets import Sets

    # The aggregated set is a maximum, so rules do not add up and a share cannot be read off their strengths:
    # a strong rule below a stronger one changes nothing. Splitting the range wherever another layer becomes
    # the highest yields panels that belong to one layer each (or, in equal parts, to several that tie). The
    # centroid is linear in the moments of the panels, so their sum is the value itself, up to rounding: an
    # exact decomposition, where Shapley values (Shapley 1953) would need an inference for each set of rules.
    names = list(parameter.terms)
    ground = ground_of(tuple(parameter.terms.values()), *parameter.rules.ends, MAMDANI)
    strengths = np.array([[strength] for _, strength in layers])
    sets = Sets(ground, MAMDANI, [names.index(term) for term, _ in layers], strengths)
    panels = panels_of(sets)
    shaped = np.stack(list(sets.shaped(panels.person, (panels.left + panels.right) / 2)))
    owned = (shaped == shaped.max(axis=0)) & (shaped > 0)
    inside = INSIDE * (panels.right - panels.left)
    xs = np.column_stack([panels.left + inside, panels.right - inside])
    if not all(is_straight(parameter.terms[term]) for term, _ in layers):
        xs = np.insert(xs, 1, places_in(panels.left, panels.right).T, axis=1)
    degrees = sets.at(panels.person, xs)
    xs[:, 0], xs[:, -1] = panels.left, panels.right
    moments = panels.moment + ground.low * panels.area
    for i in range(panels.person.size):
        owners = tuple(layer for layer, owns in zip(layers, owned[:, i].tolist(), strict=True) if owns)
        outline = tuple(zip(xs[i].tolist(), degrees[i].tolist(), strict=True))
        yield owners, outline, float(panels.area[i]), float(moments[i])
