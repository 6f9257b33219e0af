"""A picture of a place as a graph: rooms and named places, with the doors between them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity_sim2d.maps.topology import topology
from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.map_labels import MapLabels
from comity_sim2d.pictures.page import DPI, as_bytes, in_per_m, own_page
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.axes import Axes

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.scene import Scene

EDGE_IN, HEADER_IN = 0.7, 0.5
"""Margin, which has space for names at the border, and height of the headline [in]."""
LEAST_IN, MOST_IN = 7.0, 16.0
IN_PER_M = 0.6
ROOM, LIGHT, SHUT = "#0B6E6E", "#8FA3A3", "#B3261E"
MARK_PT = {"room": 15.0, "place": 7.0, "door": 6.5}
"""Diameter of each kind of mark [pt]."""
WORDS_PT = {"room": 10.0, "door": 8.0, "place": 8.0}
"""Font size of their names [pt], in the order of placement."""
PREFER_RAD = {"room": -math.pi / 2, "door": 0.0, "place": math.pi / 2}
"""Preferred direction of a name [rad]: below a room, to the right of a door, above a place."""


def draw_topology(place: PlaceMap | Scene, *, title: str, form: str = "png") -> bytes:
    """Draw rooms at their positions and doors as lines with their names; a shut door is a dashed red line.

    Args:
        place: A map, or a scene with rooms.
        title: The headline.
        form: `png`, `svg` or `pdf`.

    Raises:
        ValueError: If the place has no rooms.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    graph = topology(place)
    if not graph:
        raise ValueError("a place without rooms has no graph")
    left, bottom, right, top = _bounds(graph)
    wide, high = right - left, top - bottom
    scale = in_per_m((wide, high), IN_PER_M, least_in=LEAST_IN, most_in=MOST_IN)
    size = (wide * scale + 2 * EDGE_IN, high * scale + 2 * EDGE_IN + HEADER_IN)
    with own_page([title, *(words for _, words, _ in _names(graph))]):
        figure = Figure(figsize=size, dpi=DPI[form], facecolor="#FFFFFF")
        canvas = FigureCanvasAgg(figure)
        beside, above = EDGE_IN / 2.0 / size[0], HEADER_IN / size[1]
        figure.text(beside, 1.0 - above / 2.0, title, size=15, weight="bold", color=d.INK, va="center")
        ax = figure.add_axes((0.0, 0.0, 1.0, 1.0 - above))
        ax.set_axis_off()
        edge_m = EDGE_IN / scale
        ax.set_xlim(left - edge_m, right + edge_m)
        ax.set_ylim(bottom - edge_m, top + edge_m)
        _draw(ax, graph)
        _write(MapLabels(ax, canvas), graph, scale)
        return as_bytes(figure, form)


def _bounds(graph: nx.MultiGraph[str]) -> tuple[float, float, float, float]:
    """Left, bottom, right and top of all marks [m], at least one metre apart."""
    marks: list[XY] = [facts["at"] for _, facts in graph.nodes(data=True)]
    marks += [facts["at"] for _, _, facts in graph.edges(data=True) if facts["kind"] == "door"]
    xs, ys = zip(*marks, strict=True)
    left, bottom = min(xs), min(ys)
    return left, bottom, max(*xs, left + 1.0), max(*ys, bottom + 1.0)


def _draw(ax: Axes, graph: nx.MultiGraph[str]) -> None:
    """Draw the lines and the marks."""
    for one, other, facts in graph.edges(data=True):
        thin = facts["kind"] == "in"
        colour, style = (d.INK, "solid") if facts["is_open"] else (SHUT, "dashed")
        colour = LIGHT if thin else colour
        points = zip(*_line(graph, one, other, facts), strict=True)
        ax.plot(*points, color=colour, ls=style, lw=0.9 if thin else 1.8, zorder=1)
        if facts["kind"] == "door":
            ax.plot(
                *facts["at"], marker="s", ms=MARK_PT["door"], mfc="#FFFFFF", mec=colour, mew=1.6, zorder=3
            )
    for _, facts in graph.nodes(data=True):
        kind = facts["kind"]
        colour, level = (ROOM, 4) if kind == "room" else (LIGHT, 5)  # a place may lie on its room's mark
        ax.plot(*facts["at"], marker="o", ms=MARK_PT[kind], mfc=colour, mec="#FFFFFF", mew=0.8, zorder=level)


def _line(graph: nx.MultiGraph[str], one: str, other: str, facts: Mapping[str, Any]) -> list[XY]:
    """The line of an edge; that of a door bends at the door, following the actual path."""
    bend = [facts["at"]] if facts["kind"] == "door" else []
    return [graph.nodes[one]["at"], *bend, graph.nodes[other]["at"]]


def _write(labels: MapLabels, graph: nx.MultiGraph[str], scale: float) -> None:
    """Write the names clear of lines and marks: rooms, then doors, then places."""
    reach_m = {kind: points / 2.0 / 72.0 / scale for kind, points in MARK_PT.items()}
    for one, other, facts in graph.edges(data=True):
        labels.avoid_line(_line(graph, one, other, facts))
        if facts["kind"] == "door":
            labels.avoid_disc(facts["at"], reach_m["door"])
    for _, facts in graph.nodes(data=True):
        labels.avoid_disc(facts["at"], reach_m[facts["kind"]])
    for kind, words, about in sorted(_names(graph), key=lambda name: list(WORDS_PT).index(name[0])):
        labels.near(
            about["at"],
            reach_m[kind],
            words,
            size=WORDS_PT[kind],
            colour=SHUT if about.get("is_open") is False else d.GREY if kind == "place" else d.INK,
            weight="bold" if kind == "room" else "normal",
            prefer_rad=PREFER_RAD[kind],
        )


def _names(graph: nx.MultiGraph[str]) -> Iterator[tuple[str, str, Mapping[str, Any]]]:
    """Kind, name and attributes of everything named; for doors also the width, and whether they are shut.

    A place named like its room gets no label, and a door named like a room only the rest.
    """
    for node, facts in graph.nodes(data=True):
        if facts["name"] == node:
            yield facts["kind"], node, facts
    for one, other, key, facts in graph.edges(keys=True, data=True):
        if facts["kind"] == "door":
            name = key if key not in (one, other) else ""
            words = [name, f"{facts['width_m']:.2g} m", "" if facts["is_open"] else "shut"]
            yield "door", ", ".join(filter(None, words)), facts
