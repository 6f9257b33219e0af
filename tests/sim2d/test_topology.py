"""Rooms, doors and named places as a graph: what joins what, and which doors would have to open."""

from __future__ import annotations

import re
from dataclasses import replace

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import (
    Area,
    Door,
    Location,
    PlaceMap,
    RobotBody,
    Room,
    World,
    load_map,
    shipped_maps,
)
from comity_sim2d.maps.topology import room_at, shut_doors_between, topology
from comity_sim2d.pictures.topology_picture import draw_topology

WIDE_M = 4.0


def row(states) -> PlaceMap:
    """Rooms side by side, with a door between each two, open or shut."""
    areas = tuple(
        Area(f"room {i}", ((x, 0.0), (x + WIDE_M, 0.0), (x + WIDE_M, 3.0), (x, 3.0)))
        for i, x in enumerate(WIDE_M * k for k in range(len(states) + 1))
    )
    doors = tuple(
        Door(f"door {i}", (WIDE_M * (i + 1), 1.0), (WIDE_M * (i + 1), 2.0), is_open=is_open)
        for i, is_open in enumerate(states)
    )
    return PlaceMap("row", Room.rectangle(WIDE_M * len(areas), 3.0), areas=areas, doors=doors)


@given(st.lists(st.booleans(), min_size=1, max_size=6))
def test_the_doors_that_have_to_open_are_the_shut_ones_on_the_way(states):
    graph = topology(row(states))
    (shut,) = shut_doors_between(graph, "room 0", f"room {len(states)}")
    assert list(shut) == [f"door {i}" for i, is_open in enumerate(states) if not is_open]


@given(st.lists(st.booleans(), min_size=1, max_size=6))
def test_once_they_are_open_the_rooms_are_joined(states):
    place = row(states)
    (shut,) = shut_doors_between(topology(place), "room 0", f"room {len(states)}")
    graph = topology(
        place, [replace(door, is_open=door.is_open or door.name in shut) for door in place.doors]
    )
    open_ways = nx.Graph((one, other) for one, other, facts in graph.edges(data=True) if facts["is_open"])
    assert nx.has_path(open_ways, "room 0", f"room {len(states)}")


def test_of_two_ways_the_one_with_fewer_shut_doors_comes_first():
    """The red room has a door to the hall, and one to the blue room, which is open to the hall."""
    place = load_map("reception-hall")

    def ways(*shut):
        doors = [replace(door, is_open=door.name not in shut) for door in place.doors]
        return list(shut_doors_between(topology(place, doors), "hall", "red room"))

    assert ways("red room", "side door") == [["red room"], ["side door"]]
    assert ways("red room", "side door", "blue room") == [["red room"], ["blue room", "side door"]]
    assert ways("red room") == [[], ["red room"]]


def test_a_room_without_doors_has_no_ways_and_an_unknown_one_is_an_error():
    """As networkx has it."""
    place = row([True])
    alone = Area("room 9", ((0.0, 5.0), (2.0, 5.0), (2.0, 7.0), (0.0, 7.0)))
    graph = topology(replace(place, room=Room.rectangle(8.0, 8.0), areas=(*place.areas, alone)))
    assert not list(shut_doors_between(graph, "room 0", "room 9"))
    with pytest.raises(nx.NodeNotFound):
        next(shut_doors_between(graph, "room 0", "attic"))


@pytest.mark.parametrize("name", shipped_maps())
def test_every_shipped_map_is_one_graph_with_every_door_and_place(name):
    place = load_map(name)
    graph = topology(place)
    assert nx.is_connected(graph)
    joined = {key for *_, key, facts in graph.edges(keys=True, data=True) if facts["kind"] == "door"}
    assert joined == {door.name for door in place.doors}
    for location in place.locations:
        node = next(n for n, facts in graph.nodes(data=True) if facts["at"] == location.xy)
        assert graph.nodes[node]["name"] == location.name
        assert list(graph[node]) == [room_at(place, location.xy)]


def test_rooms_that_overlap_are_open_to_each_other():
    left = Area("left", ((0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)))
    right = Area("right", ((2.0, 0.0), (5.0, 0.0), (5.0, 3.0), (2.0, 3.0)))
    place = PlaceMap("two", Room.rectangle(5.0, 3.0), areas=(left, right))
    assert topology(place)["left"]["right"]["open"]["kind"] == "open"


def test_a_place_that_is_called_like_a_room_is_another_node():
    hall = Area("hall", ((0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)))
    place = PlaceMap("one", Room.rectangle(3.0, 3.0), areas=(hall,), locations=(Location("hall", 1.0, 1.0),))
    assert dict(topology(place).nodes(data="kind")) == {"hall": "room", "place hall": "place"}


def test_a_world_tells_its_doors_as_they_are_now():
    world = World(load_map("ward").scene(RobotBody(1.0, 5.6)))
    assert not world.topology["corridor"]["bath"]["bath"]["is_open"]
    world.set_door("bath", open=True)
    assert world.topology["corridor"]["bath"]["bath"]["is_open"]


@pytest.mark.parametrize("form", ["png", "svg"])
def test_its_picture_is_the_same_in_every_run(form):
    place = load_map("apartment")
    assert draw_topology(place, title="a", form=form) == draw_topology(place, title="a", form=form)


def test_its_picture_names_rooms_doors_and_places():
    drawn = draw_topology(load_map("apartment"), title="the flat", form="svg").decode()
    words = re.findall(r"<text[^>]*>([^<]+)</text>", drawn)
    assert {"the flat", "living room", "front door", "passage, 1.8 m", "0.8 m, shut"} <= set(words)


def test_the_command_draws_it(comity, here):
    said = comity("draw", "ward", "--graph", "--json")
    assert said.json["file"] == "ward-graph.png"
    assert (here / "ward-graph.png").read_bytes().startswith(b"\x89PNG")
    assert comity("draw", "two-visits", "--graph", "--out", "two.svg").code == 0
    assert "<svg" in (here / "two.svg").read_text()
