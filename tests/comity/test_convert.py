"""`comity convert`, and `.fis` files wherever a rulebook is named."""

from __future__ import annotations

import re

import pytest

FIS = """\
% A tip.
[System]
Name='tipper'
Type='mamdani'
Version=2.0
NumInputs=2
NumOutputs=1
NumRules=2
AndMethod='min'
OrMethod='max'
ImpMethod='min'
AggMethod='max'
DefuzzMethod='centroid'

[Input1]
Name='service quality'
Range=[0 10]
NumMFs=2
MF1='poor':'gaussmf',[1.5 0]
MF2='good':'smf',[2 9]

[Input2]
Name='food'
Range=[0 10]
NumMFs=1
MF1='rancid':'trapmf',[0 0 1 3]

[Output1]
Name='tip'
Range=[0 30]
NumMFs=2
MF1='cheap':'trimf',[0 5 10]
MF2='generous':'trimf',[20 25 30]

[Rules]
1 1, 1 (1) : 2
2 -1, 2 (0.5) : 1
"""


@pytest.fixture
def tipper(here):
    (here / "tipper.fis").write_text(FIS)
    return here / "tipper.fis"


def test_a_fis_file_answers_with_names_that_hold_spaces(comity, tipper):
    said = comity(
        "infer", "--rulebook", "tipper.fis", "--set", "service quality=3", "--set", "food=8", "--json"
    )
    assert said.code == 0
    assert said.json["inputs"] == {"service quality": 3.0, "food": 8.0}
    assert 0 < said.json["parameters"]["tip"]["value"] < 30
    assert said.json["parameters"]["tip"]["origin"] == "situation"


def test_there_and_back_again(comity, tipper, here):
    there = comity("convert", "tipper.fis", "tipper.yaml", "--json")
    back = comity("convert", "tipper.yaml", "back.fis", "--json")
    assert (there.code, back.code) == (0, 0)
    assert there.json["largest_differences"] == back.json["largest_differences"] == {"tip": 0.0}
    answers = [
        comity("infer", "--rulebook", name, "--set", "service quality=3", "--set", "food=1.7", "--json").json[
            "parameters"
        ]["tip"]["value"]
        for name in ("tipper.fis", "tipper.yaml", "back.fis")
    ]
    assert len(set(answers)) == 1
    assert not list(here.glob(".*"))


def test_the_text_says_what_was_chosen_and_what_is_lost(comity, tipper):
    said = comity("convert", "tipper.fis", "tipper.yaml")
    assert "Wrote tipper.yaml from tipper.fis: 2 inputs, 1 output, 2 rules" in said.out
    assert "kind situation" in said.out
    assert "Not carried over" in said.out
    said = comity("convert", "tipper.yaml", "back.fis")
    assert "sources and evidence of rules (comments only)" in said.out


def test_the_papers_second_case_for_matlab(comity, here):
    refused = comity("convert", "bruno2017-case2", "case2.fis")
    assert (refused.code, refused.out) == (2, "")
    assert "bruno2017-case2: expected a membership function that MATLAB knows" in refused.err
    assert not list(here.iterdir())
    said = comity("convert", "bruno2017-case2", "case2.fis", "--piecewise-linear", "0.06", "--json")
    assert any("largest error 0.05" in change for change in said.json["changed"])
    assert said.json["largest_differences"]["conversational_distance"] < 0.03
    inferred = comity(
        "infer", "--rulebook", "case2.fis", "--set", "individualism=38", "--set", "gender=1", "--json"
    )
    assert inferred.json["parameters"]["conversational_distance"]["value"] == pytest.approx(0.64, abs=0.03)


@pytest.mark.parametrize("name", ["tipper.fis", "notes.yaml"])
def test_a_file_that_comity_did_not_write_is_left_alone(comity, tipper, here, name):
    (here / "notes.yaml").write_text("my: notes\n")
    before = (here / name).read_text()
    said = comity("convert", "tipper.fis", name)
    assert said.code == 2
    assert "nothing is overwritten" in said.err
    assert (here / name).read_text() == before


def test_a_file_that_comity_wrote_is_renewed(comity, tipper, here):
    comity("convert", "tipper.fis", "again.fis")
    first = (here / "again.fis").read_text()
    assert comity("convert", "again.fis", "again.fis").code == 0
    assert (here / "again.fis").read_text().partition("[System]")[2] == first.partition("[System]")[2]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["none.fis", "out.yaml"], "no such file"),
        (["tipper.fis", "out.txt"], "expected a .fis file"),
        (["bruno2017", "out.yaml"], "expected a .fis file"),
        (["bruno2017", "out.fis"], "greeting_modality"),
        (["tipper.fis", "nowhere/out.yaml"], "nowhere/out.yaml"),
        (["bruno2016", "out.fis"], "bruno2017"),
    ],
)
def test_bad_words_are_refused_and_nothing_is_written(comity, tipper, here, words, expected):
    said = comity("convert", *words, *(["--piecewise-linear", "0.2"] if words[0] == "bruno2017" else []))
    assert (said.code, said.out) == (2, "")
    assert expected in said.err
    assert "Traceback" not in said.err
    assert [path.name for path in here.iterdir()] == ["tipper.fis"]


def test_a_fis_file_is_refused_with_its_line(comity, here):
    (here / "sugeno.fis").write_text(FIS.replace("'mamdani'", "'sugeno'"))
    said = comity("infer", "--rulebook", "sugeno.fis")
    assert said.code == 2
    assert "sugeno.fis:32: expected 'constant' in an output of a Sugeno system" in said.err


def test_the_answer_has_a_schema(comity):
    assert "largest_differences" in comity("schema", "convert").json["properties"]


def test_a_part_of_a_rulebook_answers_as_the_whole(comity, here):
    """`bruno2017` decides words too, which MATLAB has no output for: its distance can go alone."""
    words = ("convert", "bruno2017", "part.fis", "--piecewise-linear", "0.06")
    assert comity(*words).code == 2
    said = comity(*words, "--parameter", "conversational_distance", "--json")
    assert (said.code, said.json["parameters"], said.json["variables"]) == (0, 1, 2)
    assert said.json["largest_differences"]["conversational_distance"] < 0.03
    assert any("greeting_gesture" in loss for loss in said.json["lost"])


def test_a_part_that_is_not_there_is_named_with_the_closest(comity, here):
    said = comity("convert", "bruno2017", "part.fis", "--parameter", "conversation_distance")
    assert (said.code, list(here.iterdir())) == (2, [])
    assert "Did you mean 'conversational_distance'?" in said.err


@pytest.mark.parametrize("options", [[], ["--piecewise-linear", "0.05"]])
def test_the_error_that_is_suggested_is_enough(comity, options):
    said = comity("convert", "bruno2017-case2", "c2.fis", *options)
    assert said.code == 2
    enough = re.search(r"--piecewise-linear ([0-9.]+)[, ]", said.err)[1]
    assert comity("convert", "bruno2017-case2", "c2.fis", "--piecewise-linear", enough).code == 0
