"""Where things are on the picture of an episode: the map, and its panel beside or below it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures import panel
from comity_sim2d.pictures.legend import Legend
from comity_sim2d.pictures.panel import Card, CardColumn
from comity_sim2d.scene.scene import Scene

WIDEST_IN, NARROWEST_IN, EDGE_IN = 12.0, 8.0, 0.25
HEADER_IN, SCALE_IN = 0.95, 0.3
TALLEST_MAP_IN = 8.5
LEAST_FILLED = 0.6
"""A page with the panel beside the map is filled to this share; else the panel is below (our choice)."""
FLAT = 0.22
"""A map over its panel is at least so many times as high as wide: words go above and below a corridor."""

Place = tuple[float, float, float, float]
"""Left, bottom, width and height [in]."""


@dataclass(frozen=True, slots=True)
class Layout:
    """The places of a page, in inches."""

    width: float
    height: float
    map: Place
    in_per_m: float
    """Scale of the map."""
    beside_m: float
    """What the map leaves free on either side of the floor."""
    above_m: float
    """What it leaves free above and below the floor."""
    columns: tuple[tuple[Place, CardColumn], ...]
    """What the panel consists of."""

    @property
    def filled(self) -> float:
        """The share of the page, its header aside, that something is on."""
        used = self.map[2] * self.map[3] + sum(place[2] * column.height_in for place, column in self.columns)
        return used / (self.width * (self.height - HEADER_IN))


def layout(scene: Scene, cards: Sequence[Card], legend: Legend) -> Layout:
    """The page for a scene: with its panel beside the map, unless that leaves much of it empty.

    Below a map that is lower than its panel there is place for the legend.
    """
    whole = _panel_beside(scene, CardColumn(tuple(cards), legend))
    parted = _panel_beside(scene, CardColumn(tuple(cards)), legend)
    beside = min(whole, parted, key=lambda page: page.height)
    return beside if beside.filled >= LEAST_FILLED else _panel_below(scene, cards, legend)


def _panel_beside(scene: Scene, column: CardColumn, below: Legend | None = None) -> Layout:
    """With a column beside the map, and with a legend below the map where one is given."""
    wide, high = d.extent_m(scene)
    free_m = d.beside_m(scene)
    wide += 2 * free_m
    most = WIDEST_IN - panel.WIDTH_IN - 2 * EDGE_IN
    scale = min(most / wide, TALLEST_MAP_IN / high)
    map_in, tall = wide * scale, high * scale
    width = max(NARROWEST_IN, map_in + panel.WIDTH_IN + 2 * EDGE_IN)
    legend = None if below is None else replace(below, columns=max(int(map_in // panel.WIDTH_IN), 1))
    under_in = 0.0 if legend is None else SCALE_IN + legend.height_in
    height = HEADER_IN + max(tall + SCALE_IN + under_in, column.height_in) + EDGE_IN
    left = EDGE_IN + (width - panel.WIDTH_IN - 2 * EDGE_IN - map_in) / 2
    return Layout(
        width=width,
        height=height,
        map=(left, height - HEADER_IN - tall, map_in, tall),
        in_per_m=scale,
        beside_m=free_m,
        above_m=0.0,
        columns=(
            ((width - panel.WIDTH_IN, 0.0, panel.WIDTH_IN, height - HEADER_IN), column),
            *_below_map(legend, (left, height - HEADER_IN - tall - SCALE_IN, map_in)),
        ),
    )


def _below_map(legend: Legend | None, top_left: tuple[float, float, float]) -> list[tuple[Place, CardColumn]]:
    """The place of a legend by its left edge, its top and the width of the map [in]."""
    if legend is None:
        return []
    left, top, width = top_left
    wide = max(width, panel.WIDTH_IN)
    return [((left, top - legend.height_in, wide, legend.height_in), CardColumn((), legend))]


def _panel_below(scene: Scene, cards: Sequence[Card], legend: Legend) -> Layout:
    wide, high = d.extent_m(scene)
    above_m = max(0.0, (FLAT * wide - high) / 2)
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
