"""What can be passed on of people: no name, no words of theirs, no day; the numbers as they were."""

from __future__ import annotations

import csv
import json
import os
import re
import stat
from datetime import date, timedelta
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import yaml
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from comity.answers.run import RunAnswer
from comity.output.run_folder import RUN, RunFolder
from comity.people.learnt_file import Observation, Stated
from comity.people.profile import Profile
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity.sharing.extra import Extra
from comity.sharing.person import CLOSED, Filter, age_band, pseudonyms
from comity.sharing.run import record_shared, share
from comity_fis import Interval
from comity_fis.record import plain

own_words = st.text("zqxäßŻ", min_size=6, max_size=12).map(lambda text: f"w{text}")
"""Nothing that Comity itself says."""


def scenario(words):
    """A scenario in which every name and every text is somebody's own word."""
    one, other, map_, door, shelf, spot, tea, said, note, title, address, mood, group = words
    return {
        "schema_version": 1,
        "name": title,
        "about": note,
        "at": "2026-11-27",
        "place": {
            "map": {
                "schema_version": 1,
                "name": map_,
                "about": note,
                "rooms": {"a" + map_: {"box_m": [0, 0, 6, 5]}, "b" + map_: {"box_m": [6, 0, 4, 5]}},
                "doors": {door: {"at_m": [6, 2.5], "width_m": 1.2}},
                "furniture": [{"name": shelf, "box_m": [0.2, 4.2, 0.8, 0.5]}],
                "locations": {spot: {"at_m": [2.0, 3.0], "facing_deg": -90}},
            }
        },
        "robot": {"at_m": [0.8, 0.8], "name": "r" + title},
        "people": {
            one: {
                "at": spot,
                "profile": {
                    "name": "p" + one,
                    "about": note,
                    "culture": [{"name": "Egypt", "role": mood}, {"name": "k" + one}],
                    "gender": "g" + one,
                    "birth_date": "1946-03-09",
                    "form_of_address": {"name": address},
                    "hearing": mood,
                    "other": {"o" + one: note},
                    "settings": {"conversational_distance": 0.9, "greeting_gesture": "bow"},
                },
            },
            other: {"at_m": [4.4, 3.6], "facing_deg": -100, "profile": {"name": other, "age": 93}},
        },
        "groups": {group: [one, other]},
        "goals": [
            {"greet": one},
            {"say": said, "to": one},
            {"offer": tea, "to": one, "from": shelf},
            {"greet": other},
        ],
    }


def shared_of(words, folder, extras=()):
    (folder / "s.scenario.yaml").write_text(yaml.safe_dump(scenario(words), allow_unicode=True))
    recorded = record(prepare(load_scenario(str(folder / "s.scenario.yaml"))), out=folder / "run", views=())
    return recorded, share(recorded.folder, folder / "shared", extras)


