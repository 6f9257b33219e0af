"""Factors become conditions as the design says, and one that it cannot combine is refused by its line."""

from __future__ import annotations

from math import prod
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.study.design import conditions_of
from comity.study.overlay import laid_over
from comity.study.study_file import StudyFile
from comity_fis import InputError
from comity_fis.validation.yaml_file import dump_yaml, parse_yaml

PATHS = st.lists(st.sampled_from(["a.b", "rulebook", "people.visited.posture", "c"]), unique=True, max_size=3)


def conditions(**keys):
    text = dump_yaml({"schema_version": 1, "name": "s", "scenarios": ["johanna"], **keys})
    file = parse_yaml(text, Path("s.yaml"), "s.yaml")
    return conditions_of(file, file.check(StudyFile))


def refused(**keys) -> InputError:
    with pytest.raises(InputError) as error:
        conditions(**keys)
    return error.value


@st.composite
def factors(draw):
    return {path: [f"{path} {i}" for i in range(draw(st.integers(1, 4)))] for path in draw(PATHS)}


@given(factors())
def test_a_full_design_has_every_combination_once(given_factors):
    found = conditions(factors=given_factors)
    assert len(found) == prod(map(len, given_factors.values()))
    assert len({tuple(one.values.items()) for one in found}) == len(found)
    assert [one.number for one in found] == list(range(1, len(found) + 1))
    for one in found:
        assert all(one.values[path] in levels for path, levels in given_factors.items())


@given(st.integers(1, 5), PATHS.filter(len))
def test_factors_in_step_change_together(count, paths):
    levels = {path: list(range(count)) for path in paths}
    found = conditions(factors=levels, design="in step")
    assert [dict(one.values) for one in found] == [dict.fromkeys(paths, i) for i in range(count)]


@given(st.integers(1, 40), st.integers(0, 5))
def test_a_latin_hypercube_meets_each_part_of_each_range_once(samples, seed):
    ranges = {"a": {"from": 0, "to": samples}, "b": {"from": -1.0, "to": 1.0}}
    found = conditions(factors=ranges, design="latin hypercube", samples=samples, design_seed=seed)
    assert sorted(int(min(one.values["a"], samples - 1e-6)) for one in found) == list(range(samples))
    parts = sorted(int((one.values["b"] + 1) / 2 * samples * (1 - 1e-7)) for one in found)
    assert parts == list(range(samples))


def test_lists_are_crossed_with_the_points_of_a_latin_hypercube():
    ranges = {"rulebook": ["x", "y"], "a": {"from": 0, "to": 1}}
    found = conditions(factors=ranges, design="latin hypercube", samples=3)
    points = [one.values["a"] for one in found if one.values["rulebook"] == "x"]
    assert points == [one.values["a"] for one in found if one.values["rulebook"] == "y"]
    assert len(set(points)) == 3


def test_whole_numbers_of_a_range_are_whole():
    ranges = {"a": {"from": 1, "to": 4, "whole": True}}
    found = conditions(factors=ranges, design="latin hypercube", samples=8)
    assert sorted(one.values["a"] for one in found) == [1, 1, 2, 2, 3, 3, 4, 4]


def test_some_factors_change_in_step_and_the_others_are_crossed():
    levels = {"a": [1, 2], "rulebook": ["x", "y"], "b": [3, 4]}
    found = conditions(factors=levels, in_step=[["a", "b"]])
    values = [tuple(one.values.values()) for one in found]
    assert values == [(1, "x", 3), (1, "y", 3), (2, "x", 4), (2, "y", 4)]


def test_listed_conditions_are_those_of_the_list():
    found = conditions(design="list", conditions=[{"a": 1}, {"a": 2, "rulebook": "x"}])
    assert [dict(one.values) for one in found] == [{"a": 1}, {"a": 2, "rulebook": "x"}]


def test_without_factors_there_is_one_condition():
    (one,) = conditions()
    assert one.values == {}


@pytest.mark.parametrize(
    ("keys", "line"),
    [
        ({"factors": {"a": [1], "b": [1, 2]}, "design": "in step"}, 8),
        ({"factors": {"a": {"from": 0, "to": 1}}}, 6),
        ({"factors": {"a": [1]}, "design": "latin hypercube", "samples": 2}, 8),
        ({"factors": {"a": {"from": 0, "to": 1}}, "design": "latin hypercube"}, 9),
        ({"design": "list"}, 5),
        ({"factors": {"a": [1]}, "conditions": [{"a": 1}], "design": "list"}, 5),
        ({"factors": {"a": [1]}, "samples": 3}, 8),
        ({"factors": {"a": [1]}, "in_step": [["a", "c"]]}, 9),
        ({"factors": {"a": {"from": 1, "to": 0}}}, 6),
        ({"factors": {"a": ["x", "y", "x"]}}, 9),
        ({"factors": {"a": [1, 1, 1], "b": [1, 2, 1]}, "design": "in step"}, 9),
        ({"conditions": [{"a": 1}, {"b": 1}, {"a": 1}], "design": "list"}, 8),
        ({"factors": {"a": list(range(1000)), "b": list(range(1000))}}, 5),
    ],
)
def test_a_broken_design_is_refused_by_its_line(keys, line):
    error = refused(**keys)
    assert error.where is not None
    assert (error.where.file, error.where.line) == ("s.yaml", line)


PLAIN = st.recursive(
    st.integers(), lambda inner: st.dictionaries(st.sampled_from("abc"), inner, max_size=3), max_leaves=8
)


@given(
    PLAIN.filter(lambda data: isinstance(data, dict)),
    st.lists(st.sampled_from("abc"), min_size=1, max_size=3),
)
def test_a_value_laid_over_stands_at_its_place_and_all_else_is_as_before(data, keys):
    before = repr(data)
    try:
        found = laid_over(data, keys, "new")
    except InputError:
        return  # the way leads through a number
    assert repr(data) == before
    place = found
    for key in keys:
        place = place[key]
    assert place == "new"
    assert {key: found[key] for key in found if key != keys[0]} == {
        key: data[key] for key in data if key != keys[0]
    }


def test_a_number_counts_the_items_of_a_list():
    assert laid_over({"a": [1, {"b": 2}]}, ["a", "1", "b"], 3) == {"a": [1, {"b": 3}]}
    with pytest.raises(InputError):
        laid_over({"a": [1]}, ["a", "1"], 3)
