"""What each rule contributes to a value: the parts add up to the value itself.

Each point under the aggregated set belongs to the rule that attains the maximum there (to several in equal
parts where they tie). A rule's share is its part of the area; its contribution is the moment of its part
over the whole area, so that the sum of all contributions is the centre of area. A set that is above 0 at
single places only is divided by their degrees, as if each place were 1 wide; where degrees are summed up, as
in a Sugeno system, rules stand one upon the other, and each owns the strength that it gives.
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
    """What one rule owns of the aggregated set."""

    share: float
    """Of the area, in [0, 1]."""
    contribution: float
    """In the parameter's unit."""


class Piece(NamedTuple):
    """A stretch of the output's range over which the same rules attain the maximum."""

    outline: tuple[Point, ...]
    """Places from its left end to its right end with their degrees, which straight lines join, nearly."""
    area: float
    moment: float
    """About 0: the integral of `x mu(x)`."""
    owners: tuple[Rule, ...]
    """None where the aggregated set is 0."""
    spike: bool = False
    """Whether it is a single place of a set without area, which counts as if it were 1 wide."""

    @property
    def left(self) -> float:
        """Where it starts."""
        return self.outline[0][0]

    @property
    def right(self) -> float:
        """Where it ends."""
        return self.outline[-1][0]


@dataclass(frozen=True, slots=True)
class Attribution:
    """The aggregated set of one numeric parameter, divided among the rules that fired."""

    pieces: tuple[Piece, ...]
    """The outline from left to right."""

    def portions(self) -> dict[int, Portion]:
        """The portion of each rule that owns any, by its number."""
        area = sum(piece.area for piece in self.pieces)
        owned: dict[int, Portion] = {}
        for piece in self.pieces:
            for rule in piece.owners:
                share, contribution = owned.get(rule.number, (0.0, 0.0))
                parts = area * len(piece.owners)
                owned[rule.number] = Portion(share + piece.area / parts, contribution + piece.moment / parts)
        return owned


Layer = tuple[str, float]
"""A term and a strength with which rules give it."""

NOTHING = Attribution(())
"""Where no rule decided."""


def attribute(
    fired: Iterable[FiredRule], parameter: NumericParameter, methods: Methods = MAMDANI
) -> Attribution:
    """Divide what rules gave a parameter among them, strongest first.

    Args:
        fired: The rules, strongest first.
        parameter: What they gave a value.
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
    """The places at which a set without area is above 0, from left to right."""
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
    """Neighbouring panels that the same rules own, as one."""
    panels = _panels(list(layers), parameter)
    for owners, together in groupby(panels, key=lambda panel: panel[0]):
        outlines, areas, moments = zip(*(panel[1:] for panel in together), strict=True)
        rules = _each_once(rule for layer in owners for rule in layers[layer])
        yield Piece(tuple(chain.from_iterable(outlines)), sum(areas), sum(moments), rules)


def _panels(
    layers: Sequence[Layer], parameter: NumericParameter
) -> Iterator[tuple[tuple[Layer, ...], tuple[Point, ...], float, float]]:
    """Panels from left to right: the layers that are highest there, the outline, area and moment."""
    import numpy as np

    from comity_fis.defuzzification.gauss_kronrod import places_in
    from comity_fis.defuzzification.ground import INSIDE, ground_of
    from comity_fis.defuzzification.panels import panels_of
    from comity_fis.defuzzification.sets import Sets

    # The aggregated set is a maximum, so the rules do not add up and a share cannot be read off their
    # strengths: a strong rule below a stronger one changes nothing. Cutting the range wherever another
    # layer becomes the highest leaves panels that belong to one layer each (or to several that tie, in
    # equal parts). The centre of area is linear in the moments of the panels, so that their sum is the
    # value itself, to rounding: an exact decomposition, where Shapley values (Shapley 1953) would need an
    # inference for each set of rules.
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
