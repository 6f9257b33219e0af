"""What a run holds of a person: only what a rule or a wish used, in files that only the user may read."""

from __future__ import annotations

import os
import pickle
import stat
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

import comity as comity_package
from comity.parameters.used import used_facts, used_of
from comity.parameters.values import infer_for
from comity.people.adulthood import is_under_age
from comity.people.profile import Declared, Profile
from comity.people.store import Store
from tests.comity.test_profiles import BOOKS, day, facts, of

FATIMA = """\
name: fatima
about: diagnosed with dementia, refugee from Syria
culture: [{name: Egypt, role: grew up, until: 2015}, {name: DEU, from: 2015}]
gender: female
birth_date: 1946-03-09
languages: [ara]
mobility: walking frame
touch_consent: withheld
settings: {conversational_distance: 0.9}
"""
only_posix = pytest.mark.skipif(os.name != "posix", reason="other systems have no such permissions")


@given(facts, day, st.sampled_from(BOOKS))
def test_what_a_rulebook_uses_of_a_profile_gives_the_same_values_on_every_day(told, when, book):
    declared = of(**told)
    used = used_of(declared, book, when)
    assert not used.profile.depends_on_date or used.profile.birth_year is not None
    assert infer_for(used, book, at=when).parameters == infer_for(declared, book, at=when).parameters


@given(facts, day, st.sampled_from(BOOKS))
def test_nothing_that_no_rule_reads_is_left_in_it(told, when, book):
    told = {**told, "about": "a note", "mobility": "walking frame", "other": {"diagnosis": "some"}}
    left = used_of(of(**told), book, when).profile.model_dump(exclude_defaults=True)
    used = used_facts(book)
    read = {"name", *used, *(("languages",) if "language" in used else ())}
    read |= {"birth_year"} if "age" in used else set()
    if is_under_age(of(**told).profile, when):
        read |= {"age", "birth_year"}  # what protects a child reads it
    assert left.keys() <= read


@pytest.mark.parametrize(("rulebook", "gender"), [("evidence", False), ("bruno2017", True)])
def test_a_run_holds_of_a_profile_only_what_a_rule_or_a_wish_used(comity, here, rulebook, gender):
    (here / "fatima.yaml").write_text(FATIMA)
    words = ["run", "--as", "johanna=fatima.yaml", "--rulebook", rulebook, "--at", "2026-11-27"]
    assert comity(*words, "--out", "one").code == 0
    for file in (here / "one").iterdir():
        content = file.read_bytes()
        assert not [
            word for word in (b"dementia", b"1946-03-09", b"grew up", b"walking frame") if word in content
        ]
    text = (here / "one" / "scenario.yaml").read_text()
    profile = text[text.index("    profile:\n") : text.index("    at_m:")]
    assert ("gender: female" in profile) == gender
    assert "conversational_distance: 0.9" in profile
    again = comity("run", "one/scenario.yaml", "--out", "two", "--json").json
    first = comity("run", "one/scenario.yaml", "--out", "three", "--json").json
    assert (here / "one" / "trace.jsonl").read_bytes() == (here / "two" / "trace.jsonl").read_bytes()
    assert again["trace_sha256"] == first["trace_sha256"]


@only_posix
def test_a_run_and_what_is_made_of_it_can_be_read_by_the_user_alone(comity, here):
    umask = os.umask(0)
    try:
        assert comity("run", "--gif").code == 0
        assert comity("replay", "runs/johanna-1", "--out", "page.html").code == 0
        assert comity("profile", "set", "kim", "age=71").code == 0
        assert comity("profile", "export", "kim", "--out", "kim.yaml").code == 0
    finally:
        os.umask(umask)
    assert modes(here / "runs", here / "runs" / "johanna-1") == {0o700}
    files = list((here / "runs" / "johanna-1").iterdir())
    assert len(files) > 8
    assert modes(*files, here / "page.html", here / "kim.yaml") == {0o600}


