"""What the command line says of values that the situation moves, and of rules that are off."""

from __future__ import annotations

import pytest


def test_a_value_is_told_step_by_step(comity):
    said = comity("infer", "--set", "familiarity=stranger", "--rulebook", "evidence", "--json")
    distance = said.json["parameters"]["conversational_distance"]
    assert [part["origin"] for part in distance["contributions"]] == ["neutral", "situation"]
    assert sum(part["value"] for part in distance["contributions"]) == pytest.approx(distance["value"])
    assert distance["shift"]["rules"][0]["rule"].endswith("conversational_distance is farther")
    assert said.json["parameters"]["speech_rate"]["shift"] is None
    low, high = distance["curve"][0][0], distance["curve"][-1][0]
    assert low <= distance["value"] <= high


def test_an_explanation_grades_the_rules_that_moved_it_and_names_those_that_are_off(comity):
    words = (
        "conversational_distance",
        "german_woman",
        "--set",
        "familiarity=close",
        "--rulebook",
        "evidence",
    )
    answer = comity("explain", *words, "--json").json
    (rule,) = answer["shift"]["rules"]
    assert (rule["evidence"], rule["strength"]) == ("strong", 1.0)
    assert "Hall" in rule["source"]
    assert [off["evidence"] for off in answer["off"]] == ["contested"] * 6
    text = comity("explain", *words).out
    assert "What the situation adds: -0.192 m" in text
    assert "Rules that are off" in text


def test_the_list_of_rulebooks_counts_rules_by_grade(comity):
    books = {book["name"]: book for book in comity("rulebooks", "--json").json["rulebooks"]}
    evidence = books["evidence"]
    assert (evidence["rules"], evidence["off"]) == (44, 28)
    assert evidence["evidence"]["contested"] == 7
    assert books["bruno2017"]["off"] == 0
    assert "44 rules, 28 of them off" in " ".join(comity("rulebooks").out.split())


def test_a_moved_value_can_be_drawn(comity, here):
    words = (
        "conversational_distance",
        "german_woman",
        "--set",
        "familiarity=close",
        "--rulebook",
        "evidence",
    )
    said = comity("explain", *words, "--picture", "why.png")
    assert said.code == 0, said.err
    assert (here / "why.png").read_bytes().startswith(b"\x89PNG")
