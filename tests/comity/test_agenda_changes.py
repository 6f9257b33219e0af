"""Changes in the middle of visits with more than a greeting: what was done stays, the rest is planned."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache

import pytest
import yaml

from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity.simulation.happenings import EmergencyStopPressed
from comity.system import library

TICK_S = 0.05
PLANS = ("rebound", "replanned", "not_replanned")
CHANGES = {
    "anna wants more room": {"person": "anna", "says": {"conversational_distance": 1.3}},
    "anna wants another side": {"person": "anna", "says": {"approach_direction": 60}},
    "anna wants another gesture": {"person": "anna", "says": {"greeting_gesture": "bow"}},
    "omar wants more room": {"person": "omar", "says": {"conversational_distance": 1.3}},
    "anna moves": {"person": "anna", "moves_to_m": [6.2, 3.4], "facing_deg": 180},
    "omar moves": {"person": "omar", "moves_to_m": [1.5, 1.2], "facing_deg": 20},
}
PICKED_S, SAYS_S, SAID_S, GIVEN_S, WAITS_S = 11.0, 20.0, 21.45, 23.95, 25.0
"""In the undisturbed visit: the tea is in the hands, the message is under way and over, the tea is given."""


@cache
def tea_visit():
    """The shipped one, with somebody who resumes after a stop."""
    file = load_scenario("tea-visit")
    limits = file.scenario.limits.model_copy(update={"resumes": True})
    return prepare(replace(file, scenario=file.scenario.model_copy(update={"limits": limits})))


def carried_out(prepared, *happenings):
    live = LiveEpisode(prepared, happenings=happenings)
    live.run()
    return live.so_far()


@cache
def undisturbed():
    return carried_out(tea_visit())


@pytest.fixture
def changed(here):
    """The tea visit with one change, or several."""

    def run(*changes: dict, **more):
        written = yaml.safe_load(library.shipped("scenario")["tea-visit"].read_text())
        for key in ("expect", "matrix"):
            del written[key]
        (here / "tea.scenario.yaml").write_text(yaml.safe_dump({**written, "changes": list(changes), **more}))
        return carried_out(prepare(load_scenario("tea.scenario.yaml")))

    return run


def done(episode) -> Counter:
    """The acts that came to their end: what was done, for whom, with which words or things."""
    return Counter((act.act, act.person, act.text, act.thing) for act in episode.acts if not act.stopped)


def of_plans(episode):
    return [event for event in episode.events if event.status in PLANS]


def check_all_is_done_once(episode) -> None:
    """Everything in its order; nothing that came to its end is done again; the tea is fetched once."""
    assert episode.outcome == "success"
    acts = done(episode)
    for person in ("anna", "omar"):
        words = [text for act, whom, text, _ in acts.elements() if (act, whom) == ("say", person)]
        assert len(words) == len(set(words))
    gestures = Counter((act, whom) for act, whom, text, thing in acts.elements() if text is thing is None)
    assert max(gestures.values()) <= 2  # a greeting and a farewell
    assert acts["pick_up", "kitchen", None, "tea"] == acts["hand_over", "anna", None, "tea"] == 1
    for visit in episode.visits:
        times = [deed.done_s for deed in visit.agenda]
        assert None not in times
        assert times == sorted(times)


@pytest.mark.parametrize("at_s", [PICKED_S, SAYS_S, WAITS_S])
@pytest.mark.parametrize("change", ["anna wants another side", "omar wants more room"])
def test_a_change_in_the_middle_of_a_visit_repeats_nothing(changed, change, at_s):
    episode = changed({"at_s": at_s, **CHANGES[change]})
    check_all_is_done_once(episode)
    assert [event.status for event in of_plans(episode)] in (["rebound"], ["replanned"])


@pytest.mark.study
@pytest.mark.parametrize("at_s", range(1, 46, 2))
@pytest.mark.parametrize("change", CHANGES)
def test_whatever_changes_whenever_repeats_nothing(changed, change, at_s):
    episode = changed({"at_s": at_s, **CHANGES[change]})
    check_all_is_done_once(episode)
    assert "not_replanned" not in [event.status for event in of_plans(episode)]


def test_a_wish_in_mid_visit_binds_new_numbers_and_the_robot_steps_back_at_once(changed):
    episode = changed({"at_s": WAITS_S, **CHANGES["anna wants more room"]})
    (event,) = of_plans(episode)
    assert event.status == "rebound"
    assert "finds nothing cheaper" in event.because[-1].text
    anna = episode.visits[0]
    assert anna.wanted.distance_m == pytest.approx(1.3)
    assert anna.docked_at.distance_m == pytest.approx(1.3, abs=0.02)


def test_a_new_plan_has_what_is_left_and_keeps_what_is_in_the_hands(changed):
    """With the tea in the hands there is nothing to fetch; after the greeting there is nobody to greet."""
    before = changed({"at_s": PICKED_S, **CHANGES["anna wants another side"]})
    assert [event.status for event in of_plans(before)] == ["replanned"]
    fetched = [step for step in before.steps if step.action == "Fetch"]
    assert len(fetched) == 1, "the first plan's"
    later = changed({"at_s": SAYS_S, **CHANGES["anna wants another side"]})
    texts = [cause.text for cause in of_plans(later)[0].because]
    assert (
        "instead Reach_user(robot, anna, left)" in texts or "instead Reach_user(robot, anna, right)" in texts
    )
    assert not [text for text in texts if "Greet_person(robot, anna" in text or "Fetch(robot, anna" in text]


def test_a_pause_is_not_waited_for_from_the_start_again(changed):
    """Omar moves while Anna's pause is under way; it is over when it would have been."""
    waited = changed({"at_s": WAITS_S, **CHANGES["omar wants more room"]})
    pause = next(deed for deed in waited.visits[0].agenda if deed.action == "Wait")
    usual = next(deed for deed in undisturbed().visits[0].agenda if deed.action == "Wait")
    assert pause.done_s == pytest.approx(usual.done_s, abs=4 * TICK_S)


