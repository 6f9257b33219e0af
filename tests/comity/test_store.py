"""What is kept of people: on this machine, whole, readable, and gone when it is deleted."""

from __future__ import annotations

import os
import stat
from concurrent.futures import ThreadPoolExecutor

import pytest
import yaml

from comity.adaptation.editing import books, keep_edited
from comity.adaptation.learning import in_words, keep
from comity.adaptation.resetting import reset
from comity.people.consents import SCOPES
from comity.people.learnt_file import LearntFile
from comity.people.profile import load_profile
from comity.people.store import Store
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity.system.locks import locked
from comity_fis import InputError

LEARNT = {
    "schema_version": 1,
    "person": "amal",
    "conversational_distance": [
        {
            "day": "2026-01-01",
            "situation": {"posture": "standing"},
            "model_m": 0.85,
            "distance_m": 0.85,
            "signal": "step_back",
        }
    ],
}


def everything(home):
    """Every path below a folder with what it holds."""
    return {path: path.read_bytes() if path.is_file() else None for path in sorted(home.rglob("*"))}


def agree(comity, *names):
    """Before anything else is kept of somebody."""
    for name in names:
        assert comity("profile", "consent", name, *SCOPES, "--by", "a_test").code == 0


def test_a_person_is_kept_as_a_file_that_people_can_read(comity, home):
    said = comity("profile", "set", "amal", "culture={Egypt: 1, SWE: 2}", "birth_year=1954", "distance=90 cm")
    assert said.code == 0, said.err
    file = home / "people" / "amal" / "profile.yaml"
    assert {path.name for path in home.rglob("*.yaml")} == {"profile.yaml", "consent.yaml"}
    assert file.read_text() == (
        "schema_version: 1\nname: amal\nculture: {Egypt: 1, SWE: 2}\nbirth_year: 1954\n"
        "settings: {conversational_distance: 0.9}\n"
    )


@pytest.mark.skipif(os.name != "posix", reason="permissions as POSIX has them")
def test_nobody_else_may_read_it(comity, home):
    comity("profile", "set", "amal", "age=71")
    folder = home / "people" / "amal"
    assert stat.S_IMODE(folder.stat().st_mode) == 0o700
    assert stat.S_IMODE(folder.parent.stat().st_mode) == 0o700
    assert stat.S_IMODE((folder / "profile.yaml").stat().st_mode) == 0o600


def test_whoever_is_kept_can_be_used_wherever_a_profile_can(comity, here, home):
    comity("profile", "set", "amal", "gender=female", "culture=SWE", "distance=1.1")
    (here / "amal.yaml").write_text("name: amal\nculture: SWE\ngender: female\n")
    kept, file = (
        comity("infer", name, "--rulebook", "evidence", "--json").json for name in ("amal", "amal.yaml")
    )
    assert kept["inputs"] == file["inputs"]
    assert kept["parameters"]["conversational_distance"]["value"] == 1.1
    assert comity("explain", "approach_speed", "amal").code == 0
    assert comity("profile", "show", "amal", "--json").json["place"] == "kept"
    answer = comity("run", "--as", "johanna=amal", "--out", "run", "--json").json
    assert answer["profiles"] == {"johanna": "amal"}
    assert answer["visits"][0]["distance_wanted_m"] == 1.1
    assert {"name": "amal", "about": "Kept here. "} in [
        {**row, "about": row["about"] + " "} for row in comity("profiles", "--json").json["profiles"]
    ]


def test_a_run_of_somebody_who_was_deleted_still_runs_again(comity, here, home):
    """The resolved scenario holds all that was used, and the store is not asked any more."""
    comity("profile", "set", "amal", "culture=SWE", "distance=1.1")
    prepared = prepare(load_scenario("johanna"), profiles={"johanna": "amal"})
    first = record(prepared, out=here / "a", views=()).answer
    comity("profile", "delete", "amal", "--yes")
    again = record(prepare(load_scenario("a/scenario.yaml")), out=here / "b", views=()).answer
    assert again.trace_sha256 == first.trace_sha256


def test_a_kept_name_goes_before_a_file_and_a_path_names_the_file(comity, here, home):
    comity("profile", "set", "amal", "age=71")
    (here / "amal").write_text("name: other\nage: 20\n")
    assert comity("infer", "amal", "--json").json["inputs"]["age"] == 71
    assert comity("infer", "./amal", "--json").json["inputs"]["age"] == 20


