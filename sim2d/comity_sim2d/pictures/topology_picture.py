"""A picture of a place as a graph: rooms and named places, and the doors between them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from comity_sim2d.maps.topology import topology
from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.page import DPI, as_bytes, in_per_m, own_page

if TYPE_CHECKING:
    import networkx as nx
    from matplotlib.axes import Axes

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.scene import Scene

EDGE_IN, HEADER_IN = 0.4, 0.5
LEAST_IN, MOST_IN = 7.0, 16.0
IN_PER_M = 0.6
ROOM, LIGHT, SHUT = "#0B6E6E", "#8FA3A3", "#B3261E"
BOX = {"boxstyle": "round,pad=0.1", "fc": "#FFFFFF", "ec": "none", "alpha": 0.8}


def draw_topology(place: PlaceMap | Scene, *, title: str, form: str = "png") -> bytes:
    """Rooms where they are, doors as lines with their names; a shut door is a dashed red line.

    Args:
        place: A map, or a scene with rooms.
        title: The headline.
        form: `png`, `svg` or `pdf`.

    Raises:
        ValueError: The place has no rooms.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    graph = topology(place)
    if not graph:
        raise ValueError("a place without rooms has no graph")
    wide, high = d.extent_m(place)
    scale = in_per_m((wide, high), IN_PER_M, least_in=LEAST_IN, most_in=MOST_IN)
    size = (wide * scale + 2 * EDGE_IN, high * scale + HEADER_IN)
    with own_page([*graph, title]):
        figure = Figure(figsize=size, dpi=DPI[form], facecolor="#FFFFFF")
        FigureCanvasAgg(figure)
        beside, above = EDGE_IN / size[0], HEADER_IN / size[1]
        ax = figure.add_axes((beside, 0.0, 1.0 - 2.0 * beside, 1.0 - above))
        ax.set_title(title, loc="left", size=15, weight="bold", color=d.INK)
        _draw(ax, graph, scale)
        return as_bytes(figure, form)


def _draw(ax: Axes, graph: nx.MultiGraph[str], scale: float) -> None:
    """The edges of a door bend at the door, so that lines lie where one walks."""
    import networkx as nx

    at = nx.get_node_attributes(graph, "at")
    ax.axis("off")
    ax.set_aspect("equal")
    ax.margins(0.06)
    for one, other, facts in graph.edges(data=True):
        points = [at[one], *([facts["at"]] if facts["kind"] == "door" else []), at[other]]
        colour, style = (d.INK, "solid") if facts["is_open"] else (SHUT, "dashed")
        thin = facts["kind"] == "in"
        colour = LIGHT if thin else colour
        ax.plot(*zip(*points, strict=True), color=colour, ls=style, lw=0.9 if thin else 1.8, zorder=1)
    for kind, colour, size in (("room", ROOM, 220), ("place", LIGHT, 45)):
        nodes = [node for node, facts in graph.nodes(data=True) if facts["kind"] == kind]
        nx.draw_networkx_nodes(graph, at, ax=ax, nodelist=nodes, node_color=colour, node_size=size)
        for node in nodes:
            _name(ax, graph, node, scale)
    for one, other, key, facts in graph.edges(keys=True, data=True):
        if facts["kind"] == "door":
            _draw_door(ax, key if key not in (one, other) else "", facts)


def _name(ax: Axes, graph: nx.MultiGraph[str], node: str, scale: float) -> None:
    """Rooms below their mark, places above theirs; a place that is called like its room has no name."""
    facts = graph.nodes[node]
    x, y = facts["at"]
    words: dict[str, Any] = {"color": d.INK, "ha": "center", "bbox": BOX, "zorder": 5}
    if facts["kind"] == "room":
        ax.text(x, y - 0.13 / scale, facts["name"], size=10.0, weight="bold", va="top", **words)
    elif facts["name"] == node:
        ax.text(x, y + 0.08 / scale, facts["name"], size=7.5, va="bottom", **words)


def _draw_door(ax: Axes, name: str, facts: Mapping[str, Any]) -> None:
    """A mark where it is, with its name, unless that is a room's, its width, and that it is shut."""
    x, y = facts["at"]
    colour = d.INK if facts["is_open"] else SHUT
    ax.plot(x, y, marker="s", ms=6, mfc="#FFFFFF", mec=colour, mew=1.6, zorder=3)
    words = [name, f"{facts['width_m']:.2g} m", "" if facts["is_open"] else "shut"]
    ax.annotate(
        ", ".join(filter(None, words)),
        (x, y),
        xytext=(6, 0),
        textcoords="offset points",
        size=7.5,
        color=colour,
        va="center",
        bbox=BOX,
        zorder=4,
    )
