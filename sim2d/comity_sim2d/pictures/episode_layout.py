"""Layout of the picture of an episode: the map, and its panel next to or below it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures import panel
from comity_sim2d.pictures.legend import Legend
from comity_sim2d.pictures.panel import Card, CardColumn
from comity_sim2d.scene.scene import Scene

WIDEST_IN, NARROWEST_IN, EDGE_IN = 12.0, 7.0, 0.25
HEADER_IN, SCALE_IN = 0.95, 0.3
TALLEST_MAP_IN, SLENDER_MAP_IN = 8.5, 6.0
"""Maximum height of a map, and of one of a very narrow place next to a short panel [in]: a higher one would
leave the page below the panel empty (our choice)."""
NARROWEST_MAP_IN = 3.5
"""Minimum width of a map next to its panel [in], so that labels fit beside a narrow room (our choice)."""
LEAST_FILLED = 0.6
"""Minimum filled share of a page with the panel next to the map; otherwise the panel is below (our
choice)."""
VISIT_IN2 = 4.0
"""Area of the map per visit for its labels [in^2]; if there is less, the panel goes below and the map is
larger (our choice)."""
FLAT = 0.22
"""Minimum ratio of height to width of a map above its panel, so that labels fit above and below a
corridor."""
PERSON_IN2, BUBBLE_IN2 = 2.0, 4.0
"""Area above and below a flat map for a person's name, and for the bubble and the numbers of a visit [in^2]:
about half of it is taken (our choice)."""

Place = tuple[float, float, float, float]
"""Left, bottom, width and height [in]."""


@dataclass(frozen=True, slots=True)
class Layout:
    """The layout of a page, in inches."""

    width: float
    height: float
    map: Place
    in_per_m: float
    """Scale of the map."""
    beside_m: float
    """Free space on either side of the floor [m]."""
    above_m: float
    """Free space above and below the floor [m]."""
    columns: tuple[tuple[Place, CardColumn], ...]
    """The columns of the panel."""

    @property
    def filled(self) -> float:
        """Filled share of the page, without its header."""
        used = self.map[2] * self.map[3] + sum(place[2] * column.height_in for place, column in self.columns)
        return used / (self.width * (self.height - HEADER_IN))

    def has_room_for(self, visits: int) -> bool:
        """Whether labels of this many visits fit on the map."""
        return self.map[2] * self.map[3] >= VISIT_IN2 * visits


def layout(scene: Scene, cards: Sequence[Card], legend: Legend) -> Layout:
    """The layout for a scene: the panel is next to the map, unless much stays empty or labels do not fit.

    A flat map, as of a corridor, is above its panel, with space for labels above and below the floor.
    Cards that would reach far below the map go under it, next to the legend, if that makes the page lower.
    """
    below = _panel_below(scene, cards, legend)
    if below.above_m:
        return below
    whole = _panel_beside(scene, CardColumn(tuple(cards), legend))
    counts = range(len(cards), -1, -1)
    parted = [_panel_beside(scene, CardColumn(tuple(cards[:n])), cards[n:], legend) for n in counts]
    pages = (min([whole, *parted], key=lambda page: page.height), below)
    filled = [page for page in pages if page.filled >= LEAST_FILLED] or [max(pages, key=lambda p: p.filled)]
    roomy = (page for page in filled if page.has_room_for(len(cards)))
    return next(roomy, max(filled, key=lambda page: page.in_per_m))


def _panel_beside(
    scene: Scene, column: CardColumn, further: Sequence[Card] = (), legend: Legend | None = None
) -> Layout:
    """A layout with a column next to the map and, if given, further cards and a legend below it."""
    wide, high = d.extent_m(scene)
    most = WIDEST_IN - panel.WIDTH_IN - 2 * EDGE_IN
    # Continuous at the ratio below which a place is slender.
    slender_in = max(SLENDER_MAP_IN, column.height_in, TALLEST_MAP_IN * wide / (d.SLENDER * high))
    scale = min(most / wide, min(slender_in, TALLEST_MAP_IN) / high)
    map_in, tall = max(wide * scale, NARROWEST_MAP_IN), high * scale
    free_m = (map_in / scale - wide) / 2
    width = max(NARROWEST_IN, map_in + panel.WIDTH_IN + 2 * EDGE_IN)
    under = [] if legend is None else _under(further, legend, max(int(map_in // panel.WIDTH_IN), 1))
    under_in = max((SCALE_IN + each.height_in for each in under), default=0.0)
    height = HEADER_IN + max(tall + SCALE_IN + under_in, column.height_in) + EDGE_IN
    left = EDGE_IN + (width - panel.WIDTH_IN - 2 * EDGE_IN - map_in) / 2
    floor = height - HEADER_IN - tall
    top, step = floor - SCALE_IN, max(map_in, panel.WIDTH_IN) / max(len(under), 1)
    return Layout(
        width=width,
        height=height,
        map=(left, floor, map_in, tall),
        in_per_m=scale,
        beside_m=free_m,
        above_m=0.0,
        columns=(
            ((width - panel.WIDTH_IN, 0.0, panel.WIDTH_IN, height - HEADER_IN), column),
            *(
                ((left + i * step, top - each.height_in, step, each.height_in), each)
                for i, each in enumerate(under)
            ),
        ),
    )


def _under(cards: Sequence[Card], legend: Legend, most: int) -> list[CardColumn]:
    """The columns under a map, at most `most`; a legend alone there fills them all."""
    return panel.in_columns(cards, legend if cards else replace(legend, columns=most), most)


def _panel_below(scene: Scene, cards: Sequence[Card], legend: Legend) -> Layout:
    wide, high = d.extent_m(scene)
    above_m = max(0.0, (FLAT * wide - high) / 2)
    if above_m:
        labels_in2 = PERSON_IN2 * len(scene.people) + BUBBLE_IN2 * len(cards)
        in_per_m = (WIDEST_IN - 2 * EDGE_IN) / wide
        above_m = max(above_m, labels_in2 / in_per_m**2 / wide / 2)
    high += 2 * above_m
    width = WIDEST_IN
    scale = min((width - 2 * EDGE_IN) / wide, TALLEST_MAP_IN / high)
    map_in, tall = wide * scale, high * scale
    columns = panel.in_columns(cards, legend, int((width - EDGE_IN) // panel.WIDTH_IN))
    panel_in = max(column.height_in for column in columns)
    height = HEADER_IN + tall + 2 * SCALE_IN + panel_in + EDGE_IN
    step = (width - EDGE_IN) / len(columns)
    return Layout(
        width=width,
        height=height,
        map=(EDGE_IN + (width - 2 * EDGE_IN - map_in) / 2, height - HEADER_IN - tall, map_in, tall),
        in_per_m=scale,
        beside_m=0.0,
        above_m=above_m,
        columns=tuple(
            ((EDGE_IN + i * step, 0.0, panel.WIDTH_IN, panel_in + EDGE_IN), column)
            for i, column in enumerate(columns)
        ),
    )
