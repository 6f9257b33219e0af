"""Parameters that are on reach a behaviour and change something in the world."""

from __future__ import annotations

from datetime import date
from importlib.resources import files

import pytest
import yaml

from comity import run
from comity.episode import Episode
from comity.parameters.values import infer_for
from comity.people.profile import load_profile
from comity.system.library import shipped
from comity_fis import load_rulebook
from comity_sim2d import ActEvent

SCENARIO = files("comity").joinpath("scenarios", "first-visits", "johanna.scenario.yaml")


@pytest.fixture
def meet(here):
    """Run `johanna` with the rulebook `evidence` for somebody."""

    def met(profile: dict, *, situation: dict | None = None) -> Episode:
        scenario = yaml.safe_load(SCENARIO.read_text(encoding="utf-8"))
        scenario["people"]["johanna"] |= {
            "profile": {"schema_version": 1, "name": "somebody", **profile},
            "situation": situation or {},
        }
        path = here / "meeting.scenario.yaml"
        path.write_text(yaml.safe_dump(scenario), encoding="utf-8")
        episode = run(path, rulebook="evidence")
        assert episode.outcome == "success"
        return episode

    return met


def act(episode: Episode, name: str) -> ActEvent:
    return next(act for act in episode.acts if act.act == name)


def distance_m(episode: Episode) -> float:
    return episode.visits[0].docked_at.distance_m


@pytest.mark.parametrize("scenario", ["two-visits", "seated-visit", "reception"])
def test_shipped_scenarios_run_with_the_rulebook_evidence(scenario):
    assert run(scenario, rulebook="evidence").outcome == "success"


def test_the_account_of_a_run_tells_what_was_said_and_done_and_how(comity):
    said = comity("run", "johanna", "--rulebook", "evidence", "--json")
    assert said.code == 0, said.err
    utterance, gesture = said.json["visits"][0]["acts"]
    assert (utterance["act"], utterance["volume"], utterance["rate"], utterance["amplitude"]) == (
        "say",
        0.5,
        1.0,
        None,
    )
    assert utterance["text"].startswith("Hello, Johanna.")
    assert (gesture["act"], gesture["amplitude"], gesture["text"]) == ("nod", 0.5, None)


@pytest.mark.parametrize("profile", shipped("profile"))
def test_every_shipped_profile_has_a_value_for_everything(profile):
    evidence = load_rulebook("evidence")
    inference = infer_for(load_profile(profile), evidence, at=date(2026, 1, 1))
    assert set(inference.parameters) == set(evidence.parameters)


def test_a_profile_that_wants_to_be_met_formally_says_so_to_the_rulebook():
    """A profile's `formality` is the rulebook's occasion, and opens the handshake with consent."""
    inference = infer_for(load_profile("german_host"), load_rulebook("evidence"))
    assert inference.inputs["occasion"] == "formal"
    assert inference["greeting_gesture"].word == "handshake"


def test_slow_speech_takes_longer(meet):
    normal, slow = (act(meet({"settings": {"speech_rate": rate}}), "say") for rate in (1.0, 0.5))
    assert slow.rate == 0.5
    assert slow.text == normal.text
    assert slow.t_end - slow.t_start == pytest.approx(2 * (normal.t_end - normal.t_start))


def test_however_slow_speech_is_it_is_not_broken_off(meet):
    facts = {
        "settings": {"speech_rate": 0.5, "formality": 1.0},
        "culture": "DEU",
        "languages": ["ara"],
    }
    utterance = act(meet(facts), "say")
    assert not utterance.stopped


def test_who_is_met_from_afar_is_spoken_to_louder(meet):
    near, far = (
        act(meet({}, situation={"familiarity": familiarity}), "say") for familiarity in ("close", "stranger")
    )
    assert far.volume > near.volume + 0.1


def test_a_strangers_visit_ends_farther_off_than_a_friends(meet):
    near, far = (meet({}, situation={"familiarity": familiarity}) for familiarity in ("close", "stranger"))
    assert distance_m(far) - distance_m(near) == pytest.approx(0.38, abs=0.03)


def test_manner_and_words_do_not_follow_from_culture_while_their_findings_are_weak(meet):
    told = [meet({"culture": culture}) for culture in ("DEU", "JPN", "Arab countries")]
    assert {act(one, "say").text for one in told} == {"Hello, Johanna."}
    assert {act(one, "say").volume for one in told} == {0.5}


def test_words_follow_directness_formality_style_and_language(meet):
    said = {
        "explicit": act(meet({"settings": {"verbal_directness": 0.9}}), "say").text,
        "implicit": act(meet({"settings": {"verbal_directness": 0.1}}), "say").text,
        "informal": act(meet({"settings": {"formality": 0.1}}), "say").text,
        "rhetorical": act(
            meet(
                {"languages": ["ara"], "settings": {"rhetorical_style": 0.9}},
                situation={"familiarity": "stranger"},
            ),
            "say",
        ).text,
        "to a close person": act(
            meet(
                {"languages": ["ara"], "settings": {"rhetorical_style": 0.9}},
                situation={"familiarity": "close"},
            ),
            "say",
        ).text,
        "plain": act(meet({}), "say").text,
        "formal": act(meet({"settings": {"formality": 0.9}}), "say").text,
    }
    assert said == {
        "explicit": "Hello, Johanna. What can I do for you?",
        "implicit": "Hello, Johanna. I am here, should anything be needed.",
        "informal": "Hi, Johanna.",
        "rhetorical": "مرحبًا، Johanna. تشرّفت بلقائكم.",
        "to a close person": "مرحبًا، Johanna.",
        "plain": "Hello, Johanna.",
        "formal": "Good day, Johanna.",
    }


def test_a_rulebook_without_manners_leaves_the_normal_ones():
    episode = run("johanna")
    utterance = act(episode, "say")
    assert (utterance.volume, utterance.rate, utterance.text) == (0.5, 1.0, "Hello, Johanna.")


def test_the_trace_tells_why_the_words_were_chosen(meet):
    causes = [cause.text for event in meet({"languages": ["ara"]}).events for cause in event.because]
    assert any(text.startswith("greeting_language ara") for text in causes)
    assert "if language is ara then greeting_language is ara" in causes


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("rules: [0, 1]\n    ask: [0, 1]\n    safe: {at_least: 0, at_most: 1}", "decibel", "voice_volume as"),
        ("categories: [eng, ara, deu, jpn, swe]\n    neutral: eng", "klingon", "greeting_language as"),
    ],
)
def test_a_rulebook_that_means_something_else_is_refused_before_the_world_moves(
    comity, here, old, new, expected
):
    text = files("comity_fis").joinpath("rulebooks", "evidence.yaml").read_text(encoding="utf-8")
    assert old in text
    if new == "klingon":
        text = text.replace(old, "categories: [tlh, eng, ara, deu, jpn, swe]\n    neutral: tlh", 1)
    else:
        start = text.index("  voice_volume:")
        body = text[start:].replace(old, "rules: [0, 90]\n    ask: [0, 90]", 1)
        text = text[:start] + body.replace("    neutral: 0.5\n", "    neutral: 60\n", 1)
    (here / "other.yaml").write_text(text, encoding="utf-8")
    said = comity("run", "johanna", "--rulebook", "other.yaml")
    assert said.code == 2
    assert expected in said.err
    assert not (here / "runs").exists()
