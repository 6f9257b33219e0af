"""A run keeps the tables of scores that its rulebook names: its folder can be moved."""

from __future__ import annotations

import json
import shutil

from comity_fis import read_rulebook

POWER_DISTANCE = """variables:
  power_distance:
    kind: culture
    level: interval
    range: [0, 120]
    derived_from: {fact: culture, table: ../data/pdi.csv}
    terms: {high: {trapezoid: [0, 100, 120, 120]}}
    shapes: design
    reason: An example.
"""
RULE = """rules:
  - rule: if power_distance is high then conversational_distance is far
    sources: [design]
    evidence: design
"""
SCENARIO = """schema_version: 1
name: lab
rulebook: books/book.yaml
place: {width_m: 6, height_m: 5}
robot: {at_m: [1, 2.5]}
people: {ada: {at_m: [4, 2.5], facing_deg: 180, profile: {name: Ada, culture: Kazakhstan}}}
goals: [{greet: ada}]
"""


def project(folder):
    """A scenario whose rulebook, in a folder of its own, names a table in another one."""
    (folder / "books").mkdir(parents=True)
    (folder / "data").mkdir()
    shipped = read_rulebook("bruno2017").text
    shipped = shipped.replace("variables:\n", POWER_DISTANCE, 1).replace("rules:\n", RULE, 1)
    (folder / "books" / "book.yaml").write_text(shipped, encoding="utf-8")
    (folder / "data" / "pdi.csv").write_text("# Made up.\ncountry,pdi\nKAZ,88\n", encoding="utf-8")
    (folder / "lab.scenario.yaml").write_text(SCENARIO, encoding="utf-8")


def test_a_moved_run_is_traced_replayed_and_run_again_without_the_first_table(comity, here):
    project(here / "project")
    first = comity("run", "project/lab.scenario.yaml", "--out", "run", "--json").json
    assert "scores/pdi.csv" in first["files"]
    table = (here / "project" / "data" / "pdi.csv").read_text()
    assert (here / "run" / "scores" / "pdi.csv").read_text() == table
    why = comity("trace", "run", "--why", "Dock_to_user(ada)").out
    shutil.rmtree(here / "project")
    (here / "elsewhere").mkdir()
    shutil.move(here / "run", here / "elsewhere" / "moved")
    assert "the score of Kazakhstan is 88: pdi.csv, column pdi, line 3" in " ".join(why.split())
    assert comity("trace", "elsewhere/moved", "--why", "Dock_to_user(ada)").out == why
    assert comity("replay", "elsewhere/moved", "--out", "page.html").code == 0
    again = comity("run", "elsewhere/moved/scenario.yaml", "--out", "again", "--json").json
    assert again["trace_sha256"] == first["trace_sha256"]
    assert (here / "again" / "scenario.yaml").read_text() == (
        here / "elsewhere" / "moved" / "scenario.yaml"
    ).read_text()


def test_a_run_in_the_same_folder_takes_the_tables_of_the_one_before_away(comity, here):
    project(here / "project")
    comity("run", "project/lab.scenario.yaml", "--out", "run")
    comity("run", "--out", "run")
    assert not (here / "run" / "scores").exists()
    assert not any(
        name.startswith("scores/") for name in json.loads((here / "run/run.json").read_text())["files"]
    )
