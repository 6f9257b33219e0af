"""`comity explain`: text, JSON and picture are the same explanation."""

from __future__ import annotations

import os
import re
import struct
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.report.drawing import LETTER, folded
from comity.report.values.explanation_picture import write_explanation
from comity.report.values.explanation_words import ordered_rules
from comity_fis import Interval, explain, load_rulebook
from comity_fis.membership.function import Trapezoid

CASES = [
    ("conversational_distance", "german_woman"),
    ("conversational_distance", "arab_man"),
    ("conversational_distance", "unknown"),
    ("conversational_distance", "own_wish"),
    ("conversational_distance", "german_woman", "--set", "gender=unknown"),
    ("conversational_distance", "german_woman", "--rulebook", "bruno2017-case1"),
    ("approach_direction", "unknown", "--set", "posture=seated"),
    ("approach_speed", "british_elder"),
    ("approach_speed", "british_elder", "--set", "age=65"),
    ("greeting_gesture", "german_host", "--set", "touch_consent=unknown"),
    ("greeting_gesture", "own_wish"),
    ("greeting_gesture", "unknown"),
    ("greeting_modality", "japanese_woman"),
]


@pytest.mark.parametrize("words", CASES, ids=" ".join)
def test_text_and_json_carry_the_same_numbers(comity, words):
    answer, text = comity("explain", *words, "--json").json, comity("explain", *words).out
    value = answer["value"]
    shown = (
        value.replace("_", " ")
        if isinstance(value, str)
        else f"{value:.{1 if answer['unit'] == 'deg' else 3}f}"
    )
    assert shown in next(line for line in text.splitlines() if not line.startswith("Note: "))
    for rule in answer["rules"]:
        (line,) = [line for line in text.splitlines() if re.match(rf"   {rule['number']} .*\d\.\d\d\d", line)]
        assert f"{rule['strength']:.3f}" in line
        if rule["share"] is not None:
            assert f"{100 * rule['share']:.1f} %" in line
        if answer["unit"] == "m":
            assert f"{100 * rule['contribution']:.1f} cm" in line
    for one in answer["derivatives"]:
        assert ("flat here" in text) or not one["flat"]
    for flip in answer["flips"]:
        (line,) = [line for line in text.splitlines() if f"{flip['now']:g} → " in line]
        near = float(line.split("→")[1].split()[0])
        assert near == pytest.approx(flip["to"], rel=0.01)
        assert abs(near - flip["now"]) >= abs(flip["to"] - flip["now"])  # rounded so that it flips


@pytest.mark.parametrize("words", CASES, ids=" ".join)
def test_contributions_in_the_answer_add_up(comity, words):
    answer = comity("explain", *words, "--json").json
    if answer["rules"] and answer["unit"]:
        assert sum(rule["contribution"] for rule in answer["rules"]) == pytest.approx(
            answer["value"], abs=1e-9
        )
        assert sum(rule["share"] for rule in answer["rules"]) == pytest.approx(1)


def test_stating_what_it_says_flips_really_flips(comity):
    """What a reader would do with the line: type it in."""
    text = comity("explain", "conversational_distance", "german_woman").out
    near = re.search(r"individualism 67 → (\S+) +makes close lead instead of medium", text)
    assert near
    again = ("explain", "conversational_distance", "german_woman", "--json", "--set")
    assert comity(*again, f"individualism={near[1]}").json["leading"] == ["close"]
    assert comity(*again, f"individualism={float(near[1]) + 0.1}").json["leading"] == ["medium"]
    assert comity(*again, "gender=male").json["leading"] == ["far"]


def test_a_wish_shows_no_rules_and_what_they_would_have_given(comity):
    said = comity("explain", "conversational_distance", "own_wish", "--set", "individualism=67")
    assert "asked for by the person" in said.out
    assert "Without this wish it would be 0.944 m" in said.out
    assert "Rules that fired" not in said.out


def test_the_neutral_value_shows_no_rules_and_what_disclosing_would_give(comity):
    said = comity("explain", "conversational_distance", "unknown")
    assert "No rule decided: the neutral value stands." in said.out
    assert re.search(r"gender +male +0.946 m +\+12.1 cm", said.out)
    assert "Rules that fired" not in said.out