def test_a_shipped_name_cannot_be_taken(comity, home):
    said = comity("profile", "set", "unknown", "age=71")
    assert said.code == 2
    assert "ships with Comity" in said.err
    assert everything(home) == {}


def test_a_shipped_name_that_was_taken_before_it_shipped_is_no_silent_choice(home):
    (home / "people" / "unknown").mkdir(parents=True)
    (home / "people" / "unknown" / "profile.yaml").write_text(
        "name: unknown\nsettings: {approach_speed: 0.2}\n"
    )
    with pytest.raises(InputError, match="Rename that folder"):
        load_profile("unknown")


def test_deleting_leaves_nothing(comity, home):
    comity("profile", "set", "zebedee", "culture=SWE", "distance=1.1", "about=likes quiet mornings")
    comity("profile", "set", "other", "age=20")
    Store().change_learnt("zebedee", lambda _: {"person": "zebedee", "offset": 0.123})
    (home / "people" / "zebedee" / ".profile.yaml.x7f").write_text("half a file of zebedee")
    said = comity("profile", "delete", "zebedee", "--yes")
    assert said.code == 0
    assert "Searched no folder" in said.out
    left = everything(home)
    assert [path.name for path in left if path.is_file()] == ["consent.yaml", "profile.yaml"]
    for path, content in left.items():
        assert "zebedee" not in str(path.relative_to(home))
        assert b"zebedee" not in (content or b"")
        assert b"quiet mornings" not in (content or b"")
    assert comity("profile", "show", "zebedee").code == 2
    assert comity("profile", "delete", "zebedee", "--yes").code == 2


def test_who_was_deleted_is_not_brought_back_by_what_was_learnt(comity, home):
    """As when a person is deleted while a run with them is still on its way."""
    comity("profile", "set", "amal", "age=71")
    comity("profile", "delete", "amal", "--yes")
    observed = LearntFile.model_validate(LEARNT).conversational_distance
    assert keep({"amal": observed[0]}) == frozenset()
    assert list(in_words({"amal": observed[0]}, frozenset())) == [
        "Learnt   nothing about amal, who is not kept any more"
    ]
    assert not [path for path in everything(home) if "amal" in path.name]


def test_nobody_inherits_what_was_left_of_another_of_the_same_name(comity, home):
    (home / "people" / "amal").mkdir(parents=True)
    (home / "people" / "amal" / "learnt.yaml").write_text(yaml.safe_dump(LEARNT))
    assert comity("profile", "set", "amal", "age=71").code == 0
    assert Store().learnt("amal") is None


def test_learning_waits_for_a_deletion_and_then_writes_nothing(comity, home):
    comity("profile", "set", "amal", "age=71")
    with ThreadPoolExecutor(1) as pool:
        with locked(home / "people"):
            written = pool.submit(Store().change_learnt, "amal", lambda _: LEARNT)
            with pytest.raises(TimeoutError):
                written.result(timeout=0.2)
            (home / "people" / "amal" / "profile.yaml").unlink()
        assert not written.result(timeout=10)
    assert Store().learnt("amal") is None


def test_deleting_asks_a_person_and_nobody_else(comity, home):
    comity("profile", "set", "amal", "age=71")
    before = everything(home)
    said = comity("profile", "delete", "amal")
    assert said.code == 2
    assert "--yes" in said.err
    assert everything(home) == before


def test_reset_goes_back_to_inference_in_one_step(comity, home):
    comity("profile", "set", "amal", "culture=SWE", "gender=female")
    plain = comity("infer", "amal", "--json").json
    comity("profile", "set", "amal", "distance=2", "speed=0.2", "gesture=bow")
    Store().change_learnt("amal", lambda _: {"person": "amal"})
    assert comity("infer", "amal", "--json").json != plain
    assert comity("profile", "reset", "amal", "gesture").code == 0
    assert Store().learnt("amal") is not None
    assert comity("infer", "amal", "--json").json["parameters"]["conversational_distance"]["value"] == 2
    assert comity("profile", "reset", "amal").code == 0
    assert comity("infer", "amal", "--json").json == plain
    assert Store().learnt("amal") is None
    assert comity("profile", "reset", "amal", "distance").code == 2


