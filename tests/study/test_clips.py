"""Films of one visit with one parameter changed: opaque names, one speed, and what else differs."""

from __future__ import annotations

import csv
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageSequence

from comity.study.clips.confounds import confounds_of, gaze_share
from comity.study.clips.film import INSTALL, ffmpeg_program
from comity_sim2d import Frames

PROFILES = "people.visited.profile=german_woman,arab_woman"


def rows(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def clips(comity, vary=PROFILES, scenario="johanna", out="clips", more=()):
    return comity("study", "clips", scenario, "--vary", vary, "--out", out, *more)


def test_each_clip_is_the_episode_that_a_run_gives(comity, here):
    answer = clips(comity, more=["--json"]).json
    key = {row["value"]: row for row in rows(here / "clips/key.csv")}
    assert set(key) == {"german_woman", "arab_woman"}
    for value, row in key.items():
        run = comity(
            "run", "johanna", "--as", f"johanna={value}", "--no-pictures", "--out", value, "--json"
        ).json
        assert row["trace_sha256"] == run["trace_sha256"]
        assert (here / f"clips/{row['clip']}.gif").read_bytes().startswith(b"GIF8")
        assert "Comity replay" in (here / f"clips/pages/{row['clip']}.html").read_text(encoding="utf-8")
    found = {(one["person"], one["quantity"]): one for one in answer["confounds"]}
    targets = found["johanna", "distance_target_m"]
    assert targets["difference"] == pytest.approx(abs(targets["values"][0] - targets["values"][1]))
    assert ("", "episode_duration_s") in found
    assert len(rows(here / "clips/confounds.csv")) == len(answer["confounds"])


def test_names_and_films_tell_no_value(comity, here):
    said = clips(comity)
    assert said.code == 0
    names = [path.name for path in (here / "clips").rglob("*")]
    for word in ("german", "arab", "woman"):
        assert word not in said.out.splitlines()[1] + said.out.splitlines()[2]
        assert not any(word in name for name in names)
        for film in (here / "clips").glob("*.gif"):
            assert word.encode() not in film.read_bytes()


def test_what_is_not_seen_gives_the_same_film_and_no_confound(comity, here):
    answer = clips(comity, "robot.sensor.range_m=20,25", more=["--json"]).json
    assert answer["confounds"] == []
    first, second = sorted((here / "clips").glob("*.gif"))
    assert first.read_bytes() == second.read_bytes()


def test_the_distance_that_a_person_wants_is_not_drawn(comity, here):
    """Before anything has happened, films of two wanted distances show the same."""
    clips(comity)
    one, other = (
        np.asarray(Image.open(film).convert("RGB")).astype(int) for film in (here / "clips").glob("*.gif")
    )
    assert (abs(one - other).max(axis=2) > 40).mean() < 1e-3  # each film has a palette of its own


def test_the_same_command_gives_the_same_bytes(comity, here):
    for out in ("once", "twice"):
        assert clips(comity, out=out).code == 0
    once = {path.relative_to(here / "once"): path.read_bytes() for path in (here / "once").rglob("*.*")}
    twice = {path.relative_to(here / "twice"): path.read_bytes() for path in (here / "twice").rglob("*.*")}
    assert once == twice


@pytest.mark.parametrize(
    "words",
    [
        {"vary": "people.visited.profile=german_woman"},
        {"vary": "people.visited.profile=german_woman,german_woman"},
        {"vary": "people.visited.profil=german_woman,arab_woman"},
        {"vary": "people.visited.profile=german_woman,nobody_known"},
        {"vary": "rulebook"},
        {"vary": "rulebook=[a"},
        {"scenario": "johana"},
        {"out": "full"},
        {"out": "file"},
    ],
)
def test_what_cannot_be_filmed_is_refused_and_nothing_is_written(comity, here, words):
    (here / "full").mkdir()
    (here / "full/mine.txt").write_text("mine")
    (here / "file").write_text("mine")
    said = clips(comity, **words)
    assert said.code == 2
    assert "expected" in said.err
    assert not (here / "clips").exists()
    assert [path.name for path in (here / "full").iterdir()] == ["mine.txt"]


@given(st.lists(st.floats(-3.1, 3.1), min_size=2, max_size=20))
def test_the_share_of_gaze_counts_frames_whose_heading_is_within_15_degrees(headings):
    count = len(headings)
    poses = np.zeros((count, 2, 3))
    poses[:, 0, 2] = headings
    poses[:, 1, 0] = 2.0
    frames = Frames(("robot", "anna"), (0.25, 0.2), np.arange(count) * 0.05, poses)
    expected = sum(abs(heading) <= np.radians(15) for heading in headings) / count
    assert gaze_share(frames, "robot", "anna") == pytest.approx(expected, abs=1e-4)


NUMBERS = st.dictionaries(
    st.sampled_from([("", "episode_duration_s"), ("anna", "docked_s"), ("anna", "gaze_share")]),
    st.floats(0, 100),
)


@given(NUMBERS, NUMBERS)
def test_a_confound_is_whatever_differs_and_nothing_else(one, other):
    found = {(each.person, each.quantity) for each in confounds_of([one, other])}
    for place in {*one, *other}:
        values = [None if facts.get(place) is None else round(facts[place], 3) for facts in (one, other)]
        assert (place in found) == (values[0] != values[1])
    assert confounds_of([one, one]) == ()


def mp4_of(clip, folder):
    """When each frame of a film ends [s], and all its bytes."""
    film = folder / f"{clip}.mp4"
    words = [ffmpeg_program(), "-loglevel", "error", "-i", film, "-f", "framemd5", "-"]
    lines = subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()
    (base,) = (line.split("/")[1] for line in lines if line.startswith("#tb"))
    shown = [line.split(", ") for line in lines if not line.startswith("#")]
    return [(int(one[2]) + int(one[3])) / int(base) for one in shown], film.read_bytes()


def require_mp4_of_each(comity, here):
    """Each film: its frames, its length, and no word of its condition in its name or its bytes."""
    answer = clips(comity, more=["--json"]).json
    assert sorted(path.stem for path in (here / "clips").glob("*.mp4")) == [
        one["clip"] for one in answer["clips"]
    ]
    for one in answer["clips"]:
        ends_s, content = mp4_of(one["clip"], here / "clips")
        with Image.open(here / f"clips/{one['clip']}.gif") as gif:
            shown_s = [frame.info["duration"] / 1000 for frame in ImageSequence.Iterator(gif)]
        assert ends_s[:-1] == pytest.approx(np.cumsum(shown_s)[:-1])  # as many, each as long
        assert ends_s[-1] == pytest.approx(one["length_s"], abs=0.151)  # and the last one once
        assert content[4:8] == b"ftyp"
        told = subprocess.run(
            [ffmpeg_program(), "-i", here / f"clips/{one['clip']}.mp4"],
            check=False,
            capture_output=True,
            text=True,
        )
        assert "yuv420p" in told.stderr
        assert re.fullmatch("clip-[0-9a-f]{8}", one["clip"])
        for word in ("german", "arab", "woman", "profile", "johanna", "Comity"):
            assert word.encode() not in content


@pytest.mark.skipif(ffmpeg_program() is None, reason=f"ffmpeg is not installed ({INSTALL})")
def test_films_are_mp4_as_well_where_ffmpeg_is_found(comity, here):
    require_mp4_of_each(comity, here)


@pytest.fixture
def no_ffmpeg(here, monkeypatch):
    """A path without the program, and no package that brings one."""
    (here / "bin").mkdir()
    monkeypatch.setenv("PATH", str(here / "bin"))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)


@pytest.mark.usefixtures("no_ffmpeg")
def test_without_ffmpeg_the_command_says_what_to_install(comity, here):
    said = clips(comity)
    assert said.code == 0
    assert not [*(here / "clips").glob("*.mp4")]
    assert INSTALL in " ".join(said.out.split())


@pytest.mark.integration
@pytest.mark.usefixtures("no_ffmpeg")
def test_the_package_imageio_ffmpeg_is_enough_for_mp4(comity, here, monkeypatch):
    venv = ["venv", "-q", "--python", sys.executable, "env"]
    for words in (venv, ["pip", "install", "-q", "--python", "env", "imageio-ffmpeg"]):
        subprocess.run([sys.executable, "-m", "uv", *words], check=True)
    (packages,) = here.glob("env/lib/python*/site-packages")
    monkeypatch.syspath_prepend(packages)
    monkeypatch.delitem(sys.modules, "imageio_ffmpeg")
    assert packages in Path(ffmpeg_program()).parents
    require_mp4_of_each(comity, here)
