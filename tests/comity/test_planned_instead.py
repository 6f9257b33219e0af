"""Where the plan takes something else than what was inferred, that and its reason are told everywhere."""

from __future__ import annotations

import pytest

ROOM = """\
schema_version: 1
name: hall
place: {width_m: 8, height_m: 6}
robot: {at_m: [1, 1]}
people:
  mira: {profile: mira.profile.yaml, at_m: [5.5, 3.5], facing_deg: 180}
goals: [{greet: mira}]
"""
MIRA = "schema_version: 1\nname: mira\nculture: SWE\nrobot_experience: high\nsettings: {%s}\n"


@pytest.fixture
def told(here, comity):
    """What `comity run --json` says of Mira with a wish, and the trace of it."""

    def run(settings: str):
        (here / "hall.scenario.yaml").write_text(ROOM, encoding="utf-8")
        (here / "mira.profile.yaml").write_text(MIRA % settings, encoding="utf-8")
        answer = comity("run", "hall.scenario.yaml", "--json").json
        return answer["visits"][0], answer

    return run


def test_a_wish_for_a_gesture_leaves_the_words_and_the_plan_says_that_it_takes_both(told, comity) -> None:
    visit, answer = told("greeting_gesture: nod")
    (one,) = visit["planned_instead"]
    assert (one["parameter"], one["inferred"], one["planned"]) == ("greeting_modality", "verbal", "both")
    assert "the gesture asked for" in one["because"]
    assert visit["greeting"] == ["say", "nod"]
    events = comity("trace", answer["episode"], "--events", "--json").json["events"]
    texts = [cause["text"] for event in events if event["node"] == "say(mira)" for cause in event["because"]]
    assert "greeting_modality both, planned in the place of verbal (culture)" in texts


def test_a_wish_for_words_leaves_the_gesture_as_it_was_inferred(told) -> None:
    """Words alone take no gesture: nothing else than what was inferred is planned."""
    visit, answer = told("greeting_modality: verbal")
    assert visit["greeting"] == ["say"]
    assert visit["planned_instead"] == []
    both, _ = told("greeting_modality: both")
    assert both["greeting"] == ["say", answer["values"]["mira"]["parameters"]["greeting_gesture"]["value"]]


def test_nothing_is_told_where_the_plan_takes_what_was_inferred(comity) -> None:
    answer = comity("run", "two-visits", "--json").json
    assert [visit["planned_instead"] for visit in answer["visits"]] == [[], []]