def everything(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


@settings(max_examples=4, phases=[Phase.generate])
@given(st.lists(own_words, min_size=13, max_size=13, unique=True))
def test_no_word_that_people_wrote_or_are_called_is_in_a_shared_run(words):
    with TemporaryDirectory() as place:
        shared_of(words, Path(place))
        raw, shared = (everything(Path(place) / name) for name in ("run", "shared"))
        unused = (words[8], words[10])  # a note and a form of address, which a run does not hold either
        for word in words:
            assert word in unused or any(word.encode() in content for content in raw.values())
            assert [name for name, content in shared.items() if word.encode() in content] == []
        told = b"".join(content for name, content in shared.items() if name != "replay.html")
        for day in (b"2026-11-27", b"1946-03"):
            assert day not in told


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """A run and what is shared of it."""
    words = [f"w{i}zq" for i in range(13)]
    folder = tmp_path_factory.mktemp("pair")
    recorded, shared = shared_of(words, folder)
    return words, recorded, shared


def test_tracks_values_and_metrics_are_those_of_the_run(pair):
    words, recorded, shared = pair
    names = {words[0]: "person_1", words[1]: "person_2"}
    was, is_ = recorded.answer, shared.answer
    assert is_.metrics == was.metrics
    assert is_.figures == {names[name]: figures for name, figures in was.figures.items()}
    for name, new in names.items():
        for parameter, value in was.values[name].parameters.items():
            told = is_.values[new].parameters[parameter]
            assert (told.value, told.origin, told.spread) == (value.value, value.origin, value.spread)
    before, after = (
        list(csv.reader((folder / "frames.csv").read_text().splitlines()))
        for folder in (recorded.folder, shared.folder)
    )
    entities = {**names, "r" + words[9]: "robot"}
    assert [[row[0], entities.get(row[1], row[1]), *row[2:]] for row in before] == after


def test_the_tree_does_what_it_did_and_rules_and_facts_are_not_told(pair):
    _, recorded, shared = pair
    before, after = (
        [json.loads(line) for line in (folder / "trace.jsonl").read_text().splitlines()[1:]]
        for folder in (recorded.folder, shared.folder)
    )
    for was, is_ in zip(before, after, strict=True):
        same = ("path", "status", "t", "halt")
        assert [is_.get(key) for key in same] == [was.get(key) for key in same]
    kinds = {
        cause["kind"] for event in after for cause in event.get("because", ()) if isinstance(cause, dict)
    }
    assert kinds == {"reading", "condition", "step", "parameter"}


def test_a_shared_run_can_be_looked_at_and_asked_like_any_other(pair, comity, here):
    folder = pair[2].folder.path
    for words in (
        ["trace", folder, "--why", "3"],
        ["metrics", folder],
        ["replay", folder, "--out", "p.html"],
    ):
        assert comity(*words).code == 0
    assert comity("replay", folder, "--gif", "a.gif").code == 0
    again = share(RunFolder(folder), here / "again")
    assert again.answer.figures == pair[2].answer.figures


@pytest.mark.parametrize("name", ["guest-walks-off", "changes-her-mind", "walled-in", "group-at-the-window"])
def test_what_happens_on_the_way_names_nobody_either(name, tmp_path):
    """Another plan, another wish, somebody who cannot be served, a group."""
    file = load_scenario(name)
    run = record(prepare(file), out=tmp_path / "run", views=()).folder
    shared = everything(share(run, tmp_path / "shared", views=()).folder.path)
    told = json.dumps({file: content.decode() for file, content in shared.items() if file != "scenario.yaml"})
    told = told.replace(name, "")
    assert [person for person in file.scenario.people if re.search(rf"\b{person}\b", told)] == []


def test_a_shared_run_can_be_read_by_the_user_alone(pair):
    folder = pair[2].folder.path
    if os.name == "posix":
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700
        assert {stat.S_IMODE(path.stat().st_mode) for path in folder.iterdir() if path.is_file()} == {0o600}


def test_culture_and_gender_are_told_only_where_they_are_asked_for(pair, tmp_path):
    folder = pair[1].folder
    for extras in ((), (Extra.GENDER,), (Extra.CULTURE,), (Extra.CULTURE, Extra.GENDER)):
        shared = share(folder, tmp_path / "-".join(extras or ["none"]), extras)
        profile = yaml.safe_load((shared.folder / "scenario.yaml").read_text())["people"]["person_1"][
            "profile"
        ]
        assert {"culture", "gender"} & profile.keys() == set(extras)
        assert profile["settings"] == {"conversational_distance": 0.9, "greeting_gesture": "bow"}
        assert plain(shared.answer.shared) == {
            "culture": Extra.CULTURE in extras,
            "gender": Extra.GENDER in extras,
        }


def test_a_run_with_pseudonyms_is_the_run_as_it_would_be_shared(tmp_path):
    prepared = prepare(load_scenario("two-visits"))
    raw = record(prepared, out=tmp_path / "raw", views=()).folder
    share(raw, tmp_path / "a" / "run")
    record_shared(prepared, out=tmp_path / "b" / "run")
    assert everything(tmp_path / "a") == everything(tmp_path / "b")


def test_a_run_with_pseudonyms_that_is_broken_off_is_kept_up_to_there_without_a_name(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))

    def stop(progress):
        if progress.simulated_s > 3.0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        record_shared(prepare(load_scenario("two-visits")), out=tmp_path / "run", watch=stop)
    account = RunFolder(tmp_path / "run").read(RUN, RunAnswer)
    assert (account.status, account.error) == ("crashed", "interrupted")
    assert [path.name for path in tmp_path.iterdir()] == ["run"]
    assert [file for file, content in everything(tmp_path / "run").items() if b"german_man" in content] == []


def test_nothing_else_is_kept_of_a_run_with_pseudonyms(comity, here, monkeypatch):
    temporary = here / "tmp"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    answer = comity("run", "two-visits", "--pseudonyms", "--out", "run", "--json").json
    assert list(answer["profiles"]) == ["person_1", "person_2"]
    assert list(temporary.glob("comity-*")) == []
    for content in everything(here / "run").values():
        assert b"german_man" not in content
        assert b"guest" not in content.replace(b"guests", b"")
    said = comity("run", "two-visits", "--pseudonyms", "--no-pictures").out
    assert "guest" not in said
    assert RunFolder(here / "runs" / "shared-1").read(RUN, RunAnswer).outcome == "success"


