"""How a centre of area moves while the heights grow at which terms are cut.

Where the aggregated set is flat at a term's height it rises with it, over the width of that flat stretch;
elsewhere nothing moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from comity_fis.explanation.attribution import Attribution
from comity_fis.membership.function import NumericMembership

Lever = tuple[tuple[str, ...], float]
"""One term, or several that share a height; how far the centre moves for each unit by which that grows."""


@dataclass(frozen=True, slots=True)
class Leverage:
    """What moves the centre of one parameter's aggregated set."""

    levers: Sequence[Lever]
    attribution: Attribution
    centre: float
    area: float

    def speed(self, speeds: Mapping[str, float], terms: Mapping[str, NumericMembership]) -> float:
        """How fast the centre moves; not finite where it jumps.

        Args:
            speeds: How fast the heights of terms grow, and terms begin to rise that no rule gives yet.
            terms: All of the parameter.
        """
        speed = 0.0
        for names, by in self.levers:
            fastest = speeds.get(names[0], 0.0)
            if len(names) > 1:  # the one that gains most keeps the height
                fastest = max(speeds.get(name, 0.0) for name in names)
            speed += by * fastest
        given = self.attribution.terms
        beginning = {name: speed for name, speed in speeds.items() if name not in given}
        for left, right, rise in self._filled(beginning, terms) if beginning else ():
            speed += rise * self._by(left, right)
        return speed

    def _by(self, left: float, right: float) -> float:
        return (right - left) * ((left + right) / 2 - self.centre) / self.area

    def _filled(
        self, beginning: Mapping[str, float], terms: Mapping[str, NumericMembership]
    ) -> Iterator[tuple[float, float, float]]:
        """Where terms that begin to rise fill a gap, and how fast."""
        knots = {x for name in beginning for x in terms[name].knots}
        gaps = [(piece.left, piece.right) for piece in self.attribution.pieces if not piece.owners]
        for left, right in gaps:
            for x0, x1 in pairwise((left, *sorted(x for x in knots if left < x < right), right)):
                here = [speed for name, speed in beginning.items() if terms[name]((x0 + x1) / 2) > 0]
                if here:
                    yield x0, x1, max(here)


def leverage(attribution: Attribution) -> Leverage:
    """What moves the centre of a set that has an area."""
    area, centre = attribution.area, attribution.moment / attribution.area
    levers: list[Lever] = []
    for owners, _, _, flat in attribution.parts:
        if owners and flat:
            names = tuple([attribution.terms[term] for term, _ in owners])
            levers.append((names, (flat[1] - flat[0]) * ((flat[0] + flat[1]) / 2 - centre) / area))
    return Leverage(levers, attribution, centre, area)
