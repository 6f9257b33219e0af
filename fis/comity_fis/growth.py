"""How fast a centre of area moves while the heights grow at which terms are cut.

Where the aggregated set is flat at a term's height it rises with it, over the width of that flat stretch;
elsewhere nothing moves. Where the centre has a closed form, that says the same by its derivatives.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

from comity_fis.attribution import Attribution
from comity_fis.closed_form import ClosedForm
from comity_fis.membership import NumericMembership
from comity_fis.ownership import Piece

Speeds = Mapping[str, float]
"""How fast the heights of terms grow; of terms that no rule gives yet, how fast they begin to."""


def speed_by_form(form: ClosedForm, heights: Mapping[str, float], speeds: Speeds) -> float:
    """In the parameter's unit per unit of time; not finite where the centre jumps."""
    area, moment = form.area_and_moment(heights, min)
    area_speed, moment_speed = form.growth(heights, speeds)
    return (moment_speed - moment / area * area_speed) / area


def speed_by_pieces(
    attribution: Attribution, terms: Mapping[str, NumericMembership], speeds: Speeds
) -> float:
    """The same from the pieces of the set."""
    area_speed = moment_speed = 0.0
    for left, right, speed in _rising(attribution, terms, speeds):
        area_speed += speed * (right - left)
        moment_speed += speed * (right - left) * (left + right) / 2
    return (moment_speed - attribution.moment / attribution.area * area_speed) / attribution.area


def _rising(
    attribution: Attribution, terms: Mapping[str, NumericMembership], speeds: Speeds
) -> Iterator[tuple[float, float, float]]:
    """Stretches with the speed at which the set rises there: of those that share a height, the fastest's."""
    beginning = {term: terms[term] for term in speeds if term not in attribution.terms}
    for piece in attribution.pieces:
        if piece.flat and piece.owners:
            speed = max(speeds.get(attribution.terms[term], 0.0) for term, _ in piece.owners)
            yield piece.left, piece.right, speed
        elif piece.flat:
            yield from _begun(piece, beginning, speeds)


def _begun(
    empty: Piece, beginning: Mapping[str, NumericMembership], speeds: Speeds
) -> Iterator[tuple[float, float, float]]:
    """Where terms that begin to rise fill an empty stretch."""
    knots = {x for term in beginning.values() for x in term.knots if empty.left < x < empty.right}
    for left, right in pairwise((empty.left, *sorted(knots), empty.right)):
        middle = (left + right) / 2
        here = [speeds[name] for name, term in beginning.items() if term(middle) > 0]
        if here:
            yield left, right, max(here)
