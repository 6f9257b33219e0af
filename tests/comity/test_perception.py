"""Nobody is greeted in a way that they do not perceive, and who does not hear is approached within view."""

from __future__ import annotations

import math
import re
from datetime import date

import pytest
from hypothesis import given
from hypothesis import strategies as st

import comity
from comity.parameters.perception import NOT_HEARING, NOT_SEEING, NOTE_OF_SAY, hears, perceiving, sees
from comity.people.profile import Profile
from comity.planning.companies import companies
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain import Circumstances, Spot, greetings, ruled_out, sides
from comity_domain.choices.greeting import NO_GESTURE
from comity_fis import InputError
from comity_sim2d import Person, Pose, RobotBody, Room, RouteMap, Scene, docked

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


@given(asked=st.floats(0.0, 90.0), hearing=st.sampled_from(["none", "good"]))
def test_a_direction_that_they_asked_for_is_kept_or_nobody_comes(asked, hearing):
    """It is never bent: where it is out of view of who does not hear, no side is left, and a note says so."""
    values = comity.infer(
        {"hearing": hearing, "settings": {"approach_direction": asked}}, rulebook="evidence"
    )
    assert values["approach_direction"].number == asked
    within = hearing == "good" or asked <= 60.0
    assert bool(sides(values)) == within
    assert any("approach_direction" in note for note in values.notes) != within


ROOM = """schema_version: 1
name: room
place: {{width_m: 6.0, height_m: 4.5}}
robot: {{at_m: [0.8, 0.9], facing_deg: 90}}
people:
  per: {{profile: {{name: per, {profile}}}, at_m: [{x}, 2.5], facing_deg: 0}}
goals: [{{greet: per}}]
limits: {{time_s: 60}}
"""


@pytest.mark.parametrize(
    ("profile", "x", "reason"),
    [
        ("hearing: none", 5.6, ("60 deg of where they face", "does not hear", "outer wall")),
        (
            "hearing: none, settings: {approach_direction: 90}",
            3.0,
            ("hearing: none with approach_direction: 90", "Ask for `approach_direction: 60`"),
        ),
        (
            "hearing: none, settings: {greeting_modality: verbal}",
            3.0,
            ("hearing: none with greeting_modality: verbal", "Ask for `greeting_modality: both`"),
        ),
        (
            "sight: none, settings: {greeting_modality: gestural}",
            3.0,
            ("sight: none with greeting_modality: gestural", "Ask for `greeting_modality: both`"),
        ),
    ],
)
def test_what_cannot_be_had_is_an_unmet_goal_with_the_reason(here, profile, x, reason):
    path = here / "room.scenario.yaml"
    path.write_text(ROOM.format(profile=profile, x=x), encoding="utf-8")
    prepared = prepare(load_scenario(str(path)), rulebook="evidence")
    assert all(words in prepared.asked.unreachable["per"] for words in reason)
    assert comity.run(path, rulebook="evidence").visits == ()


@pytest.mark.parametrize("x", [5.0, 5.2, 5.3, 5.4, 5.5, 5.6])
def test_before_a_wall_too_the_robot_stands_within_view_or_does_not_come(here, x):
    path = here / "room.scenario.yaml"
    path.write_text(ROOM.format(profile="hearing: none", x=x), encoding="utf-8")
    visits = comity.run(path, rulebook="evidence").visits
    assert len(visits) == (x <= 5.3)
    assert all(abs(visit.docked_at.bearing_deg) <= 60.5 for visit in visits)


@pytest.mark.parametrize(
    "words",
    [
        ("sight=none", "greeting=gestural"),
        ("hearing=deaf", "greeting=verbal"),
        ("hearing=none", "direction=80"),
    ],
)
def test_a_wish_that_can_never_be_met_is_refused_before_it_is_kept(comity, words):
    name = words[1].replace("=", "-")
    said = comity("profile", "set", name, words[0])
    assert said.code == 0
    said = comity("profile", "set", name, words[1])
    assert said.code == 2
    assert "take one of the two back" in " ".join(said.err.split())
    kept = comity("profile", "export", name, "--json").json["profile"]
    assert "settings" not in kept


