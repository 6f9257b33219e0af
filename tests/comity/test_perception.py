"""Nobody is greeted in a way that they do not perceive, and who does not hear is approached within view."""

from __future__ import annotations

from datetime import date

import pytest
from hypothesis import given
from hypothesis import strategies as st

import comity
from comity.parameters.perception import hears, perceiving, sees
from comity.people.profile import Profile
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain import Circumstances, greetings, ruled_out, sides
from comity_executor.memory.meeting import NO_GESTURE
from comity_fis import InputError

CULTURES = ("DEU", "Arab countries", "JPN", "SWE", None)
MODALITIES = ("verbal", "gestural", "both", None)
GESTURES = ("nod", "wave", "bow", None)
SCENARIO = """schema_version: 1
name: two
place: {{width_m: 8, height_m: 6}}
robot: {{at_m: [1, 3]}}
people:
  anna: {{at_m: [5, 3], facing_deg: {facing}, profile: {{name: anna, culture: {culture}, {sense}}}}}
goals: [{{greet: anna}}]
"""


@given(
    culture=st.sampled_from(CULTURES),
    modality=st.sampled_from(MODALITIES),
    gesture=st.sampled_from(GESTURES),
    hearing=st.booleans(),
    seeing=st.booleans(),
    carries=st.sampled_from([None, "a tray"]),
    noisy=st.booleans(),
)
def test_a_greeting_that_is_possible_can_be_perceived(**case):
    """Whatever the culture, the wishes and the moment are."""
    wishes = {"greeting_modality": case["modality"], "greeting_gesture": case["gesture"]}
    settings = {name: wish for name, wish in wishes.items() if wish is not None}
    try:
        values = comity.infer({"culture": case["culture"], "settings": settings})
    except InputError:
        return  # a gesture in words alone cannot be wished for
    now = Circumstances(
        hears=case["hearing"], sees=case["seeing"], robot_carries=case["carries"], noisy=case["noisy"]
    )
    for greeting in greetings(values, now):
        speaks, shows = greeting.modality != "gestural", greeting.gesture != NO_GESTURE
        assert (speaks and case["hearing"]) or (shows and case["seeing"])
    if not (case["hearing"] or case["seeing"]):
        assert greetings(values, now) == ()
        assert all("neither hear nor see" in reason for reason in ruled_out(values, now).values())


@given(
    culture=st.sampled_from(CULTURES),
    posture=st.sampled_from(["standing", "seated"]),
    rulebook=st.sampled_from(["bruno2017", "evidence"]),
)
def test_who_does_not_hear_is_approached_within_view(culture, posture, rulebook):
    """Within 60 degrees of where they face, from every side that the plan may choose."""
    profile = {"culture": culture, "hearing": "deaf", "posture": posture}
    values = comity.infer(profile, rulebook=rulebook)
    assert abs(values["approach_direction"].number) <= 60.0
    assert all(abs(side.bearing_deg) <= 60.0 for side in sides(values).values())
    assert values["approach_direction"].desirability.height(60.1, 90.0) == 0.0


def test_a_side_that_they_asked_for_stays():
    values = comity.infer({"hearing": "deaf", "settings": {"approach_direction": 80.0}})
    assert values["approach_direction"].number == 80.0


@pytest.mark.parametrize("word", ["impaired", "hearing aid", "glasses", "good", None])
def test_other_words_exclude_nothing(word):
    profile = Profile(name="anna", hearing=word, sight=word)
    assert hears(profile, None)
    assert sees(profile, None)
    values = comity.infer("german_woman")
    assert perceiving(values, profile, None) is values


def test_what_a_person_hears_may_have_a_date():
    profile = Profile.model_validate(
        {"name": "anna", "hearing": [{"value": "good", "from": 1990}, {"value": "none", "from": 2020}]}
    )
    assert hears(profile, date(2010, 1, 1))
    assert not hears(profile, date(2021, 1, 1))


@pytest.mark.parametrize(
    ("sense", "acts"),
    [("hearing: deaf", {"gesture"}), ("sight: blind", {"words"}), ("gender: female", set())],
)
@pytest.mark.parametrize("culture", ["DEU", "Arab countries"])
@pytest.mark.parametrize("facing", [0, 90, 180])
def test_in_an_episode_everybody_gets_what_they_perceive(here, sense, acts, culture, facing):
    path = here / "one.scenario.yaml"
    path.write_text(SCENARIO.format(sense=sense, culture=culture, facing=facing), encoding="utf-8")
    (visit,) = comity.run(path).visits
    assert visit.outcome == "greeted"
    done = {"words" if act == "utter" else "gesture" for act in visit.greeting}
    assert acts <= done
    if "hearing" in sense:
        assert abs(visit.docked_at.bearing_deg) <= 60.5


def test_that_no_act_reaches_somebody_is_said_with_what_to_do(here, comity):
    path = here / "one.scenario.yaml"
    text = SCENARIO.format(sense="hearing: none, sight: none", culture="DEU", facing=0)
    path.write_text(text, encoding="utf-8")
    prepared = prepare(load_scenario(str(path)))
    assert "neither hear nor see" in prepared.asked.unreachable["anna"]
    assert any("let a person go instead" in note for note in prepared.values["anna"].notes)


def test_a_robot_does_not_go_to_somebody_whom_none_of_its_acts_reaches(here, comity):
    """The other is greeted; of the one it is said why, and the robot does not come as if it did any good."""
    path = here / "one.scenario.yaml"
    text = SCENARIO.format(sense="hearing: none, sight: none", culture="DEU", facing=0)
    text = text.replace("people:", "people:\n  ben: {at_m: [2, 5], facing_deg: 270}")
    path.write_text(text.replace("goals: [", "goals: [{greet: ben}, "), encoding="utf-8")
    said = comity("run", "one.scenario.yaml", "--out", "run", "--no-pictures")
    assert said.code == 1
    told = " ".join(said.out.split())
    assert "no act that is shipped reaches them" in told
    assert "let a person go instead" in told
    steps = comity("plan", "one.scenario.yaml", "--json").json["steps"]
    assert {person for step in steps for person in step["people"]} == {"ben"}