def test_what_is_exported_is_all_of_it_and_can_be_used(comity, here, home):
    comity("profile", "set", "amal", "culture={Egypt: 1, SWE: 2}", "distance=1.1", "languages=[ara, swe]")
    Store().change_learnt("amal", lambda _: LEARNT)
    said = comity("profile", "export", "amal", "--out", "amal.yaml")
    assert said.code == 0
    exported, kept = (here / "amal.yaml").read_text(), Store().path("amal").read_text()
    assert kept in exported
    assert "#   signal: step_back" in exported
    assert comity("profile", "export", "amal").out == exported
    both = comity("profile", "export", "amal", "--json").json
    assert both["profile"] == yaml.safe_load(kept)
    assert both["learnt"] == LEARNT
    inferred = comity("infer", "amal", "--json").json
    comity("profile", "delete", "amal", "--yes")
    assert comity("infer", "amal.yaml", "--rulebook", inferred["rulebook"], "--json").json == inferred


def test_an_export_replaces_nothing_that_is_not_ours(comity, here, home):
    comity("profile", "set", "amal", "age=71")
    (here / "thesis.yaml").write_text("chapters: 7\n")
    assert comity("profile", "export", "amal", "--out", "thesis.yaml").code == 2
    assert (here / "thesis.yaml").read_text() == "chapters: 7\n"


def test_a_fact_is_taken_back_with_unknown(comity, home):
    comity("profile", "set", "amal", "culture=SWE", "gender=female", "distance=1")
    comity("profile", "set", "amal", "gender=unknown", "settings.conversational_distance=unknown")
    assert yaml.safe_load(Store().path("amal").read_text()) == {
        "schema_version": 1,
        "name": "amal",
        "culture": "SWE",
    }


@pytest.mark.parametrize("answer", ["0.9", "0.9 m", "90 cm", "90cm"])
def test_the_answer_to_the_one_question_goes_before_where_somebody_is_from(comity, home, answer):
    comity("profile", "set", "amal", "culture=DEU", "gender=male")
    assert comity("profile", "ask", "amal", "--answer", answer).code == 0
    value = comity("infer", "amal", "--json").json["parameters"]["conversational_distance"]
    assert (value["value"], value["origin"]) == (0.9, "setting")


@pytest.mark.parametrize("answer", ["9", "20 cm", "near", "-1", "nan"])
def test_an_answer_that_cannot_be_granted_changes_nothing(comity, home, answer):
    comity("profile", "set", "amal", "culture=DEU")
    before = everything(home)
    said = comity("profile", "ask", "amal", "--answer", answer)
    assert said.code == 2
    assert "conversational_distance" in said.err
    assert everything(home) == before


def test_the_question_may_be_left_open(comity, home):
    comity("profile", "set", "amal", "culture=DEU")
    before = everything(home)
    assert comity("profile", "ask", "amal", "--answer", "").code == 0
    assert everything(home) == before
    assert comity("profile", "ask", "amal").code == 2  # nobody at the terminal


def test_the_answer_unknown_takes_the_wish_back(comity, home):
    comity("profile", "set", "amal", "culture=DEU", "distance=0.9")
    said = comity("profile", "ask", "amal", "--answer", "unknown")
    assert (said.code, said.err) == (0, "")
    assert "left to the rules" in said.out
    assert "settings" not in yaml.safe_load(Store().path("amal").read_text())
    assert comity("profile", "ask", "amal", "--answer", "unknown").code == 0