@given(facing_deg=st.floats(-179.0, 179.0))
def test_with_a_group_too_they_are_greeted_within_view_only(facing_deg):
    ben = Person("ben", 3.5, 4.0, math.radians(facing_deg))
    scene = Scene(Room.rectangle(8.0, 6.0), RobotBody(1.0, 1.0, 0.0), (Person("anna", 3.0, 3.0, 0.0), ben))
    spots = {Spot("anna", "front"): (4.2, 3.0), Spot("ben", "front"): (4.5, 4.5)}
    bearing = abs(docked(Pose(4.2, 3.0, 0.0), scene.robot.radius_m, ben).bearing_deg)
    for limits, widest in (({}, 90.0), ({"ben": 60.0}, 60.0)):
        (company,) = companies({"two": ("anna", "ben")}, RouteMap(scene), spots, limits)
        assert (Spot("anna", "front") in company.overlooks) == (bearing <= widest)


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
    done = {"words" if act == "say" else "gesture" for act in visit.greeting}
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


@pytest.mark.parametrize(("sense", "is_noted"), [("hearing: deaf", True), ("sight: blind", False)])
def test_that_something_is_said_to_who_does_not_hear_is_noted(here, comity, sense, is_noted):
    path = here / "one.scenario.yaml"
    text = SCENARIO.format(sense=sense, culture="DEU", facing=180)
    goals = "goals: [{greet: anna}, {say: The drill starts now, to: anna}]"
    path.write_text(text.replace("goals: [{greet: anna}]", goals), encoding="utf-8")
    planned = comity("plan", "one.scenario.yaml", "--json").json
    assert (f"anna: {NOTE_OF_SAY}" in planned["notes"]) == is_noted
    ran = comity("run", "one.scenario.yaml", "--json", "--out", "run", "--no-pictures").json
    assert (NOTE_OF_SAY in ran["values"]["anna"]["notes"]) == is_noted


@pytest.mark.parametrize(
    ("fact", "said", "words"),
    [
        ("hearing", "deaf since birth", NOT_HEARING),
        ("hearing", "cannot hear", NOT_HEARING),
        ("sight", "legally blind", NOT_SEEING),
    ],
)
def test_a_synonym_gets_a_note_with_the_words_that_count(fact, said, words):
    (note,) = [note for note in comity.infer({fact: said}).notes if note.startswith(f"{fact}: ")]
    assert words <= set(re.findall(r"[a-z]+", note))
    assert f"write `none` for no {fact}" in note


def test_in_a_run_the_words_that_count_are_said_whoever_said_what(here):
    """It tells nothing of who said something of hearing or sight: that is not kept in a run."""
    notes = []
    for sense in ("hearing: cannot hear", "sight: legally blind", "mobility: wheelchair"):
        path = here / "one.scenario.yaml"
        path.write_text(SCENARIO.format(sense=sense, culture="DEU", facing=0), encoding="utf-8")
        notes.append(prepare(load_scenario(str(path))).values["anna"].notes)
    assert notes[0] == notes[1] == notes[2]
    assert any("deafblind" in note and "blind" in note for note in notes[0])


@pytest.mark.parametrize(
    ("at_first", "then", "clash"),
    [
        ("hearing: none", "says: {approach_direction: 85}", "hearing: none with approach_direction: 85"),
        (
            "settings: {approach_direction: 85}",
            "situation: {hearing: none}",
            "hearing: none with approach_direction: 85",
        ),
        (
            "hearing: none",
            "says: {greeting_modality: verbal}",
            "hearing: none with greeting_modality: verbal",
        ),
    ],
)
def test_what_is_said_on_the_way_counts_too_and_is_not_waited_for(here, at_first, then, clash):
    path = here / "room.scenario.yaml"
    change = f"changes: [{{at_s: 2, person: per, {then}}}]\n"
    path.write_text(ROOM.format(profile=at_first, x=4.5) + change, encoding="utf-8")
    episode = comity.run(path, rulebook="evidence")
    (visit,) = episode.visits
    assert visit.outcome == "unreached"
    assert visit.docked_at is None
    assert any(clash in str(revision) for revision in episode.revisions)
    assert episode.outcome == "failed"
