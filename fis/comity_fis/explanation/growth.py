"""How a centre of area moves while the heights grow at which terms are cut.

Where the aggregated set is flat at a term's height it rises with it, over the width of that flat stretch;
elsewhere nothing moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import inf

from comity_fis.explanation.attribution import Attribution
from comity_fis.membership.function import NumericMembership, Singleton


def speed_of_centre(
    attribution: Attribution, speeds: Mapping[str, float], terms: Mapping[str, NumericMembership]
) -> float:
    """How fast the centre of a set moves that has an area; not finite where it jumps.

    Args:
        attribution: The set.
        speeds: How fast the heights of terms grow, and terms begin to rise that no rule gives yet.
        terms: All of the parameter.
    """
    speed = 0.0
    for piece in attribution.pieces:
        if piece.owners and piece.flat:
            # Of several terms that share a height, the one that gains most keeps it.
            rise = max(speeds.get(term, 0.0) for term in piece.terms)
            speed += rise * _gain(attribution, (piece.left + piece.right) / 2, piece.width)
    given = {one.term for one in attribution.given}
    beginning = {name: speed for name, speed in speeds.items() if name not in given}
    if any(piece.spike for piece in attribution.pieces):
        return speed + sum(
            _speed_of_spike(attribution, terms[name], rise) for name, rise in beginning.items()
        )
    for left, right, rise in _filled(attribution, beginning, terms) if beginning else ():
        speed += rise * _gain(attribution, (left + right) / 2, right - left)
    return speed


def _gain(attribution: Attribution, middle: float, width: float) -> float:
    """How far the centre moves for each unit by which the set rises over a width around a place."""
    return width * (middle - attribution.centre) / attribution.area


def _speed_of_spike(attribution: Attribution, term: NumericMembership, rise: float) -> float:
    """What a term that begins to rise does to a set without area: one with an area takes it over at once."""
    return rise * _gain(attribution, term.place, 1.0) if isinstance(term, Singleton) else inf


def _filled(
    attribution: Attribution, beginning: Mapping[str, float], terms: Mapping[str, NumericMembership]
) -> Iterator[tuple[float, float, float]]:
    """Where terms that begin to rise fill a gap, and how fast."""
    knots = {x for name in beginning for x in terms[name].knots}
    gaps = [(piece.left, piece.right) for piece in attribution.pieces if not piece.owners]
    for left, right in gaps:
        for x0, x1 in pairwise((left, *sorted(x for x in knots if left < x < right), right)):
            here = [speed for name, speed in beginning.items() if terms[name]((x0 + x1) / 2) > 0]
            if here:
                yield x0, x1, max(here)