def test_a_disk_that_refuses_leaves_what_was_there(comity, home, monkeypatch):
    comity("profile", "set", "amal", "age=71")
    agree(comity, "new")
    before = everything(home)

    def full(handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    for name in ("amal", "new"):
        said = comity("profile", "set", name, "age=72")
        assert said.code == 2
        assert "No space left" in said.err
        assert "COMITY_HOME" in said.err
    assert everything(home) == before


BAD = {
    "no key": ["age"],
    "no value": ["age="],
    "a key twice": ["age=1", "age=2"],
    "a misspelt key": ["gendre=female"],
    "a key that is not asked": ["hometown=Rome"],
    "a misspelt wish": ["settings.conversational_distans=1"],
    "a variable that has a key": ["other.age=20"],
    "a word for a number": ["age=old"],
    "too old": ["age=200"],
    "older than anybody": ["age=123"],
    "born too long ago": ["birth_year=1800"],
    "born on a day too long ago": ["birth_date=1850-03-01"],
    "not a number": ["age=.nan"],
    "half a level": ["education=3.5"],
    "no such level": ["education=9"],
    "a code of no country": ["culture=JPM"],
    "a weight of nothing": ["culture={Egypt: 0, SWE: 1}"],
    "a weight below nothing": ["culture={Egypt: -1, SWE: 1}"],
    "no cultures": ["culture=[]"],
    "no culture with a weight": ["culture={}"],
    "a language that is no word": ["languages=[ara, '!!']"],
    "a language in digits": ["languages=['12']"],
    "no languages": ["languages=[]"],
    "a region without a culture": ["region=Arab countries"],
    "a region that stands for nothing": ["culture=SWE", "region=Arab countries"],
    "a region without a score": ["culture=Egypt", "region=Sudan"],
    "an end before the start": ["culture=[{name: SWE, from: 2010, until: 2004}]"],
    "a birth in the future": ["birth_year=2150"],
    "a day of birth in the future": ["birth_date=2150-02-03"],
    "two ages": ["age=71", "birth_year=1954"],
    "no day": ["birth_date=March"],
    "a day that is none": ["birth_date=2001-02-30"],
    "days out of order": ["education=[{from: 2010, value: 6}, {from: 2004, value: 3}]"],
    "a day without a value": ["education=[{from: 2010}]"],
    "no dated values": ["education=[]"],
    "an unclear consent": ["touch_consent=maybe"],
    "a misspelt gender": ["gender=femal"],
    "broken YAML": ["culture={Egypt: 1"],
    "a tag": ["culture=!!python/name:os.system x"],
    "a wish too near": ["distance=0.2"],
    "a wish too far": ["distance=30"],
    "a wish faster than is safe": ["speed=0.9"],
    "a wish in words": ["distance=near"],
    "a misspelt gesture": ["gesture=wafe"],
    "touch without consent": ["gesture=handshake"],
    "a gesture without one": ["greeting=verbal", "gesture=bow"],
    "infinitely far": ["distance=.inf"],
}


@pytest.mark.parametrize("kind", BAD)
def test_what_cannot_be_kept_is_refused_and_nothing_is_written(comity, home, kind):
    wish = {"conversational_distance": 1.1}
    Store().change_profile("kept", lambda _: {"name": "kept", "culture": "SWE", "settings": wish})
    agree(comity, "kept", "new")
    before = everything(home)
    for name in ("new", "kept"):
        words = ["settings.conversational_distance=unknown", *BAD[kind]] if name == "kept" else BAD[kind]
        said = comity("profile", "set", name, *words)
        assert (said.code, said.out) == (2, ""), kind
        assert "expected" in said.err
        assert "Traceback" not in said.err
        assert not [word for word in ("tuple", "function-", "Since", "str]", "model_") if word in said.err]
    assert everything(home) == before


def test_a_wish_that_safety_would_change_is_refused_with_what_would_be_granted(comity, home):
    said = comity("profile", "set", "amal", "speed=0.9")
    assert said.code == 2
    assert "0.1..0.5 m/s" in said.err
    assert comity("profile", "set", "amal", "speed=0.5").code == 0


def test_a_wish_that_only_another_rulebook_can_grant_is_left_aside_with_a_note(comity, here, home):
    assert comity("profile", "set", "amal", "culture=SWE", "volume=0.3").code == 0
    (here / "amal.yaml").write_text("name: amal\nculture: SWE\nsettings: {voice_volume: 0.3}\n")
    for name in ("amal", "amal.yaml"):
        answer = comity("infer", name, "--rulebook", "bruno2017", "--json").json
        assert [note for note in answer["notes"] if "voice_volume 0.3" in note]
        assert "voice_volume 0.3" in comity("infer", name, "--rulebook", "bruno2017").out
        assert comity("explain", "approach_speed", name).code == 0
        heard = comity("infer", name, "--rulebook", "evidence", "--json").json
        assert heard["parameters"]["voice_volume"]["value"] == 0.3
        assert not [note for note in heard["notes"] if "voice_volume 0.3" in note]
    run = comity("run", "johanna", "--as", "johanna=amal", "--json")
    assert run.code == 0, run.err
    (here / "slip.yaml").write_text("name: amal\nsettings: {aproach_speed: 0.3}\n")
    said = comity("infer", "slip.yaml")
    assert said.code == 2
    assert "Did you mean 'approach_speed'?" in said.err


@pytest.mark.parametrize(
    "line",
    [
        "settings: unknown",
        "other: unknown",
        "about: unknown",
        "culture: {Japan: unknown}",
        "settings: {conversational_distance: unknown}",
    ],
)
def test_unknown_is_an_answer_everywhere(comity, here, line):
    (here / "who.yaml").write_text(f"name: who\n{line}\n")
    (here / "plain.yaml").write_text("name: who\n")
    said = comity("infer", "who.yaml", "--json")
    assert said.code == 0, said.err
    assert said.json == comity("infer", "plain.yaml", "--json").json


def test_a_culture_that_is_kept_back_leaves_the_others(comity, here):
    (here / "who.yaml").write_text("name: who\nculture: {Japan: unknown, SWE: 2}\n")
    (here / "plain.yaml").write_text("name: who\nculture: SWE\n")
    one, other = (
        comity("infer", name, "--json").json["parameters"]["approach_speed"]["value"]
        for name in ("who.yaml", "plain.yaml")
    )
    assert one == other


@pytest.mark.parametrize(
    "line", ["age: 120", "birth_year: 1904", "birth_date: 1904-02-21", "birth_year: 1908"]
)
def test_an_age_above_what_the_rules_know_counts_as_the_highest_with_a_note(comity, here, line):
    (here / "old.yaml").write_text(f"name: old\n{line}\n")
    (here / "oldest.yaml").write_text("name: old\nage: 117\n")
    answer = comity("infer", "old.yaml", "--at", "2026-01-01", "--json").json
    oldest = comity("infer", "oldest.yaml", "--json").json
    assert [note for note in answer["notes"] if "ages up to 117" in note]
    assert oldest["notes"] == []
    speeds = [one["parameters"]["approach_speed"]["value"] for one in (answer, oldest)]
    assert speeds[0] == pytest.approx(speeds[1])


def test_a_birth_in_the_future_says_so(comity, here, home):
    (here / "fut.yaml").write_text("name: fut\nbirth_year: 2150\n")
    for words in (("profile", "set", "fut", "birth_year=2150"), ("infer", "fut.yaml")):
        said = comity(*words)
        assert said.code == 2
        assert "2150, in the future" in said.err
        assert "Check the birth" in said.err


@pytest.mark.parametrize("name", ["../x", "a/b", ".", "..", "", "a b", "x.yaml", "x" * 65, "a\nb", "-"])
@pytest.mark.parametrize(
    "command", [["set", "NAME", "age=1"], ["delete", "NAME", "--yes"], ["export", "NAME"]]
)
def test_a_name_is_never_a_path(comity, here, home, command, name):
    said = comity("profile", *[name if word == "NAME" else word for word in command])
    assert said.code == 2
    assert "Traceback" not in said.err
    assert everything(home) == {}
    assert not list(here.iterdir())


def test_a_damaged_file_is_named_with_its_line(comity, home):
    comity("profile", "set", "amal", "age=71")
    file = home / "people" / "amal" / "profile.yaml"
    file.write_text("name: amal\nage: old\n")
    for words in (["infer", "amal"], ["profile", "show", "amal"], ["profile", "set", "amal", "age=3"]):
        said = comity(*words)
        assert said.code == 2
        assert f"{file}:2" in said.err
    assert file.read_text() == "name: amal\nage: old\n"


DAMAGED = {
    "no YAML": (b"conversational_distance: [\n", ":2"),
    "no text": (b"\xff\xfe\x00", "learnt.yaml:1:1: "),
    "something left out": (b"person: amal\nconversational_distance:\n- {day: 2026-01-01}\n", ":3"),
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_what_was_learnt_can_be_forgotten_also_where_its_file_is_damaged(comity, home, damage):
    """Whoever reads it is told the file, the line, and the command that goes on without it."""
    content, line = DAMAGED[damage]
    comity("profile", "set", "amal", "culture=SWE", "speed=0.2")
    file = home / "people" / "amal" / "learnt.yaml"
    file.write_bytes(content)
    for words in (["infer", "amal"], ["profile", "show", "amal"]):
        said = comity(*words)
        assert said.code == 2
        assert f"{file}" in said.err
        assert line in said.err
        assert "comity profile reset amal distance" in said.err
    assert comity("profile", "reset", "amal", "distance").code == 0
    assert not file.exists()
    assert comity("infer", "amal", "--json").json["parameters"]["approach_speed"]["value"] == 0.2


def test_forgetting_wishes_waits_for_who_changes_the_profile_and_loses_nothing(comity, home):
    """Both at once, again and again: the fact is kept, and the wish is gone."""
    for age in range(20, 30):
        comity("profile", "set", "amal", "distance=1.1", "age=unknown")
        with ThreadPoolExecutor(2) as pool:
            setting = pool.submit(keep_edited, "amal", {"age": str(age)}, books())
            pool.submit(reset, "amal").result()
            setting.result()
        kept = load_profile("amal").profile
        assert (kept.age, kept.settings) == (age, {})


def test_a_country_without_a_score_is_asked_about_when_it_is_kept(comity, home):
    """And not any more once the person has named a region."""
    said = " ".join(comity("profile", "set", "amal", "culture=Egypt").out.split())
    assert "Egypt has no score" in said
    assert "Arab countries, East Africa, West Africa" in said
    assert "Note" not in comity("profile", "set", "amal", "region=Arab countries").out


def test_capitals_make_no_difference_to_a_wish(comity, home):
    """It is kept as the rules write it; a word that is none of theirs is refused with the closest."""
    assert comity("profile", "set", "amal", "gesture=Bow", "greeting=BOTH").code == 0
    assert load_profile("amal").profile.settings == {"greeting_gesture": "bow", "greeting_modality": "both"}
    said = comity("profile", "set", "amal", "gesture=Bwo")
    assert (said.code, "Did you mean 'bow'?" in said.err) == (2, True)


def test_what_the_default_rulebook_does_not_decide_may_be_wished_of_another(comity, home):
    """A wish is judged by a rulebook that has the parameter; one that none has is a slip."""
    said = comity("profile", "set", "amal", "settings.conversational_distanse=1")
    assert said.code == 2
    assert "Did you mean 'conversational_distance'?" in said.err


def test_the_store_belongs_where_the_platform_keeps_a_users_data(monkeypatch, tmp_path):
    monkeypatch.delenv("COMITY_HOME")
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    if os.name == "posix" and os.uname().sysname == "Linux":
        assert Store().home == tmp_path / "comity"


@pytest.mark.parametrize("other", ["conversational_distance", "settings.distance"])
def test_one_wish_under_two_names_is_refused(comity, home, other):
    for words in (["distance=1.3", f"{other}=1.2"], [f"{other}=1.2", "distance=1.3"]):
        said = comity("profile", "set", "s2", *words)
        assert (said.code, "which mean the same" in said.err) == (2, True)
    kept = (home / "people" / "s2" / "profile.yaml").read_text()
    assert yaml.safe_load(kept) == {"schema_version": 1, "name": "s2"}


def test_a_word_that_another_shipped_rulebook_cannot_use_is_refused_when_it_is_set(comity, home):
    said = comity("profile", "set", "x2", "familiarity=lover")
    assert (said.code, "familiarity" in said.err) == (2, True)
    kept = (home / "people" / "x2" / "profile.yaml").read_text()
    assert yaml.safe_load(kept) == {"schema_version": 1, "name": "x2"}


def test_a_damaged_profile_is_listed_as_such_and_the_others_as_ever(comity, home):
    comity("profile", "set", "amal", "age=71")
    folder = home / "people" / "broken"
    folder.mkdir()
    (folder / "profile.yaml").write_text("{: garbage")
    said = comity("profiles", "--json")
    assert said.code == 0
    about = {row["name"]: row["about"] for row in said.json["profiles"]}
    assert "cannot be read" in about["broken"]
    assert about["amal"] == "Kept here."
    assert "arab_woman" in about
