"""Who is deleted is searched for: every run and table that holds them is named, with where was searched."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.answers.run import RunAnswer
from comity.output.holding import search
from comity.output.run_folder import RUN, RunFolder
from comity.people.store import Store

pytestmark = pytest.mark.usefixtures("home")
ACCOUNT = RunAnswer(
    status="done",
    outcome="success",
    scenario="two-visits",
    rulebook="evidence",
    profiles={},
    seed=0,
    episode="",
    reproduce="",
    trace_sha256=None,
    fingerprint="",
    simulated_s=1.0,
    visits=(),
    metrics={},
    files=(),
)
who = st.sampled_from(["amal", "amalia", "berta", "ama", "Ünal"])
places = st.lists(st.sampled_from("abc"), max_size=3).map("/".join)


def a_run(path, **profiles):
    path.mkdir(parents=True)
    folder = RunFolder(path)
    folder.write(RUN, replace(ACCOUNT, profiles=profiles))
    return path


@given(
    st.lists(st.tuples(places, st.dictionaries(who, who, max_size=2)), max_size=6),
    st.lists(st.tuples(places, who)),
)
def test_every_run_and_table_that_holds_a_person_is_found_and_no_other(runs, tables):
    with TemporaryDirectory() as top:
        folder, holds = Path(top), set()
        for i, (place, profiles) in enumerate(runs):
            path = a_run(folder / place / f"run-{i}", **profiles)
            if "amal" in {*profiles, *profiles.values()}:
                holds.add(path)
        for i, (place, name) in enumerate(tables):
            path = folder / place / f"table-{i}.csv"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"participant,distance_m\n{name},0.8\n", encoding="utf-8")
            if name == "amal":
                holds.add(path)
        (searched,) = search([folder], ["amal"])
        assert {one.path for one in searched.found} == holds
        assert (searched.runs, searched.files) == (len(runs), len(tables))
        assert searched.unread == ()


def test_deleting_names_where_it_searched_and_what_holds_the_person(comity, here, home):
    comity("profile", "set", "amal", "culture=SWE")
    assert comity("run", "two-visits", "--as", "guest=amal", "--no-pictures").code == 0
    assert comity("run", "johanna", "--no-pictures").code == 0
    (here / "study").mkdir()
    (here / "study" / "table.csv").write_text("person,distance\nberta,0.7\namal,0.8\n")
    said = comity("profile", "delete", "amal", "--in", "runs", "--in", "study", "--yes")
    assert said.code == 0
    told = " ".join(said.out.split())
    assert "Searched runs: 2 runs, 0 other files" in told
    assert "runs/two-visits-1 holds amal as the profile of guest" in told
    assert "Searched study: 0 runs, 1 other file" in told
    assert "study/table.csv holds amal in line 3" in told
    assert "johanna-1" not in told
    assert not Store().keeps("amal")
    assert (here / "runs" / "two-visits-1" / "run.json").exists()


def test_runs_are_deleted_where_that_is_asked_for_and_tables_never(comity, here):
    comity("profile", "set", "amal", "culture=SWE")
    assert comity("run", "two-visits", "--as", "guest=amal", "--no-pictures").code == 0
    assert comity("run", "johanna", "--no-pictures").code == 0
    (here / "runs" / "table.csv").write_text("amal\n")
    assert comity("profile", "delete", "amal", "--with-runs", "--yes").code == 0
    assert not (here / "runs" / "two-visits-1").exists()
    assert (here / "runs" / "johanna-1" / "run.json").exists()
    assert (here / "runs" / "table.csv").exists()


def test_runs_of_somebody_who_is_forgotten_already_are_found(comity, here):
    comity("profile", "set", "amal", "culture=SWE")
    assert comity("run", "--as", "johanna=amal", "--no-pictures").code == 0
    assert comity("profile", "consent", "amal", "--withdraw").code == 0
    assert comity("profile", "delete", "amal", "--with-runs", "--yes").code == 0
    assert not (here / "runs" / "johanna-1").exists()
    assert comity("profile", "delete", "amal", "--yes").code == 2


def test_a_folder_that_there_is_not_deletes_nothing(comity, here):
    comity("profile", "set", "amal", "age=71")
    assert comity("profile", "delete", "amal", "--in", "nowhere", "--yes").code == 2
    assert Store().keeps("amal")
    said = comity("profile", "delete", "amal", "--yes")
    assert said.code == 0
    assert "Searched no folder" in said.out


def test_what_cannot_be_read_is_named(comity, here):
    comity("profile", "set", "amal", "age=71")
    a_run(here / "runs" / "old", guest="amal").joinpath(RUN).write_text('{"trace_sha256": null}')
    said = comity("profile", "delete", "amal", "--yes")
    assert said.code == 0
    assert "runs/old was not read (damaged" in said.out


@given(st.text(max_size=50).filter(lambda text: "\0" not in text), st.booleans(), st.booleans())
def test_what_a_table_says_is_found_in_every_encoding_or_it_is_named_as_not_read(text, wide, holds):
    said = f"{text} amal {text}" if holds else text.replace("amal", "")
    with TemporaryDirectory() as folder:
        Path(folder, "table.csv").write_bytes(said.encode("utf-16" if wide else "utf-8", "surrogatepass"))
        (one,) = search([Path(folder)], {"amal"})
    assert (one.files, len(one.unread)) == (1, 0)
    assert bool(one.found) == holds


def test_what_is_no_text_is_named_as_not_read_and_not_counted(comity, here):
    """An archive, text of another encoding, UTF-16 without its mark, and a link; no ending hides a text."""
    comity("profile", "set", "amal", "age=71")
    (here / "in").mkdir()
    with zipfile.ZipFile(here / "in" / "a.zip", "w") as archive:
        archive.writestr("table.csv", "name\namal\n")
    (here / "in" / "b.csv").write_bytes("Jörg\namal\n".encode("latin-1"))
    (here / "in" / "c.csv").write_bytes("amal\n".encode("utf-16-le"))
    (here / "in" / "d.log").write_text("amal\n")
    (here / "in" / "e.csv").symlink_to(here / "in" / "d.log")
    (one,) = search([here / "in"], {"amal"})
    assert one.files == 1
    assert [found.path.name for found in one.found] == ["d.log"]
    assert [unread.path.name for unread in one.unread] == ["a.zip", "b.csv", "c.csv", "e.csv"]
    said = comity("profile", "delete", "amal", "--in", "in", "--yes").out
    assert "a.zip was not read (no text that can be read): unpack or convert it" in said
    assert "1 other file" in said


def test_a_run_with_pseudonyms_is_not_found(comity, here):
    comity("profile", "set", "amal", "culture=SWE")
    assert comity("run", "--as", "johanna=amal", "--pseudonyms", "--no-pictures").code == 0
    said = comity("profile", "delete", "amal", "--yes")
    assert "holds amal" not in said.out
    assert "runs with pseudonyms, which hold no name, cannot be found" in " ".join(said.out.split())
