"""What nobody agreed to is not kept; what they agree to no more is deleted."""

from __future__ import annotations

from datetime import date, timedelta
from itertools import chain, combinations

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

import comity as front_door
from comity.people import consents as consents_module
from comity.people.consents import SCOPES, Consent, ConsentFile, consents_of, is_covered
from comity.people.learnt_file import Observation
from comity.people.remembered import remember, remembered
from comity.people.store import Store
from comity_fis import InputError

pytestmark = [pytest.mark.nobody_agreed, pytest.mark.usefixtures("home")]
DAY = date(2026, 1, 1)
SEEN = Observation(
    day=DAY, situation={"posture": "standing"}, model_m=0.85, distance_m=0.85, signal="step_back"
)
days = st.integers(-400, 400).map(lambda n: DAY + timedelta(days=n))
some = st.lists(st.sampled_from(SCOPES), unique=True)


@pytest.fixture
def clock(monkeypatch):
    """The machine's clock, which a test may set."""

    class Clock(date):
        now = date.today()

        @classmethod
        def today(cls):
            return cls.now

    monkeypatch.setattr(consents_module, "date", Clock)
    return Clock


def agreed(comity, *scopes, name="amal", options=()):
    said = comity("profile", "consent", name, *scopes, "--by", "Kim", *options)
    assert said.code == 0, said.err


@st.composite
def consents(draw):
    from_ = draw(days)
    until = draw(st.none() | st.integers(1, 300).map(lambda n: from_ + timedelta(days=n)))
    withdrawn = draw(st.none() | days)
    scope = draw(st.sampled_from(SCOPES))
    return Consent.model_validate(
        {"scope": scope, "from": from_, "recorded_by": "Kim", "until": until, "withdrawn": withdrawn}
    )


@given(st.lists(consents(), max_size=6), days)
def test_a_scope_holds_from_its_first_day_to_its_end_and_never_without_remember(given_, day):
    holding = ConsentFile(person="amal", consents=tuple(given_)).holding(day)
    by_hand = {
        one.scope
        for one in given_
        if one.from_ <= day and (one.until is None or day < one.until) and one.withdrawn is None
    }
    assert holding == (by_hand if "remember" in by_hand else set())


@given(st.lists(consents(), max_size=6))
def test_what_is_written_is_read_back(given_):
    file = ConsentFile(person="amal", consents=tuple(given_))
    assert ConsentFile.model_validate(yaml.safe_load(yaml.safe_dump(file.model_dump(mode="json")))) == file


@pytest.mark.parametrize(
    "scopes", [*chain.from_iterable(combinations(SCOPES[1:], n) for n in range(4))], ids="-".join
)
def test_what_is_not_covered_is_not_kept(comity, here, home, scopes):
    """Every set of scopes: each command keeps what it may, and refuses the rest before it writes."""
    agreed(comity, "remember", *scopes)
    assert comity("profile", "set", "amal", "culture=SWE").code == 0
    can_touch = comity("profile", "set", "amal", "touch_consent=given").code == 0
    ask = ["profile", "ask", "amal", "--answer", "0.9", "--counts-as", "observation"]
    said, kept = comity(*ask).code == 0, (home / "people" / "amal" / "learnt.yaml").exists()
    ran = comity("run", "--as", "johanna=amal", "--no-pictures").code == 0
    assert (can_touch, said, kept, ran) == tuple(
        scope in scopes for scope in ("touch", "learn", "learn", "record")
    )
    assert (here / "runs").exists() == ran
    assert remember("amal", [SEEN]) == ("learn" in scopes)
    learns = comity("run", "--as", "johanna=amal", "--learn", "--no-pictures")
    assert (learns.code == 0) == ({"learn", "record"} <= set(scopes))
    assert "profile consent amal" in learns.err or learns.code == 0