@only_posix
def test_pictures_and_problems_of_people_can_be_read_by_the_user_alone(comity, here):
    umask = os.umask(0)
    try:
        assert comity("profile", "set", "kim", "age=71").code == 0
        (here / "again.png").write_bytes(b"\x89PNG\r\n\x1a\nSoftware\x00Comity")
        for name in ("why.png", "again.png"):
            assert comity("explain", "conversational_distance", "kim", "--picture", name).code == 0
        assert comity("draw", "johanna", "--out", "place.png").code == 0
        assert comity("draw", "johanna", "--out", "place.svg").code == 0
        assert comity("plan", "--as", "host=kim", "two-visits", "--pddl", "problem").code == 0
    finally:
        os.umask(umask)
    assert modes(here / "problem") == {0o700}
    files = [here / name for name in ("why.png", "again.png", "place.png", "place.svg")]
    assert modes(*files, *(here / "problem").iterdir()) == {0o600}


@only_posix
@pytest.mark.parametrize("mode", [0o700, 0o755, 0o777])
def test_an_open_folder_that_was_there_stays_so_and_that_is_said(comity, here, mode):
    (here / "out").mkdir()
    (here / "out").chmod(mode)
    said = comity("run", "johanna", "--out", "out", "--no-pictures")
    assert said.code == 0
    assert modes(here / "out") == {mode}
    assert modes(*(path for path in (here / "out").iterdir() if path.is_file())) == {0o600}
    assert ("chmod 700" in " ".join((said.out + said.err).split())) == (mode != 0o700)


@only_posix
def test_a_file_that_others_could_read_is_theirs_no_longer_when_it_is_written_again(comity, here):
    assert comity("profile", "set", "kim", "age=71").code == 0
    for _ in range(2):
        assert comity("profile", "export", "kim", "--out", "kim.yaml").code == 0
        assert modes(here / "kim.yaml") == {0o600}
        (here / "kim.yaml").chmod(0o644)


NOTE = "diagnosed with dementia in 2019"


def test_the_note_about_a_person_never_leaves_the_store(comity, here, monkeypatch, tmp_path_factory):
    home = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("COMITY_HOME", str(home))
    assert comity("profile", "set", "kim", "age=71", f"about={NOTE}").code == 0
    for words in (
        ["profiles"],
        ["profiles", "--json"],
        ["profile", "show", "kim", "--json"],
        ["profile", "show", "kim", "--years", "2020..2021"],
        ["profile", "export", "kim"],
        ["profile", "export", "kim", "--json"],
        ["profile", "export", "kim", "--out", "kim.yaml"],
        ["infer", "kim", "--json"],
        ["run", "--as", "johanna=kim", "--out", "run", "--json"],
    ):
        said = comity(*words)
        assert said.code == 0
        assert "dementia" not in said.out + said.err
    assert not [file for file in here.rglob("*") if file.is_file() and b"dementia" in file.read_bytes()]
    assert b"dementia" not in pickle.dumps(comity_package.run("johanna", profiles={"johanna": "kim"}))
    assert NOTE in comity("profile", "show", "kim").out
    assert comity("profile", "set", "kim", "age=72").code == 0
    assert NOTE in (home / "people" / "kim" / "profile.yaml").read_text()


@given(st.text(st.characters(codec="utf-8", exclude_categories=["C"]), min_size=4))
def test_an_export_has_all_that_is_kept_but_the_note_and_comments(note):
    note = f"n{note}"
    with TemporaryDirectory() as home:
        store = Store(Path(home))
        kept = {"schema_version": 1, "name": "kim", "age": 71, "settings": {"approach_speed": 0.3}}
        path = store.change_profile("kim", lambda _: {**kept, "about": note})
        with path.open("a", encoding="utf-8") as file:
            file.write("# a comment of somebody\n")
        exported = store.exported("kim")
        assert yaml.safe_load(exported) == kept
        assert "a comment" not in exported
        assert exported == Store(Path(home)).exported("kim")


def test_the_facts_of_no_profile_are_all_used_by_the_paper():
    """Of three facts that a person tells, a rulebook over one culture score uses one."""
    person = Declared(Profile(name="x", culture="SWE", gender="female", age=70), None)
    paper = next(book for book in BOOKS if book.name == "bruno2017-case1")
    assert used_of(person, paper, None).profile == Profile(name="x", culture="SWE")


def modes(*paths):
    return {stat.S_IMODE(path.stat().st_mode) for path in paths}
