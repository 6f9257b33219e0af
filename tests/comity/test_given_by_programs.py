"""What a program gives and nobody can use is refused in words; no fact steers a terminal."""

from __future__ import annotations

from datetime import date, datetime

import pytest
from hypothesis import given
from hypothesis import strategies as st

import comity as front_door
from comity.people.consents import SCOPES, give
from comity_fis import InputError

pytestmark = pytest.mark.usefixtures("home")
nothing_usable = st.one_of(
    st.integers(),
    st.floats(),
    st.booleans(),
    st.lists(st.text(max_size=3), max_size=2),
    st.binary(max_size=3),
)
steering = st.text(max_size=5).map(lambda text: f"{text}\x1b[31m{text}\nNote: forged")


@given(st.none() | nothing_usable)
def test_nobody_is_kept_under_what_is_no_name(name):
    with pytest.raises(InputError, match="somebody who is kept"):
        front_door.profile(name)


@given(nothing_usable)
def test_a_day_is_a_date_or_words(at):
    with pytest.raises(InputError, match="YYYY-MM-DD"):
        front_door.infer(at=at)


@given(nothing_usable | st.dictionaries(st.just("DEU"), st.just(1), min_size=1))
def test_a_culture_is_a_word(culture):
    with pytest.raises(InputError, match="one culture"):
        front_door.infer(culture=culture)


@given(steering)
def test_no_fact_steers_a_terminal_or_forges_a_line(text):
    for refused in (lambda: front_door.infer(culture=text), lambda: front_door.infer({"culture": text})):
        with pytest.raises(InputError, match="one line"):
            refused()


def test_control_characters_of_a_profile_are_refused_with_their_line(comity, here):
    (here / "p.profile.yaml").write_text('schema_version: 1\nname: x\nculture: "K\\e[31m\\nNote: forged"\n')
    said = comity("infer", "p.profile.yaml")
    assert (said.code, said.out) == (2, "")
    assert said.err.startswith("comity: p.profile.yaml:3")
    assert "\x1b" not in said.err
    assert comity("infer", "--set", "culture=K\nNote: forged").code == 2


def test_what_was_observed_is_given_as_it_is_meant(comity):
    give("amal", SCOPES, by="a_test", day=date(2000, 1, 1))
    amal = front_door.profile("amal")
    for wrong in ({"situation": "seated"}, {"situation": ["posture"]}, {"at": 3}, {"at": 3.5}):
        with pytest.raises(InputError):
            amal.observe("stepped_back", 0.8, **wrong)
    assert amal.observe("stepped_back", 0.8, at=datetime(2026, 1, 5, 12, 30)).day == date(2026, 1, 5)