def test_nothing_is_kept_of_somebody_who_was_not_asked(comity, home):
    said = comity("profile", "set", "amal", "age=71")
    assert said.code == 2
    assert "comity profile consent amal remember --by YOUR_NAME" in said.err
    assert list(home.rglob("*.yaml")) == []
    assert comity("profile", "consent", "amal", "learn", "--by", "Kim").code == 2
    assert comity("profile", "consent", "amal", "remember").code == 2
    assert comity("profile", "consent", "amal", "rememebr", "--by", "Kim").code == 2
    assert list(home.rglob("*.yaml")) == []


def test_an_episode_that_is_not_written_needs_no_consent_to_be_recorded(comity):
    agreed(comity, "remember")
    assert front_door.run("johanna", profiles={"johanna": "amal"}).outcome == "success"
    with pytest.raises(InputError, match="consent of amal to record"):
        front_door.run("johanna", profiles={"johanna": "amal"}, out="run")


def test_taking_back_consent_to_learn_deletes_what_was_learnt_and_nothing_else(comity, home):
    agreed(comity, *SCOPES)
    comity("profile", "set", "amal", "culture=SWE", "touch_consent=given")
    plain = comity("infer", "amal", "--json").json
    assert remember("amal", [SEEN])
    assert comity("infer", "amal", "--json").json != plain
    answer = comity("profile", "consent", "amal", "learn", "--withdraw", "--json").json
    assert answer["deleted"] == ["what was learnt"]
    assert not (home / "people" / "amal" / "learnt.yaml").exists()
    assert comity("infer", "amal", "--json").json == plain
    assert not remember("amal", [SEEN])
    withdrawn = [one["scope"] for one in answer["consents"] if "withdrawn" in one]
    assert withdrawn == ["learn"]
    agreed(comity, "learn")
    assert remember("amal", [SEEN])


def test_taking_back_consent_to_touch_withholds_it_in_the_profile(comity):
    agreed(comity, *SCOPES)
    comity("profile", "set", "amal", "touch_consent=given", "gesture=handshake")
    value = comity("infer", "amal", "--json").json["parameters"]["greeting_gesture"]["value"]
    assert value == "handshake"
    assert comity("profile", "consent", "amal", "touch", "--withdraw").code == 0
    shown = comity("profile", "show", "amal", "--json").json
    assert shown["declared"]["touch_consent"] == "withheld"
    assert shown["parameters"]["greeting_gesture"]["value"] != "handshake"


@pytest.mark.parametrize("at", [[], ["--at", "2020-01-01"], ["--at", "2020-06-01"]])
def test_an_end_before_the_beginning_is_refused_as_what_it_is(comity, home, at):
    said = comity(
        "profile", "consent", "amal", "remember", "record", "--by", "Kim", "--until", "2020-01-01", *at
    )
    assert (said.code, said.out) == (2, "")
    assert "--until" in said.err
    assert "an end after" in said.err
    assert "Kim" not in said.err
    assert not Store().keeps("amal")


def test_taking_back_consent_to_record_says_what_the_search_would_forget(comity):
    agreed(comity, *SCOPES)
    said = comity("profile", "consent", "amal", "record", "--withdraw")
    assert "yes forgets amal, too" in said.out
    assert Store().keeps("amal")
    assert "yes forgets" not in comity("profile", "consent", "amal", "--withdraw").out


@given(consents(), days)
def test_what_was_on_a_day_is_covered_by_what_held_then(one, day):
    held = one.from_ <= day and (one.until is None or day < one.until)
    assert one.covered(day) == (held and (one.withdrawn is None or day < one.withdrawn))


def test_a_meeting_before_the_consent_to_learn_is_kept_with_a_note(comity):
    agreed(comity, "remember", "learn", options=["--at", "2026-01-10"])
    seen = ["profile", "observe", "amal", "--signal", "stepped_back", "--distance", "0.8"]
    assert comity(*seen, "--at", "2026-01-10", "--json").json["notes"] == []
    (note,) = comity(*seen, "--at", "2026-01-09", "--json").json["notes"]
    assert "amal had not agreed to learn on 2026-01-09" in note
    assert "had not agreed" in comity(*seen, "--at", "2020-01-01").out