def test_consent_is_named_where_it_keeps_a_greeting_out(comity):
    said = comity("explain", "greeting_gesture", "german_host", "--set", "touch_consent=unknown")
    assert re.search(r"handshake +out +rule 16 \(1.000\) +requires touch consent is given", said.out)
    assert re.search(r"touch consent not disclosed → given +gives handshake instead of wave", said.out)


def test_a_tie_is_named_and_the_neutral_category_marked(comity):
    said = comity("explain", "greeting_gesture", "--set", "individualism=67", "--set", "formality=formal")
    assert "wave, bow, palms together are equally desirable; nod, the neutral value, stands" in " ".join(
        said.out.split()
    )
    assert re.search(r"nod +1.000 +rule 19 \(0.016\) +neutral: stands where others tie", said.out)


def test_flat_is_said_in_words(comity):
    assert re.search(r"age 82 years +flat here", comity("explain", "approach_speed", "british_elder").out)


def test_a_parameter_that_is_read_is_named(comity):
    said = comity("explain", "greeting_modality", "japanese_woman")
    assert re.search(r"greeting gesture +bow +culture", said.out)


@pytest.mark.parametrize("words", CASES, ids=" ".join)
def test_the_picture_is_a_png_of_1200_pixels(comity, here, words):
    said = comity("explain", *words, "--picture", "why.png")
    assert said.code == 0
    assert "why.png" in said.out
    data = (here / "why.png").read_bytes()
    assert data.startswith(b"\x89PNG")
    assert struct.unpack(">I", data[16:20]) == (1200,)


def test_the_picture_is_the_same_to_the_byte_in_another_process(here):
    for seed in ("1", "2"):
        subprocess.run(
            [
                sys.executable,
                "-m",
                "comity",
                "explain",
                "approach_speed",
                "german_woman",
                "--picture",
                f"{seed}.png",
            ],
            cwd=here,
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        )
    assert (here / "1.png").read_bytes() == (here / "2.png").read_bytes()


def test_a_picture_replaces_a_picture_and_nothing_else(comity, here):
    words = ("explain", "conversational_distance", "german_woman", "--picture")
    (here / "notes.png").write_text("my thesis")
    for target in ("notes.png", ".", "nowhere/why.png"):
        said = comity(*words, target)
        assert (said.code, said.out) == (2, "")
        assert target in said.err
    assert (here / "notes.png").read_text() == "my thesis"
    assert comity(*words, "why.png").code == 0
    assert comity(*words, "why.png").code == 0


def test_json_with_a_picture_is_still_one_object(comity, here):
    said = comity("explain", "conversational_distance", "german_woman", "--picture", "why.png", "--json")
    assert said.json["parameter"] == "conversational_distance"
    assert (here / "why.png").exists()


@pytest.mark.parametrize(
    "words",
    [
        ["conversational_distance", "german_woman", "--set", "individualism=40..60"],
        ["greeting_modality", "japanese_woman", "--set", "individualism=40..60"],
    ],
    ids=" ".join,
)
def test_a_fact_known_roughly_is_drawn(comity, here, words):
    said = comity("explain", *words, "--picture", "why.png")
    assert (said.code, said.err) == (0, "")
    assert (here / "why.png").read_bytes() != b""


