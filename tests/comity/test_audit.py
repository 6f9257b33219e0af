"""`comity audit`: every shipped rulebook and a user's own, as text and as JSON."""

from __future__ import annotations

from pathlib import Path

import jsonschema
import pytest

from comity_fis import read_rulebook, shipped_rulebooks

TIPPING = Path(__file__).parents[1] / "fis" / "data" / "tipping.fis"
CURVES = Path(__file__).parents[1] / "fis" / "data" / "curves.fis"


@pytest.mark.parametrize("rulebook", [*shipped_rulebooks(), str(TIPPING)])
def test_every_audit_keeps_to_its_schema_and_can_be_read(comity, rulebook):
    schema = comity("schema", "audit").json
    jsonschema.Draft202012Validator.check_schema(schema)
    answer = comity("audit", rulebook, "--json")
    assert answer.code == 0, answer.err
    jsonschema.validate(answer.json, schema)
    said = comity("audit", rulebook)
    assert (said.code, said.err) == (0, "")
    for title in ("Rules by evidence", "Whom it covers", "Rules that contradict", "Ordinal findings"):
        assert title in said.out


def test_curves_without_a_closed_form_are_audited_from_samples(comity):
    answer = comity("audit", str(CURVES), "--json").json
    assert {one["parameter"] for one in answer["effects"]} == {"u", "v"}
    assert all(one["largest"] > 0 for one in answer["effects"])


def test_without_a_name_the_rulebook_of_comity_run_is_audited(comity):
    assert comity("audit").out == comity("audit", "bruno2017").out


def test_the_text_says_what_the_numbers_say(comity):
    answer, text = comity("audit", "bruno2017", "--json").json, comity("audit", "bruno2017").out
    counts = answer["findings"]["counts"]
    assert f"{counts['agreeing']} agree, {counts['contradicting']} contradict" in text
    coverage = answer["coverage"]
    assert f"{coverage['cultures']} of the {coverage['scored']} rows" in text
    (pair,) = [
        one
        for one in answer["pairs"]
        if (one["parameter"], one["attribute"]) == ("conversational_distance", "gender")
    ]
    assert f"{100 * pair['largest']:.1f} cm" in text
    assert f"{len(answer['conflicts'])}" == str(
        text.split("Rules that contradict each other")[1].split("Both hold")[0].count(" of ")
    )


def test_a_rulebook_without_culture_and_gender_treats_everybody_alike(comity):
    said = comity("audit", str(TIPPING))
    assert "they are treated alike" in said.out
    assert comity("audit", str(TIPPING), "--json").json["pairs"] == []


def test_a_rule_turned_round_is_found_against_the_findings(comity, here):
    """With the paper's rule for low individualism turned round, Germans and Arabs come out the wrong way."""
    text = read_rulebook("bruno2017-case1").text
    lines = [line for line in text.splitlines() if "rule: if individualism" in line]
    assert len(lines) == 2
    turned = text.replace("distance is close", "distance is x").replace(
        "distance is far", "distance is close"
    )
    (here / "turned.yaml").write_text(turned.replace("distance is x", "distance is far"))
    findings = comity("audit", "turned.yaml", "--json").json["findings"]
    (eresha,) = [row for row in findings["rows"] if row["finding"]["key"] == "eresha2013"]
    assert eresha["verdict"] == "contradicting"
    assert eresha["rules"] == [1, 2]
    straight = comity("audit", "bruno2017-case1", "--json").json["findings"]["counts"]
    assert findings["counts"]["agreeing"] < straight["agreeing"]
    assert findings["counts"]["equal"] == straight["equal"]


@pytest.mark.parametrize(
    ("rulebook", "words"),
    [("bruno2071", ["Did you mean 'bruno2017'?"]), ("none.yaml", ["none.yaml"]), (".", ["expected"])],
)
def test_a_rulebook_that_is_none_is_refused(comity, rulebook, words):
    said = comity("audit", rulebook)
    assert (said.code, said.out) == (2, "")
    assert all(word in said.err for word in words)