@pytest.mark.parametrize("words", [["remember", "--withdraw"], ["--withdraw"]])
def test_taking_back_all_forgets_the_person(comity, home, words):
    agreed(comity, *SCOPES)
    comity("profile", "set", "amal", "culture=SWE")
    said = comity("profile", "consent", "amal", *words)
    assert said.code == 0
    assert "profile delete amal" in said.out
    assert [path for path in home.rglob("*") if "amal" in path.name] == []


def test_what_was_agreed_to_until_a_day_is_gone_on_that_day(comity, home, clock):
    agreed(comity, "remember", options=["--at", "2026-01-01", "--until", "2028-01-01"])
    agreed(comity, "learn", options=["--at", "2026-01-01", "--until", "2027-01-01"])
    clock.now = date(2026, 12, 31)
    assert remember("amal", [SEEN])
    assert remembered("amal") is not None
    clock.now = date(2027, 1, 1)
    assert remembered("amal") is None
    assert not (home / "people" / "amal" / "learnt.yaml").exists()
    assert comity("infer", "amal").code == 0
    clock.now = date(2028, 1, 1)
    assert comity("infer", "amal").code == 2
    assert not Store().keeps("amal")


def test_consent_that_begins_later_covers_nothing_yet_and_deletes_nothing(comity, clock):
    clock.now = date(2026, 1, 1)
    agreed(comity, "remember", options=["--at", "2026-02-01"])
    assert not is_covered("amal", "remember")
    assert comity("profile", "set", "amal", "age=71").code == 2
    clock.now = date(2026, 2, 1)
    assert comity("profile", "set", "amal", "age=71").code == 0


def test_people_of_an_older_store_stay_and_nothing_more_is_kept_of_them(comity, home):
    Store().change_profile("old", lambda _: {"schema_version": 1, "name": "old", "culture": "SWE"})
    assert comity("infer", "old").code == 0
    assert "no consent" not in comity("profile", "show", "old").out
    assert "so that nothing more is kept" in comity("profile", "show", "old").out
    for words in (["set", "old", "age=71"], ["ask", "old", "--answer", "0.9"]):
        assert comity("profile", *words).code == 2
    assert comity("run", "--as", "johanna=old").code == 2
    agreed(comity, "remember", name="old")
    assert comity("profile", "set", "old", "age=71").code == 0
    assert comity("infer", "old", "--json").json["inputs"]["age"] == 71


def test_who_recorded_it_and_when_is_shown_and_handed_out(comity):
    agreed(comity, "remember", options=["--at", "2026-01-01", "--until", "2100-01-01"])
    row = {"scope": "remember", "from": "2026-01-01", "recorded_by": "Kim", "until": "2100-01-01"}
    assert comity("profile", "show", "amal", "--json").json["consents"] == [row]
    assert comity("profile", "export", "amal", "--json").json["consents"] == [row]
    assert comity("profile", "consent", "amal", "--json").json["consents"] == [row]
    assert "recorded by Kim" in comity("profile", "show", "amal").out
    assert "recorded_by: Kim" in comity("profile", "export", "amal").out


def test_a_damaged_file_of_consents_is_named_and_nothing_is_deleted(comity, home):
    agreed(comity, *SCOPES)
    path = home / "people" / "amal" / "consent.yaml"
    path.write_text("schema_version: 1\nperson: amal\nconsents: [{scope: everything}]\n")
    said = comity("infer", "amal")
    assert (said.code, str(path) in said.err) == (2, True)
    assert (home / "people" / "amal" / "profile.yaml").exists()
    with pytest.raises(InputError):
        consents_of("amal")


@pytest.mark.parametrize("words", [["remember", "--by", ""], ["remember", "--by", "Kim", "--withdraw"]])
def test_words_that_say_nothing_are_refused(comity, words):
    assert comity("profile", "consent", "amal", *words).code == 2
    assert comity("profile", "consent", "nobody").code == 2
    until = ["remember", "--by", "Kim", "--at", "2026-01-02", "--until", "2026-01-01"]
    assert comity("profile", "consent", "amal", *until).code == 2
