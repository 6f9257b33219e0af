"""A place as a graph: rooms and named places, connected by doors and by overlaps of rooms."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, islice, pairwise
from typing import TYPE_CHECKING

from comity_sim2d.maps.rooms import shape_of
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    import networkx as nx
    from shapely import Polygon

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.door import Door
    from comity_sim2d.scene.scene import Scene

    Topology = nx.MultiGraph[str]

BESIDE_M = 0.15
"""Distance from a door's centre at which a point is in the adjacent room [m]: walls are thinner (our
choice)."""
MOST_WAYS = 8
"""Maximum number of paths through doors that are examined, fewest shut doors first (our choice)."""


def topology(place: PlaceMap | Scene, doors: Iterable[Door] | None = None) -> Topology:
    """The graph of the rooms of a place and their connections.

    Args:
        place: A map, or a scene.
        doors: The doors in their current state; None: those of the place.

    Returns:
        A graph whose nodes are rooms by name (`kind` is `room`, `at` a point inside [m]) and named places
        (`kind` is `place`, `at` their position [m]; the node is `place NAME` if a room has the same name).
        Edges are doors, keyed by name (`kind` is `door`, with `width_m`, `is_open` and `at`), overlaps of
        rooms (`kind` is `open`), and places in their room (`kind` is `in`). It is empty for a place without
        rooms.
    """
    import networkx as nx
    from shapely import Point

    graph: Topology = nx.MultiGraph()
    shapes = _shapes(place)
    for name, shape in shapes.items():
        inside = shape.representative_point()
        graph.add_node(name, kind="room", name=name, at=(inside.x, inside.y))
    for room, next_room in combinations(shapes, 2):
        if shapes[room].intersection(shapes[next_room]).area > 0.0:
            graph.add_edge(room, next_room, key="open", kind="open", is_open=True)
    for door in place.doors if doors is None else doors:
        one, other = (_room_in(shapes, xy) for xy in _beside(door))
        if one is not None and other is not None:
            width_m = Point(door.start).distance(Point(door.end))
            facts = {"width_m": width_m, "is_open": door.is_open, "at": _middle(door)}
            graph.add_edge(one, other, key=door.name, kind="door", **facts)
    for location in place.locations:
        node = f"place {location.name}" if location.name in shapes else location.name
        if (around := _room_in(shapes, location.xy)) is not None:
            graph.add_node(node, kind="place", name=location.name, at=location.xy)
            graph.add_edge(around, node, key="in", kind="in", is_open=True)
    return graph


def room_at(place: PlaceMap | Scene, xy: XY) -> str | None:
    """The room that contains a point, the first if rooms overlap; None outside all rooms."""
    return _room_in(_shapes(place), xy)


def shut_doors_between(graph: Topology, here: str, there: str) -> Iterator[Sequence[str]]:
    """The shut doors on paths between two rooms, fewest first; at most `MOST_WAYS` paths.

    Args:
        graph: As returned by `topology`.
        here: A room.
        there: Another room.

    Raises:
        networkx.NodeNotFound: A room is not in the graph.
    """
    import networkx as nx

    simple: nx.Graph[str] = nx.Graph()
    simple.add_nodes_from(graph)
    for one, other, facts in graph.edges(data=True):
        shut = int(not facts["is_open"])
        if one != other and shut <= simple.get_edge_data(one, other, {"shut": 1})["shut"]:
            simple.add_edge(one, other, shut=shut)
    if not nx.has_path(simple, here, there):
        return
    for way in islice(nx.shortest_simple_paths(simple, here, there, weight="shut"), MOST_WAYS):
        yield _shut_on(graph, way)


def _shut_on(graph: Topology, way: Sequence[str]) -> Sequence[str]:
    """The doors to open on a path through these rooms; none between rooms that have an open door."""
    shut = []
    for one, other in pairwise(way):
        between = graph.get_edge_data(one, other)
        if not any(facts["is_open"] for facts in between.values()):
            shut.append(min(map(str, between)))
    return shut


def _shapes(place: PlaceMap | Scene) -> dict[str, Polygon]:
    return {area.name: shape_of(area) for area in place.areas}


def _room_in(shapes: Mapping[str, Polygon], xy: XY) -> str | None:
    from shapely import Point

    point = Point(xy)
    return next((name for name, shape in shapes.items() if shape.covers(point)), None)


def _middle(door: Door) -> XY:
    return ((door.start[0] + door.end[0]) / 2, (door.start[1] + door.end[1]) / 2)


def _beside(door: Door) -> tuple[XY, XY]:
    """A point on each side of a door's centre."""
    (x, y), dx, dy = _middle(door), door.end[0] - door.start[0], door.end[1] - door.start[1]
    far = BESIDE_M / (dx * dx + dy * dy) ** 0.5
    return (x - dy * far, y + dx * far), (x + dy * far, y - dx * far)