def test_a_wish_that_full_hands_rule_out_leaves_the_choices_and_says_why(changed):
    episode = changed({"at_s": PICKED_S + 3.0, **CHANGES["anna wants another gesture"]})
    check_all_is_done_once(episode)
    (event,) = of_plans(episode)
    assert "the choices stay as planned" in event.because[-1].text
    assert "bow: the robot carries tea" in event.because[-1].text


def test_what_somebody_asks_for_is_done_however_often_they_change_their_mind(changed):
    """No cap of new plans holds against it."""
    sides = [{"at_s": at_s, "person": "anna", "says": {"approach_direction": side}} for at_s, side in MINDS]
    episode = changed(*sides, limits={"replans": 1})
    check_all_is_done_once(episode)
    kinds = [event.status for event in of_plans(episode)]
    assert kinds.count("replanned") == len(MINDS)
    assert episode.visits[0].docked_at.bearing_deg == pytest.approx(MINDS[-1][1], abs=5)


MINDS = [(1.0, 60), (2.0, 0), (3.0, 60), (4.0, 0)]


def test_somebody_who_cannot_be_finished_with_is_said_to_be_unfinished(changed):
    """Anna turns to the corner and asks to be approached from the front; Omar is visited all the same."""
    corner = {"at_s": SAYS_S, "person": "anna", "moves_to_m": [6.75, 5.25], "facing_deg": 45}
    front = {"at_s": SAYS_S, "person": "anna", "says": {"approach_direction": 0}}
    episode = changed(corner, front)
    anna, omar = episode.visits
    assert (anna.outcome, omar.outcome) == ("unfinished", "greeted")
    assert episode.outcome == "partial"
    assert anna.failure


@pytest.mark.parametrize("end_s", [10.1, SAID_S, 22.53, GIVEN_S, 27.95])
def test_what_ends_in_the_tick_of_an_emergency_stop_is_not_repeated(end_s):
    """Taking up, telling, offering, handing over, words of farewell."""
    stopped = carried_out(tea_visit(), EmergencyStopPressed(end_s, 1.0))
    assert done(stopped) == done(undisturbed())


@pytest.mark.study
@pytest.mark.parametrize("later", range(-3, 4))
@pytest.mark.parametrize("act", range(10))
def test_whatever_ends_around_the_tick_of_an_emergency_stop_is_not_repeated(act, later):
    end_s = undisturbed().acts[act].t_end
    stopped = carried_out(tea_visit(), EmergencyStopPressed(end_s + later * TICK_S, 1.0))
    assert done(stopped) == done(undisturbed())