@pytest.mark.parametrize("fact", [Trapezoid(20, 30, 40, 50), Interval(40, 60), {"female": 0.4, "male": 1}])
def test_any_rough_fact_is_drawn(here, fact):
    name = "gender" if isinstance(fact, dict) else "individualism"
    rulebook = load_rulebook("bruno2017-case2")
    write_explanation(explain(rulebook, {name: fact}, "conversational_distance"), here / "why.png")
    assert (here / "why.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("name", ["why.gif", "why.jpg"])
def test_a_picture_in_another_form_by_its_name_is_refused(comity, here, name):
    said = comity("explain", "conversational_distance", "german_woman", "--picture", name)
    assert (said.code, said.out) == (2, "")
    assert ".png, .svg or .pdf" in said.err
    assert not list(here.iterdir())


@pytest.mark.parametrize(("form", "start"), [("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_the_picture_is_in_vectors_where_its_name_says_so_the_same_each_time(comity, here, form, start):
    words = ("explain", "conversational_distance", "german_woman", "--picture")
    for name in ("one", "two", "two"):
        assert comity(*words, f"{name}.{form}").code == 0
    content = (here / f"one.{form}").read_bytes()
    assert content.startswith(start)
    assert content == (here / f"two.{form}").read_bytes()
    if form == "svg":
        assert ">conversational distance: 0.847 m</text>" in content.decode()


@given(st.text(alphabet="ab cd", min_size=1, max_size=400), st.floats(0.5, 10), st.integers(1, 3))
def test_a_long_text_is_folded_and_keeps_its_end(text, width, lines):
    text = " ".join(text.split()) or "x"
    folded_text = folded(text, width, 10.5, lines)
    assert len(folded_text) <= lines
    assert folded_text[-1].endswith(text[-1])
    assert max(map(len, folded_text)) <= max(int(width * 72 / (10.5 * LETTER * 0.93)), 8)


def test_text_and_picture_list_rules_in_one_order():
    explanation = explain(load_rulebook("bruno2017"), {"individualism": 67.0}, "approach_speed")
    assert [account.rule.number for account in ordered_rules(explanation)] == [9, 10, 7, 8]


SUGENO = """\
[System]
Name='fan'
Type='sugeno'
NumInputs=1
NumOutputs=1
NumRules=2
AndMethod='prod'
OrMethod='probor'
ImpMethod='prod'
AggMethod='sum'
DefuzzMethod='wtaver'
[Input1]
Name='heat'
Range=[0 10]
NumMFs=2
MF1='low':'trapmf',[0 0 2 8]
MF2='high':'trapmf',[2 8 10 10]
[Output1]
Name='speed'
Range=[0 30]
NumMFs=2
MF1='slow':'constant',[6]
MF2='fast':'constant',[24]
[Rules]
1, 1 (1) : 1
2, 2 (1) : 1
"""


def test_a_sugeno_file_is_explained_and_drawn(comity, here):
    (here / "fan.fis").write_text(SUGENO)
    said = comity(
        "explain", "speed", "--rulebook", "fan.fis", "--set", "heat=4", "--picture", "why.png", "--json"
    )
    assert said.code == 0, said.err
    assert said.json["value"] == pytest.approx(12)
    assert [rule["share"] for rule in said.json["rules"]] == pytest.approx([2 / 3, 1 / 3])
    assert [rule["contribution"] for rule in said.json["rules"]] == pytest.approx([4, 8])
    assert [rule["without"]["value"] for rule in said.json["rules"]] == pytest.approx([24, 6])
    assert said.json["derivatives"][0]["derivative"] == pytest.approx(3)
    assert (here / "why.png").read_bytes().startswith(b"\x89PNG")


def test_a_fact_that_was_not_disclosed_and_outvotes_others_begins_the_reason_everywhere(comity, here):
    (here / "ada.scenario.yaml").write_text(
        "schema_version: 1\nname: ada\nplace: {width_m: 6, height_m: 4}\nrobot: {at_m: [1, 2]}\npeople:\n"
        "  ada: {profile: {name: Ada, culture: DEU}, situation: {touch_consent: given}, at_m: [4, 2]}\n"
        "goals: [{greet: ada}]\n",
        encoding="utf-8",
    )
    outvotes = "formality not disclosed outvotes individualism is LC2 → wave"
    facts = ("--set", "culture=DEU", "--set", "touch_consent=given")
    explained = comity("explain", "greeting_gesture", *facts).out.splitlines()
    assert explained[1].strip().startswith(outvotes)
    summary = comity("run", "ada.scenario.yaml", "--out", "run").out
    assert outvotes in " ".join(summary.split())
    why = comity("trace", "run", "--why", "handshake").out
    assert f"greeting_gesture handshake (culture); {outvotes}" in " ".join(why.split())
    assert outvotes in (here / "run" / "replay.html").read_text(encoding="utf-8")
