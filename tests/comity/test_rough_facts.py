"""Facts on the command line that are known only roughly."""

import pytest


def test_an_interval_lies_between_precise_facts(comity):
    def speed(fact):
        said = comity("infer", "--set", fact, "--set", "robot_experience=high", "--set", "age=30", "--json")
        assert said.code == 0, said.err
        return said.json["parameters"]["approach_speed"], said.json["inputs"]["individualism"]

    low, middle, high = speed("individualism=30"), speed("individualism=30..67"), speed("individualism=67")
    assert low[0]["value"] < middle[0]["value"] < high[0]["value"]
    assert middle[1] == [30.0, 67.0]


def test_several_cultures_are_refused_with_the_way_that_takes_them(comity, here):
    said = comity("infer", "--set", "culture={JPN: 1, IND: 1}")
    assert said.code == 2
    assert "Write `culture: {JPN: 1, IND: 1}` into a profile and name that" in said.err
    (here / "both.yaml").write_text("name: Both\nculture: {JPN: 1, IND: 1}\n")
    assert comity("infer", "both.yaml").code == 0


def test_a_country_without_a_score_is_noted_and_not_refused(comity):
    said = comity("infer", "--set", "culture=Kosovo")
    assert said.code == 0
    assert "Kosovo has no score in the table of individualism" in " ".join(said.out.split())


def test_it_is_shown_as_it_was_said(comity):
    said = comity("infer", "--set", "age=60..70")
    assert "age 60..70 years" in said.out
    assert "60..70 years" in comity("explain", "approach_speed", "--set", "age=60..70").out


@pytest.mark.parametrize(
    "words", ["70..60", "60..", "..", "60..200", "60...70", "60..60..70", "6_0", "inf", "6_0..70"]
)
def test_what_is_no_interval_is_refused(comity, words):
    said = comity("infer", "--set", f"age={words}")
    assert said.code == 2
    assert "--set" in said.err
    assert "Traceback" not in said.err


def test_there_is_no_negative_zero(comity):
    assert "individualism 0 " in comity("infer", "--set", "individualism=-0").out
