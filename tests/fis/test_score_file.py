"""A table of scores from any CSV file: what is read, what is refused, and one answer by every door."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front
from comity.parameters.cast import cast_of
from comity.scenario import load_scenario
from comity_fis import (
    InputError,
    countries,
    explain,
    individualism,
    load_rulebook,
    read_rulebook,
    read_scores,
)

DISTANCE = "conversational_distance"
SHIPPED = read_rulebook("bruno2017").text
DERIVED = """  power_distance:
    kind: culture
    level: interval
    range: [-200, 200]
    derived_from: {fact: culture, table: pdi.csv}
    terms: {low: {trapezoid: [-200, -200, 0, 100]}, high: {trapezoid: [0, 100, 200, 200]}}
    shapes: design
    reason: An example.
"""
RULES = """rules:
  - rule: if power_distance is high then conversational_distance is far
    sources: [design]
    evidence: design
  - rule: if power_distance is low then conversational_distance is close
    sources: [design]
    evidence: design
"""


def rulebook_beside(folder: Path, table: str | None = None, derived: str = DERIVED) -> Path:
    """The shipped rulebook and two rules over a score from `pdi.csv`, which is written beside it."""
    if table is not None:
        (folder / "pdi.csv").write_text(table, encoding="utf-8")
    text = SHIPPED.replace("variables:\n", f"variables:\n{derived}", 1).replace("rules:\n", RULES, 1)
    path = folder / "book.yaml"
    path.write_text(text, encoding="utf-8")
    return path


@st.composite
def tables(draw: st.DrawFn) -> tuple[str, dict[str, float]]:
    """A CSV file, and the score of each culture by the name that a person gives it."""
    rows = draw(st.lists(st.sampled_from(countries()), min_size=1, max_size=6, unique=True))
    heading = draw(st.permutations([draw(st.sampled_from(["country", "Country", "KEY", "iso3"])), "pdi"]))
    told, lines = {}, [heading]
    for one in rows:
        score = draw(st.integers(-200, 200) | st.floats(-200, 200).map(lambda x: round(x, 3)))
        pair = {"pdi": repr(score)}
        lines.append([pair.get(name, draw(st.sampled_from(one.spellings))) for name in heading])
        told[draw(st.sampled_from(one.spellings))] = float(score)
    out = io.StringIO()
    csv.writer(out, delimiter=draw(st.sampled_from(",;\t"))).writerows(lines)
    return out.getvalue(), told


@settings(max_examples=25, deadline=None)
@given(tables())
def test_a_culture_gives_the_same_value_by_every_door(tmp_path_factory, table):
    text, told = table
    path = rulebook_beside(tmp_path_factory.mktemp("book"), text)
    book = load_rulebook(path)
    cultures = [*told]
    expected = [
        book.infer({"culture": name, "power_distance": told[name]})[DISTANCE].number for name in cultures
    ]
    assert [book.infer({"culture": name}).inputs["power_distance"] for name in cultures] == [*told.values()]
    assert [book.infer({"culture": name})[DISTANCE].number for name in cultures] == expected
    assert [book.value(DISTANCE, {"culture": name}) for name in cultures] == expected
    assert [explain(book, {"culture": name}, DISTANCE).value.number for name in cultures] == expected
    assert book.infer_many({"culture": cultures})[DISTANCE].tolist() == pytest.approx(expected, abs=1e-12)
    assert [front.infer(culture=name, rulebook=str(path))[DISTANCE].number for name in cultures] == expected
    for name, value in zip(cultures, expected, strict=True):
        people = cast_of(
            load_scenario("johanna"), profiles={"johanna": {"culture": name}}, rulebook=str(path)
        )
        assert people.values()["johanna"][DISTANCE].number == value


def test_a_country_that_only_one_table_knows_has_that_score(tmp_path):
    book = load_rulebook(rulebook_beside(tmp_path, "country,pdi\nKazakhstan,88\n"))
    inference = book.infer({"culture": "Kazakhstan"})
    assert inference.inputs["power_distance"] == 88.0
    assert (inference.inputs["individualism"], inference.inputs["culture"]) == (None, "KAZ")
    assert all("individualism" in note for note in inference.notes)
    assert len(inference.notes) == 1
    assert "pdi.csv, column pdi, line 2" in inference.sources["power_distance"]


def test_the_shipped_table_is_one_of_these(tmp_path):
    rows = "".join(f"{row.key},{row.kind},{row.value:g}\n" for row in individualism().rows)
    (tmp_path / "copy.csv").write_text(f"country,kind,score\n{rows}", encoding="utf-8")
    copy = read_scores(tmp_path / "copy.csv")
    assert [(row.key, row.kind, row.value) for row in copy.rows] == [
        (row.key, row.kind, row.value) for row in individualism().rows
    ]
    assert copy.regions == individualism().regions


def test_a_table_that_was_changed_is_read_again(tmp_path):
    path = rulebook_beside(tmp_path, "country,pdi\nDEU,10\n")
    assert load_rulebook(path).infer({"culture": "DEU"}).inputs["power_distance"] == 10.0
    (tmp_path / "pdi.csv").write_text("country,pdi\nDEU,20\n", encoding="utf-8")
    assert load_rulebook(path).infer({"culture": "DEU"}).inputs["power_distance"] == 20.0


def test_the_path_is_relative_to_the_rulebook_wherever_the_command_runs(tmp_path, monkeypatch):
    (tmp_path / "books").mkdir()
    path = rulebook_beside(tmp_path / "books", None, DERIVED.replace("pdi.csv", "../data/pdi"))
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "pdi.csv").write_text("iso3;name;pdi\nDEU;Deutschland;35,5\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path.parent)
    inference = load_rulebook(path).infer({"culture": "DEU"})
    assert inference.inputs["power_distance"] == 35.5
    assert "Deutschland" in inference.sources["power_distance"]


REFUSED = {
    "no file": (None, DERIVED, r"book\.yaml:\d+: .*'pdi.csv'.*no such file"),
    "nothing in it": ("", DERIVED, r"pdi\.csv:1: .*line of headings"),
    "no country": ("land,pdi\nDEU,3\n", DERIVED, r"pdi\.csv:1: .*column `country`"),
    "no score": ("country\nDEU\n", DERIVED, r"pdi\.csv:1: .*column of scores"),
    "several scores": (
        "country,a,b\nDEU,3,4\n",
        DERIVED,
        r"pdi\.csv:1: .*called power_distance.*`column: a`",
    ),
    "no code": ("# x\ncountry,pdi\nJPM,3\n", DERIVED, r"pdi\.csv:3: .*'JPM'.*ISO 3166.*kind"),
    "a country twice": ("country,pdi\nDEU,3\n\nGermany,4\n", DERIVED, r"pdi\.csv:4: .*line 2"),
    "no number": ("country,pdi\nDEU,many\n", DERIVED, r"pdi\.csv:2: .*number.*'many'"),
    "not finite": ("country,pdi\nDEU,nan\n", DERIVED, r"pdi\.csv:2: .*number"),
    "out of range": ("country,pdi\nFRA,3\nDEU,201\n", DERIVED, r"pdi\.csv:3: .*-200\.\.200.*201"),
    "too many cells": ("country,pdi\nDEU,3,4\n", DERIVED, r"pdi\.csv:2: .*cells"),
    "no country's name": ("country,kind,pdi\nDEU,region,3\n", DERIVED, r"pdi\.csv:2: .*which no country has"),
    "no kind": ("country,kind,pdi\nDEU,state,3\n", DERIVED, r"pdi\.csv:2: .*region.*'state'"),
    "a cell left empty": ("country,pdi\n,3\n", DERIVED, r"pdi\.csv:2: .*empty cell"),
    "another column": (
        "country,pdi\nDEU,3\n",
        DERIVED.replace("pdi.csv}", "pdi.csv, column: pdy}"),
        r"book\.yaml:\d+: .*'pdy'.*'pdi'",
    ),
    "a column of the shipped table": (
        None,
        DERIVED.replace("pdi.csv}", "individualism, column: idv}"),
        r"book\.yaml:\d+: .*CSV file.*individualism",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_table_that_cannot_be_used_is_refused_with_its_line(tmp_path, case):
    table, derived, message = REFUSED[case]
    path = rulebook_beside(tmp_path, table, derived)
    with pytest.raises(InputError, match=message):
        load_rulebook(path)


def test_bytes_that_are_no_text_are_refused(tmp_path):
    path = rulebook_beside(tmp_path, "")
    (tmp_path / "pdi.csv").write_bytes("country,pdi\nCôte d'Ivoire,3\n".encode("latin-1"))
    with pytest.raises(InputError, match=r"pdi\.csv:2:2: .*UTF-8"):
        load_rulebook(path)
