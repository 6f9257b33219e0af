"""Longitudinal adaptation: one person, the same rules, year after year."""

from __future__ import annotations

import struct

import pytest

from comity.people.profile import load_profile


@pytest.fixture
def life(comity):
    def lived(rulebook, years="2003..2022"):
        said = comity("profile", "show", "one_life", "--years", years, "--rulebook", rulebook, "--json")
        assert said.code == 0, said.err
        return said.json["years"]

    return lived


def test_every_year_is_what_inference_says_on_its_last_day(comity, life):
    for year in life("bruno2017")[::5]:
        alone = comity("infer", "one_life", "--at", year["at"], "--json").json
        assert year["inputs"] == alone["inputs"]
        for name, value in year["parameters"].items():
            assert value["value"] == alone["parameters"][name]["value"]


def test_moving_and_growing_old_change_the_distance_and_the_speed(life):
    years = {int(year["at"][:4]): year for year in life("bruno2017")}
    distance, speed = (
        {when: year["parameters"][name]["value"] for when, year in years.items()}
        for name in ("conversational_distance", "approach_speed")
    )
    assert distance[2003] < distance[2004] == distance[2013] < distance[2014] == distance[2022]
    assert speed[2010] > speed[2013] > speed[2018] > speed[2020]
    assert years[2004]["changed"] == ["culture Egypt 50%, Sweden 50%"]
    assert years[2005]["changed"] == []


def test_education_and_age_change_what_the_illustrative_rules_read(life):
    years = {int(year["at"][:4]): year["parameters"] for year in life("illustrative-levels")}
    assert years[2009]["approach_direction"]["value"] < years[2010]["approach_direction"]["value"]
    assert years[2010]["approach_speed"]["value"] > years[2020]["approach_speed"]["value"]


def test_a_life_is_shown_as_a_table_and_a_picture(comity, here):
    said = comity("profile", "show", "one_life", "--years", "2003..2022", "--picture", "life.png")
    assert said.code == 0
    assert [line.split()[0] for line in said.out.splitlines() if line[3:7].isdigit()] == [
        str(year) for year in range(2003, 2023)
    ]
    png = (here / "life.png").read_bytes()
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">I", png[16:20]) == (1200,)
    comity("profile", "show", "one_life", "--years", "2003..2022", "--picture", "again.png")
    assert (here / "again.png").read_bytes() == png


@pytest.mark.parametrize("years", ["2005", "2005..", "2025..2005", "a..b", "1..9999", "0000..0001"])
def test_years_that_are_none_are_refused_and_nothing_is_drawn(comity, here, years):
    said = comity("profile", "show", "one_life", "--years", years, "--picture", "life.png")
    assert said.code == 2
    assert "2005..2025" in said.err
    assert not list(here.iterdir())


def test_years_before_the_birth_are_refused(comity):
    said = comity("profile", "show", "one_life", "--years", "1940..1960")
    assert said.code == 2
    assert "in the future of that day" in said.err


def test_the_shipped_life_says_that_it_is_invented():
    profile = load_profile("one_life").profile
    assert "invented" in profile.about
