"""What is written in a file, flat: every value once, by its place, with its line."""

from __future__ import annotations

from pathlib import Path

import yaml
from hypothesis import given
from hypothesis import strategies as st

from comity.testing.golden.leaves import BETWEEN, source_of
from comity_fis.validation.yaml_file import parse_yaml

KEYS = st.text("abc", min_size=1, max_size=3)
PLAIN = st.integers(-99, 99) | st.booleans() | st.text("xyz ", max_size=4)
DATA = st.dictionaries(
    KEYS,
    st.recursive(PLAIN, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner, max_size=4)),
    min_size=1,
    max_size=4,
)


def flat(data, prose=()):
    file = parse_yaml(yaml.safe_dump(data, sort_keys=False), Path("x.yaml"), "x.yaml")
    return file, source_of(file, file.data, prose)


def rebuilt(leaves):
    """The data, with mappings by number in the place of lists that are no plain ones."""
    data = {}
    for place, value in leaves.items():
        *around, last = place.split(BETWEEN)
        inner = data
        for part in around:
            inner = inner.setdefault(part, {})
        inner[last] = value
    return data


def numbered(part):
    if isinstance(part, dict):
        return {key: numbered(inner) for key, inner in part.items()}
    if isinstance(part, list) and any(isinstance(inner, list | dict) for inner in part):
        return {str(number): numbered(inner) for number, inner in enumerate(part, 1)}
    return part


@given(DATA)
def test_nothing_is_lost_and_nothing_added(data):
    _, source = flat(data)
    assert rebuilt(source.leaves) == numbered(data)
    assert list(source.leaves) == sorted(source.leaves)


@given(DATA)
def test_every_value_knows_its_line_and_what_is_gone_the_line_of_what_is_left_around_it(data):
    file, source = flat(data)
    for place in source.leaves:
        where = source.where(place)
        assert where.line in file.lines.values()
        assert source.where(f"{place}{BETWEEN}gone") == where
    first = next(iter(data))
    assert source.where(first) == file.where((first,))


def test_each_piece_of_a_list_has_its_own_line():
    text = "goals:\n  - greet: kim\n  - greet: sam\npolygon_m:\n  - [0, 0]\n  - [1, 0]\n"
    file = parse_yaml(text, Path("x.yaml"), "x.yaml")
    source = source_of(file, file.data, ())
    assert {place: source.where(place).line for place in source.leaves} == {
        "goals / 1 / greet": 2,
        "goals / 2 / greet": 3,
        "polygon_m / 1": 5,
        "polygon_m / 2": 6,
    }


def test_pieces_go_by_their_names_where_each_has_one_of_its_own():
    named = [{"name": "desk", "box_m": [0, 1, 2, 3]}, {"name": "sofa", "polygon_m": [[0, 0], [1, 0]]}]
    _, source = flat({"furniture": named})
    assert source.leaves == {
        "furniture / desk / box_m": [0, 1, 2, 3],
        "furniture / sofa / polygon_m / 1": [0, 0],
        "furniture / sofa / polygon_m / 2": [1, 0],
    }
    _, source = flat({"furniture": [*named, {"name": "desk", "box_m": [4, 4, 1, 1]}]})
    assert list(source.leaves)[:2] == ["furniture / 1 / box_m", "furniture / 1 / name"]


def test_prose_is_left_out_and_what_is_only_called_so_is_not():
    _, source = flat(
        {"about": "a hall", "people": {"about": {"at_m": [1, 1]}, "kim": {"about": "x"}}}, ("about",)
    )
    assert source.leaves == {"people / about / at_m": [1, 1]}
