"""What a run shows: a page and a picture, a GIF for those who ask, and each of them later from the folder."""

from __future__ import annotations

import json
from shutil import copytree

import pytest
from PIL import Image
from saved import saved

from comity.answers.run import RunAnswer
from comity.output.run_folder import RunFolder
from comity.preparation import prepare
from comity.recording import record
from comity.replay.pictures import draw_run, rings_of
from comity.replay.saved_run import read_run
from comity.scenario import load_scenario
from comity_fis.record import plain

EITHER = {"replay.html", "picture.png", "episode.gif"}
GAP = """\
schema_version: 1
name: gap
place:
  width_m: 10
  height_m: 6
  walls_m: [[[5, 0], [5, 2.2]], [[5, 3.8], [5, 6]]]
robot: {at_m: [1, 3]}
people:
  johanna: {at_m: [8, 3], facing_deg: 180}
  marta: {at_m: [6, 5], facing_deg: 180}
goals: [{greet: johanna}]
changes:
  - {at_s: 0.5, person: marta, moves_to_m: [5, 3], speed_m_s: 1.5}
  - {at_s: 12, person: marta, moves_to_m: [6, 5]}
"""
GIF_AT_LEAST = 50
"""Images of an episode of twelve seconds."""


@pytest.fixture(scope="module")
def visit(tmp_path_factory):
    """A run without anything to look at."""
    out = tmp_path_factory.mktemp("runs") / "visit"
    return record(prepare(load_scenario("johanna")), out=out, views=()).folder


@pytest.mark.parametrize(
    ("words", "shown"),
    [
        ((), {"replay.html", "picture.png"}),
        (("--no-pictures",), {"replay.html"}),
        (("--no-pictures", "--gif"), {"replay.html", "episode.gif"}),
    ],
    ids=["usual", "no pictures", "a GIF alone"],
)
def test_a_run_shows_what_was_asked_for_and_names_it(words, shown, comity, here):
    said = comity("run", "johanna", "--out", "visit", *words)
    written = {path.name for path in (here / "visit").iterdir()}
    assert written & EITHER == shown
    assert set(json.loads((here / "visit" / "run.json").read_text())["files"]) == written
    assert {name for name in EITHER if f"visit/{name}\n" in said.out} == shown


def test_a_gif_of_a_run_can_be_made_later_and_again(comity, here, visit):
    copytree(visit.path, here / "visit")
    assert comity("replay", "visit", "--gif", "visit.gif").out == "GIF  visit.gif\n"
    with Image.open(here / "visit.gif") as film:
        assert film.n_frames > GIF_AT_LEAST
    assert not (here / "visit" / "replay.html").exists()
    assert comity("replay", "visit", "--gif", "visit.gif").code == 0


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--gif", "visit.mp4"), "visit.gif"),
        (("--gif", "mine.gif"), "did not write"),
        (("--gif", "nowhere/visit.gif"), "no such folder"),
        (("--gif", "visit.gif", "--out", "page.html"), "--out"),
        (("visit", "--gif", "visit.gif"), "a second run"),
    ],
    ids=str,
)
def test_a_gif_that_cannot_be_written_is_refused_before_it_is_drawn(words, told, comity, here, visit):
    copytree(visit.path, here / "visit")
    (here / "mine.gif").write_bytes(b"GIF89a of my own")
    before = sorted(here.rglob("*"))
    said = comity("replay", "visit", *words)
    assert (said.code, said.out) == (2, "")
    assert told in said.err
    assert sorted(here.rglob("*")) == before


def test_a_gif_of_the_run_itself_takes_the_place_of_an_older_one(comity, here, visit):
    """One that bears no mark of ours is ours by its place."""
    copytree(visit.path, here / "visit")
    (here / "visit" / "episode.gif").write_bytes(b"GIF89a as an earlier version wrote it")
    assert comity("replay", "visit", "--gif", "visit/episode.gif").code == 0
    assert (here / "visit" / "episode.gif").stat().st_size > 10_000


def test_everything_that_was_said_and_done_is_in_the_account_in_its_order(here):
    """Also what was said to people whom the robot does not visit."""
    (here / "gap.scenario.yaml").write_text(GAP)
    run = saved("gap.scenario.yaml", here / "run")
    starts = [act.start_s for act in run.account.acts]
    assert starts == sorted(starts)
    assert [act.person for act in run.account.acts if act.act == "ask_to_pass"] == ["marta"]
    of_visits = [plain(act) for visit in run.account.visits for act in visit.acts]
    everything = [
        {key: fact for key, fact in plain(act).items() if key != "person"} for act in run.account.acts
    ]
    assert all(act in everything for act in of_visits)


def test_a_run_of_a_version_that_listed_no_acts_is_drawn_with_those_of_its_visits(here, visit):
    """The picture of a visit without bystanders is the same."""
    copytree(visit.path, here / "old")
    account = json.loads((here / "old" / "run.json").read_text())
    account.pop("acts")
    (here / "old" / "run.json").write_text(json.dumps(account))
    draw_run(read_run(visit), here / "new.png")
    draw_run(read_run(RunFolder(here / "old")), here / "old.png")
    assert (here / "old.png").read_bytes() == (here / "new.png").read_bytes()


def test_a_picture_shows_what_the_account_says_of_each_visit(visit):
    run = read_run(visit)
    (ring,), (told,) = rings_of(run), visit.read("run.json", RunAnswer).visits
    assert (ring.person, ring.reached_m) == ("johanna", told.distance_reached_m)
    assert ring.time_s == told.docked_at_s
    assert ring.wanted_m == pytest.approx(told.distance_wanted_m)


@pytest.mark.parametrize(("form", "start"), [("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_the_picture_of_a_run_is_drawn_later_by_the_ending_of_its_name(
    form, start, visit, comity, here
) -> None:
    target = here / f"later.{form}"
    for _ in range(2):
        assert comity("replay", str(visit.path), "--picture", target.name).code == 0
    assert target.read_bytes().startswith(start)
    target.write_bytes(b"by hand")
    assert comity("replay", str(visit.path), "--picture", target.name).code == 2
    assert comity("replay", str(visit.path), "--picture", "a.png", "--out", "b.html").code == 2


def test_a_run_draws_its_picture_in_vectors_and_refuses_another_form_before_it_runs(comity, here) -> None:
    told = comity("run", "johanna", "--out", "visit", "--no-pictures", "--picture", "one.svg")
    assert told.code == 0
    assert [line.split()[1] for line in told.out.splitlines() if line.startswith("Picture")] == ["one.svg"]
    assert ">johanna<" in (here / "one.svg").read_text()
    said = comity("run", "johanna", "--out", "other", "--picture", "one.gif")
    assert said.code == 2
    assert not (here / "other").exists()
