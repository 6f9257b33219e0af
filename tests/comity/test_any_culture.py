"""Any country and any self-named culture, scored or not, in profiles, rules and tables, as it is named."""

from __future__ import annotations

import pickle
from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.parameters.values import infer_for
from comity.people.profile import Declared, Profile
from comity_fis import countries, find_score, load_rulebook
from comity_fis.audit.attributes import attributes
from comity_fis.audit.coverage import coverage
from comity_fis.validation.yaml_file import parse_yaml

TEXT = files("comity_fis").joinpath("rulebooks", "bruno2017.yaml").read_text(encoding="utf-8")
BOOK = load_rulebook("bruno2017")
SELF_NAMED = ["Kurdish", "Roma", "Catalan", "Sami", "Kurdistan", "Māori", "Ewe", "Arab"]
names = st.sampled_from([*SELF_NAMED, *(word for one in countries() for word in one.spellings)])


def of(**facts):
    return Declared(Profile.model_validate({"name": "somebody", **facts}), None)


def book_with(condition):
    """The paper's rulebook with one rule more."""
    return read(with_rule(TEXT, condition))


def read(text):
    return load_rulebook(parse_yaml(text, Path("book.yaml"), "book.yaml"))


def with_rule(text, condition):
    more = [
        "rule: if " + condition + " then greeting_gesture is bow",
        "sources: [design]",
        "evidence: design",
    ]
    return f"{text.rstrip()}\n  - " + "\n    ".join(more) + "\n"


@given(names, names)
def test_a_rule_that_names_a_culture_fires_for_it_and_for_no_other(named, said):
    """Whether rule and person call it by code or by name."""
    book = book_with(f"culture is '{named}'" if "'" not in named else f'culture is "{named}"')
    fired = infer_for(of(culture=said), book)["greeting_gesture"].fired
    same = load_rulebook("bruno2017").variables["culture"].check
    assert (len(book.rules) in {one.rule.number for one in fired}) == (same(named) == same(said))


@given(names)
def test_every_culture_is_accepted_as_said_through_every_door(name):
    alone = infer_for(of(culture=name), BOOK)
    scored = find_score(name) is not None
    assert alone.inputs["culture"] == BOOK.variables["culture"].check(name)
    assert (alone.inputs["individualism"] is not None) == scored
    assert bool([note for note in alone.notes if "has no score" in note]) != scored
    told = infer_for(of(), BOOK, situation={"culture": name})
    assert told.parameters == alone.parameters == BOOK.infer({"culture": name}).parameters
    many = BOOK.infer_many({"culture": [name, "DEU", None]})
    for parameter, value in alone.parameters.items():
        expected = value.value if isinstance(value.value, str) else pytest.approx(value.value, abs=1e-12)
        assert many[parameter][0] == expected


@pytest.mark.parametrize("words", ["Kurdistan", "Kurdish", "Roma", "Sami", "Irann"])
def test_no_people_is_proposed_in_the_place_of_another(comity, words):
    said = comity("infer", "--set", f"culture={words}")
    assert said.code == 0
    assert "Did you mean" not in said.out + said.err
    assert "has no score" in " ".join(said.out.split())
    assert "Arab countries, East Africa, West Africa" in " ".join(said.out.split())


@pytest.mark.parametrize("code", ["JPM", "EGI", "XX"])
@pytest.mark.parametrize("door", ["rule", "profile", "--set"])
def test_a_code_that_no_country_has_is_refused_without_a_guess(comity, here, code, door):
    (here / "x.yaml").write_text(f"name: x\nculture: {code}\n")
    (here / "book.yaml").write_text(with_rule(TEXT, f"culture is {code}"))
    words = {
        "rule": ["--rulebook", "book.yaml"],
        "profile": ["x.yaml"],
        "--set": ["--set", f"culture={code}"],
    }
    said = comity("infer", *words[door])
    assert said.code == 2
    assert repr(code) in said.err
    assert "Did you mean" not in said.err


def test_an_audit_sees_the_cultures_that_rules_name():
    book = book_with("culture is Rwanda or culture is Kurdish")
    known = attributes(book)
    assert {"RWA", "Kurdish"} <= set(known["culture"].labels)
    assert {"RWA", "Kurdish"} <= set(coverage(book, known).named)


def test_a_group_may_hold_cultures_without_a_score():
    text = TEXT.replace(
        "    categories_from: individualism\n",
        "    categories_from: individualism\n    groups: {hosts: [RWA, Kurdish, DEU]}\n",
        1,
    )
    assert text != TEXT
    book = read(with_rule(text, "culture is hosts"))
    for name, member in {"Rwanda": True, "kurdish": True, "Germany": True, "SWE": False}.items():
        fired = infer_for(of(culture=name), book)["greeting_gesture"].fired
        assert (len(book.rules) in {one.rule.number for one in fired}) == member


def test_a_rulebook_of_any_culture_can_be_pickled():
    book = book_with("culture is Rwanda")
    again = pickle.loads(pickle.dumps(book))
    assert again.infer({"culture": "RWA"}).parameters == book.infer({"culture": "RWA"}).parameters


def test_a_table_of_scores_may_have_a_people_as_a_row(tmp_path):
    from comity_fis import read_scores

    (tmp_path / "x.csv").write_text("country,score\nDEU,67\nKurdish,40\n", encoding="utf-8")
    table = read_scores(tmp_path / "x.csv")
    kurdish = table.find("kurdish")
    assert kurdish is not None
    assert kurdish.value == 40.0
    assert table.find("Roma") is None


def test_rows_of_a_culture_without_a_score_are_evaluated_and_counted(comity, here):
    (here / "t.csv").write_text(
        "study,culture,parameter,value,unit\ns,EGY,conversational_distance,80,cm\n"
        "s,Kurdish,conversational_distance,70,cm\ns,DEU,conversational_distance,90,cm\n"
    )
    said = comity("evaluate", "bruno2017", "t.csv", "--json").json
    assert (said["rows"], said["rows_without_score"]) == (3, 2)
    rows = said["numbers"]["conversational_distance"]["rows"]
    alone = infer_for(of(culture="EGY"), BOOK)["conversational_distance"]
    assert [row["predicted"] for row in rows[:2]] == [alone.value, alone.value]
    text = comity("evaluate", "bruno2017", "t.csv").out
    assert "2 rows of a culture without a score: EGY, Kurdish." in " ".join(text.split())