def test_a_run_is_not_shared_into_itself_nor_where_something_else_is(comity, here):
    assert comity("run", "--out", "run", "--no-pictures").code == 0
    before = everything(here / "run")
    (here / "other").mkdir()
    (here / "other" / "thesis.txt").write_text("mine")
    for out in ("run", "other"):
        assert comity("share", "run", "--out", out).code == 2
    assert everything(here / "run") == before
    assert comity("run", "--with", "culture").code == 2
    assert comity("share", "nowhere").code == 2


@given(st.floats(0, 122), st.floats(0, 122))
def test_an_age_is_in_its_band_and_bands_do_not_tell_it(age, other):
    low, high = bounds(age_band(age))
    assert low <= age < high
    assert high - low >= 2
    if age_band(age) != age_band(other):
        assert (age < other) == (low < bounds(age_band(other))[0])


@given(st.integers(1, 121))
def test_a_year_of_birth_gives_a_band_that_holds_both_ages(age):
    low, high = bounds(age_band(Interval(age - 1.0, float(age))))
    assert low <= age - 1 < age < high


def bounds(band):
    if band == "under 18":
        return 0, 18
    if band.endswith(" or more"):
        return int(band.split()[0]), 1000
    low, high = map(int, band.split(" to "))
    return low, high + 1


@given(st.lists(st.text(min_size=1), min_size=1))
def test_one_name_has_one_pseudonym_and_no_two_the_same(names):
    given_ = pseudonyms(names)
    assert given_.keys() == set(names)
    assert len(set(given_.values())) == len(given_)
    assert list(given_.values()) == [f"person_{i}" for i in range(1, len(given_) + 1)]


@given(st.dictionaries(st.sampled_from(sorted(CLOSED)), own_words), own_words)
def test_words_of_their_own_pass_no_filter(facts, word):
    told = {key: fact for key, fact in facts.items() if key not in ("touch_consent", "occasion")}
    profile = Profile(name=word, about=word, age=70, income=word, mobility=word, settings={"x": word}, **told)
    row = Filter().profile(profile, None, "P07")
    assert row == {"schema_version": 1, "name": "P07", "other": {"age_band": "70 to 79"}}


@given(st.dates(date(2000, 1, 1), date(2030, 1, 1)), st.lists(st.integers(0, 900), min_size=1))
def test_what_was_learnt_is_told_by_days_since_the_first(first, days):
    learnt = [
        Observation(
            day=first + timedelta(days=n),
            situation={"posture": "standing", "place": "her room"},
            model_m=0.8,
            distance_m=0.7,
            signal="step_back",
        )
        for n in days
    ]
    said = Stated(day=first + timedelta(days=max(days)), situation={}, model_m=0.8, likes_m=1.0)
    rows = Filter().learnt([*learnt, said])
    assert [row["days"] for row in rows] == sorted(n - min(days) for n in [*days, max(days)])
    assert {tuple(row["situation"].items()) for row in rows} == {(("posture", "standing"),), ()}
    assert str(first.year) not in json.dumps(rows)


def test_an_export_under_a_pseudonym_is_a_profile_without_name_day_and_free_text(comity, here, monkeypatch):
    monkeypatch.setenv("COMITY_HOME", str(here / "home"))
    facts = ["culture=SWE", "gender=female", "birth_date=1946-03-09", "about=a note", "hearing=hearing aid"]
    assert comity("profile", "set", "mira", *facts, "distance=0.9").code == 0
    answer = ["--answer", "1.0", "--counts-as", "observation", "--at", "2026-01-05"]
    assert comity("profile", "ask", "mira", *answer).code == 0
    said = comity("profile", "export", "mira", "--pseudonym", "P07", "--out", "p07.yaml")
    assert said.code == 0
    text = (here / "p07.yaml").read_text()
    for word in ("mira", "1946", "2026", "note", "aid", "female", "SWE"):
        assert word not in text
    both = comity("profile", "export", "mira", "--pseudonym", "P07", "--with", "culture", "--json").json
    assert both["profile"]["culture"] == {"SWE": 1.0}
    assert both["learnt"][0]["days"] == 0
    assert comity("infer", "p07.yaml", "--json").json["parameters"]["conversational_distance"]["value"] == 0.9
    assert comity("profile", "export", "mira", "--with", "culture").code == 2
    assert comity("profile", "export", "mira", "--pseudonym", "../x").code == 2
