"""Individuals: the same for the same seed, independent of each other, and of the rulebooks compared."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

import pytest
from hypothesis import given
from hypothesis import strategies as st
from study.writing import COMFORT, population

from comity.study.population import load_population, wished_m
from comity_fis import InputError, load_rulebook

DAY = date(2026, 1, 1)


def individuals(folder, **keys):
    path = population(folder / "people.yaml", **keys)
    return load_population(path, "people.yaml", DAY).individuals


def grown(count, **keys):
    return {"swedish": {"individuals": count, "comfort": COMFORT, **keys}}


def test_the_same_seed_gives_the_same_individuals(tmp_path):
    assert individuals(tmp_path, seed=4) == individuals(tmp_path, seed=4)
    assert individuals(tmp_path, seed=4) != individuals(tmp_path, seed=5)


@given(few=st.integers(1, 5), more=st.integers(0, 5), seed=st.integers(0, 3))
def test_a_group_that_grows_keeps_its_individuals(tmp_path_factory, few, more, seed):
    folder = tmp_path_factory.mktemp("people")
    keys = {"seed": seed, "wishes": {"share": 0.5}}
    first = individuals(folder, groups=grown(few), **keys)
    assert individuals(folder, groups=grown(few + more), **keys)[:few] == first


def test_another_group_changes_no_individual(tmp_path):
    alone = individuals(tmp_path, groups=grown(3))
    beside = individuals(tmp_path, groups={"other": {"individuals": 2}, **grown(3)})
    assert beside[2:] == alone


@given(seed=st.integers(0, 50), sd_m=st.floats(0, 3), half_m=st.floats(0.025, 3))
def test_a_drawn_comfort_is_one_that_people_can_have(tmp_path_factory, seed, sd_m, half_m):
    comfort = {**COMFORT, "sd_m": sd_m, "half_width_m": half_m}
    found = individuals(tmp_path_factory.mktemp("people"), groups=grown(3, comfort=comfort), seed=seed)
    for one in found:
        near_m, far_m = one.comfort.wants_m
        assert 0 <= near_m < far_m <= 20
        assert far_m - near_m == pytest.approx(2 * half_m, abs=0.002)


def test_drawn_comfort_has_the_stated_mean_and_spread(tmp_path):
    middles = [sum(one.comfort.wants_m) / 2 for one in individuals(tmp_path, groups=grown(400))]
    mean = sum(middles) / len(middles)
    spread = (sum((one - mean) ** 2 for one in middles) / len(middles)) ** 0.5
    assert mean == pytest.approx(0.8, abs=0.04)
    assert spread == pytest.approx(0.25, abs=0.03)


def test_facts_are_drawn_within_what_is_stated(tmp_path):
    facts = {"age": {"from": 60, "to": 70}, "gender": {"any_of": ["female", "male"]}, "culture": "SWE"}
    found = individuals(tmp_path, groups=grown(40, facts=facts))
    assert all(60 <= one.profile["age"] <= 70 for one in found)
    assert {one.profile["gender"] for one in found} == {"female", "male"}
    assert {one.profile["culture"] for one in found} == {"SWE"}


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_a_share_of_wishes_of_none_and_of_all(tmp_path, share):
    found = individuals(tmp_path, groups=grown(20), wishes={"share": share})
    assert sum("settings" in one.profile for one in found) == 20 * share


def test_a_wish_is_what_the_individual_likes_and_changes_nothing_else(tmp_path):
    without = individuals(tmp_path, groups=grown(60))
    found = individuals(tmp_path, groups=grown(60), wishes={"share": 0.3})
    wishing = [one for one in found if "settings" in one.profile]
    assert 8 <= len(wishing) <= 28
    assert all(
        one.profile["settings"] == {"conversational_distance": wished_m(one.comfort)} for one in wishing
    )
    bare = [replace(one, profile={k: v for k, v in one.profile.items() if k != "settings"}) for one in found]
    assert tuple(bare) == without


def test_comfort_may_follow_from_a_rulebook(tmp_path):
    comfort = {"rulebook": "evidence", "source": "design choice"}
    found = individuals(tmp_path, groups=grown(400, comfort=comfort, facts={"culture": "SWE"}))
    middles = [sum(one.comfort.wants_m) / 2 for one in found]
    parameter = load_rulebook("evidence").parameters["conversational_distance"]
    mean = sum(middles) / len(middles)
    assert mean == pytest.approx(load_rulebook("evidence").infer({})[parameter.name].number, abs=0.15)


TABLE = """individual,group,culture,gender,age,education,comfort_near_m,comfort_far_m,wish_m
anna,old,SWE,female,71,5,0.6,1.0,
omar,young,EGY,male,30,,,,0.9
"""


def taken(folder, text, **keys):
    (folder / "people.csv").write_text(text, "utf-8")
    return individuals(folder, groups={}, table="people.csv", **keys)


def test_individuals_are_taken_from_a_table_under_pseudonyms(tmp_path):
    anna, omar = taken(tmp_path, TABLE, wishes="stated")
    assert (anna.name, anna.group, anna.comfort.wants_m) == ("individual_1", "old", (0.6, 1.0))
    assert anna.profile == {
        "name": "individual_1",
        "culture": "SWE",
        "gender": "female",
        "age": 71,
        "education": 5,
    }
    assert omar.comfort is None
    assert omar.profile["settings"] == {"conversational_distance": 0.9}


def test_a_comfort_for_all_goes_behind_that_of_a_row(tmp_path):
    anna, omar = taken(tmp_path, TABLE, wishes="stated", comfort={"wants_m": [0.4, 0.9]})
    assert (anna.comfort.wants_m, omar.comfort.wants_m) == ((0.6, 1.0), (0.4, 0.9))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (TABLE.replace("culture", "cultur"), 1),
        (TABLE.replace("individual,", "participant,"), 1),
        (TABLE.replace("omar", "anna"), 3),
        (TABLE.replace("1.0", "0.5"), 2),
        (TABLE.replace("71", "old"), 2),
        (TABLE.replace("71", "710"), 2),
        (TABLE.replace("comfort_far_m", "group"), 1),
        ("individual,wish_m\n", 1),
    ],
)
def test_a_broken_table_is_refused_by_its_line(tmp_path, text, line):
    with pytest.raises(InputError) as error:
        taken(tmp_path, text, wishes="stated")
    assert error.value.where is not None
    assert (error.value.where.file, error.value.where.line) == (str(tmp_path / "people.csv"), line)


def test_a_column_of_wishes_needs_the_word_of_the_population(tmp_path):
    with pytest.raises(InputError):
        taken(tmp_path, TABLE)


@pytest.mark.parametrize(
    "keys",
    [
        {"groups": {}},
        {"groups": grown(2), "table": "people.csv"},
        {"groups": grown(2), "wishes": "stated"},
        {"groups": grown(2, comfort={"middle_m": 0.8, "source": "design choice"})},
        {"groups": grown(2, comfort={"middle_m": 0.8, "sd_m": 0.1})},
        {"groups": grown(2, facts={"age": "old"})},
        {"groups": grown(2, facts={"shoe": 43})},
        {"groups": grown(0)},
    ],
)
def test_a_broken_population_is_refused_by_its_line(tmp_path, keys):
    with pytest.raises(InputError) as error:
        individuals(tmp_path, **keys)
    assert error.value.where is not None
    assert error.value.where.line is not None
