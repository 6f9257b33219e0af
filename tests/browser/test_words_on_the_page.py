"""The page shows what is said in its script and in Latin letters, and the facts of the wordings."""

from __future__ import annotations

import pytest

from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario

AMAL = {"languages": ["ar"], "form_of_address": {"name": "Okafor", "title": "Dr"}}


@pytest.fixture(scope="module")
def page_of_words(tmp_path_factory):
    """The page of a visit to a person who speaks Arabic, and when they are greeted [s]."""
    out = tmp_path_factory.mktemp("words") / "run"
    prepared = prepare(load_scenario("johanna"), profiles={"johanna": AMAL}, rulebook="evidence")
    done = record(prepared, out=out, views=())
    (out / "replay.html").write_text(replay_page(done.folder), encoding="utf-8")
    return out / "replay.html", next(act.t_start for act in done.episode.acts if act.text)


def test_what_is_said_has_its_script_its_language_and_latin_letters(reader, page_of_words):
    path, said_s = page_of_words
    page = reader.open(path, f"#t={said_s + 0.2:.2f}")
    said = page.locator(".bubble .said")
    assert said.inner_text() == "“مرحبًا، Dr Okafor.”"
    assert said.get_attribute("lang") == "ar"
    assert page.locator(".bubble .latin").inner_text() == "Marhaban, Dr Okafor."


def test_the_facts_of_a_wording_stand_with_the_reasons(reader, page_of_words):
    path, said_s = page_of_words
    page = reader.open(path, f"#t={said_s:.2f}")
    page.locator(".sentence", has_text="say(johanna)").first.click()
    facts = page.locator(".card .wordings li")
    assert facts.inner_text() == "greet, ar, Arab, neutral: مرحبًا، {name}. (reviewed by nobody)"
