"""Whose the aggregated output set is where only neighbouring terms overlap: in closed form, without a search.

A term owns its own cut shape down to where its neighbour's edge crosses it: of two neighbours of different
height the lower one loses its edge, and the higher one begins where its edge rises out of the lower one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from comity_fis.defuzzification.closed_form import ClosedForm, Edges
from comity_fis.explanation.owned import Group, Part


def parts_of(form: ClosedForm, names: Sequence[str], groups: Sequence[Group]) -> list[Part]:
    """What the groups own, each of one term of the closed form."""
    spans = {
        name: _Span(number, group, form.edges[name])
        for number, (name, group) in enumerate(zip(names, groups, strict=True))
    }
    parts: list[Part] = []
    for left, right, peak, _ in form.overlaps:
        if left in spans and right in spans:
            parts += _divide(spans[left], spans[right], peak)
    for span in spans.values():
        span.own(parts)
    return parts


@dataclass(slots=True)
class _Span:
    """What one term owns, narrowed down neighbour by neighbour."""

    number: int
    group: Group
    edges: Edges
    height: float = field(init=False)
    start: float = field(init=False)
    """Of what is flat."""
    end: float = field(init=False)
    lost_left: float = 0.0
    """The height up to which the rising edge is below the left neighbour."""
    lost_right: float = 0.0

    def __post_init__(self) -> None:
        left, rise, right, fall = self.edges
        self.height = self.group.height
        self.start, self.end = left + rise * self.height, right - fall * self.height

    def own(self, parts: list[Part]) -> None:
        """Add its flat part, and its edges between the strengths of one rule and the next."""
        number, group, height = self.number, self.group, self.height
        parts.append(_flat_part(((number, group.reaching(height)),), self.start, self.end, height))
        (left, rise, right, fall), below = self.edges, 0.0
        for level in group.levels:
            rising, falling = max(below, self.lost_left), max(below, self.lost_right)
            area = moment = 0.0
            if rising < level:
                area = rise * (level**2 - rising**2) / 2
                moment = left * area + rise**2 * (level**3 - rising**3) / 3
            if falling < level:
                area_right = fall * (level**2 - falling**2) / 2
                area += area_right
                moment += right * area_right - fall**2 * (level**3 - falling**3) / 3
            if area:
                parts.append((((number, group.reaching(level)),), area, moment, None))
            below = level


def _divide(left: _Span, right: _Span, peak: float) -> Iterator[Part]:
    """Take from both what the other one owns; what is common is a part by itself."""
    lower = min(left.height, right.height)
    left.lost_right = right.lost_left = min(lower, peak)
    if lower >= peak:
        return
    rises_out = right.edges[0] + right.edges[1] * lower
    sinks_in = left.edges[2] - left.edges[3] * lower
    if left.height == lower:
        left.end = rises_out
    if right.height == lower:
        right.start = sinks_in
    if left.height == right.height:
        owners = tuple((span.number, span.group.reaching(lower)) for span in (left, right))
        yield _flat_part(owners, rises_out, sinks_in, lower)


def _flat_part(owners: tuple[tuple[int, int], ...], start: float, end: float, height: float) -> Part:
    area = height * (end - start)
    return owners, area, area * (start + end) / 2, (start, end)
