"""Why the robot was nearer to a person than they like is said, in run, trace and page."""

from __future__ import annotations

import json

import numpy as np
import pytest
from room_study import prepared

from comity.live_episode import execute
from comity.report.episodes.nearness import nearness_answers
from comity.simulation.manoeuvres import MotionLog, MotionSpan
from comity_sim2d.metrics import clearances_m, intrusion_of

NARROW = """schema_version: 1
name: narrow
place:
  width_m: 8
  height_m: 6.5
  furniture: [{name: shelves, box_m: [3.5, 1.9, 1.0, 4.6]}]
robot: {at_m: [1, 1]}
people:
  guest: {at_m: [7, 1], facing_deg: 180}
  reader: {profile: german_man, at_m: [4, 0.3], facing_deg: 90}
goals: [{greet: guest}]
"""

REASONS = {
    "asks-to-pass": ("yumi", "yumi came to it, after it had asked yumi to let it pass"),
    "guest-walks-off": (
        "friend",
        "it went on from its place before friend, inside friend's personal space",
    ),
    "comity-bench-1/starts-next-to-someone": ("neighbour", "it went on from where it started"),
    "comity-bench-1/walks-at-the-robot": ("kim", "kim came to it"),
    "comity-bench-1/full-waiting-room": ("a", "its place before guest is as near"),
}

ROUTES = ("no route", "a route", "its goal", "personal space")
"""What is said of routes only, which keep 0.30 m from people who stand."""


def nearness(answer):
    return [one for one in answer["disturbances"] if one["kind"] == "nearness"]


@pytest.mark.parametrize("scenario", REASONS)
def test_each_reason_is_told_where_it_holds(scenario, comity, here):
    person, reason = REASONS[scenario]
    (told,) = nearness(comity("run", scenario, "--out", "run", "--json").json)
    assert told["about"] == person
    assert told["text"].endswith(f": {reason}")


def test_run_trace_and_page_say_how_near_and_why(comity, here):
    (here / "narrow.scenario.yaml").write_text(NARROW, encoding="utf-8")
    summary = comity("run", "narrow.scenario.yaml", "--out", "run").out
    (told,) = nearness(json.loads((here / "run" / "run.json").read_text()))
    assert told["text"] == "robot 0.85 m from reader, who likes 1.09 m: no route keeps clear of everybody"
    assert told["text"] in " ".join(summary.split())
    assert told["text"] in " ".join(comity("trace", "run", "--events").out.split())
    assert told["text"] in (here / "run" / "replay.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("scenario", ["two-visits", "passers-by", "reception", "changes-her-mind"])
def test_every_intrusion_that_is_measured_has_its_reason(scenario):
    import comity
    from comity.report.episodes.nearness import SHORTEST_S

    episode = comity.run(scenario)
    known = episode.known
    intrusion = intrusion_of(episode.frames, known)
    stays = {
        (stay.person, stay.start_s)
        for person in intrusion.own
        for stay in intrusion.stays(episode.frames, person)
        if stay.length_s > SHORTEST_S
    }
    told = list(nearness_answers(episode))
    assert {(one.about, one.t) for one in told} == stays
    assert len(told) == len(stays)
    assert [one.t for one in told] == sorted(one.t for one in told)


def gaps_m(episode, person):
    """Between the robot and a person, in every frame."""
    return clearances_m(episode.frames)[:, episode.frames.entities.index(person) - 1]


def test_who_makes_the_robot_give_way_is_the_reason_that_it_comes_near_to_another_person():
    episode = execute(prepared("mix", 7), seed=7)
    assert "it gave way to fay" in {one.text.split(": ", 1)[1] for one in nearness_answers(episode)}


def test_where_nothing_else_explains_it_is_told_where_the_robot_went_and_who_walked_near_it():
    """Its routes led round people who walk; Dot passed it."""
    episode = execute(prepared("mix", 105), seed=105)
    (told,) = (one for one in nearness_answers(episode) if (one.about, round(one.t, 1)) == ("ben", 12.8))
    _, _, walked = told.text.partition(": it came nearer by itself on its way to eli, as ")
    assert "dot" in walked
    assert "ben" not in walked
    assert walked.endswith(" walked near it")


@pytest.mark.parametrize("room", [("stand", 0), ("walk", 4), ("walk", 6), ("walk", 16), ("walk", 18)])
def test_the_reason_for_a_stay_holds_in_the_frames(room):
    """A place is as near as the robot came, a person who came moved, a route keeps 0.30 m."""
    kind, seed = room
    episode = execute(prepared(kind, seed), seed=seed)
    time_s, docked = episode.frames.time_s, {one.person: one.docked_s for one in episode.visits}
    told = list(nearness_answers(episode))
    assert told
    for one in told:
        gap_m, reason = gaps_m(episode, one.about), one.text.split(": ", 1)[1]
        within = (time_s >= one.t - 1e-3) & (time_s <= one.end_s + 1e-3)
        nearest_m = gap_m[within].min()
        if any(words in reason for words in ROUTES):
            assert nearest_m >= 0.27
        elif "where it started" in reason or "its place before" in reason:
            at_s = next((at for name, at in docked.items() if f"before {name}" in reason), 0.0)
            assert gap_m[np.searchsorted(time_s, at_s - 1e-3)] <= nearest_m + 0.1
        elif "came to it" in reason:
            walked = episode.frames.of(one.about)[within, :2]
            assert np.ptp(walked, axis=0).max() > 0.0


def test_a_motion_goes_on_while_goal_and_manoeuvre_stay_the_same():
    log = MotionLog()
    for tick, report in enumerate(("1.2 m of way left", "giving way to bo", "giving way to bo", "stands")):
        log.note(report, (1.0, 2.0), float(tick), float(tick + 1))
    assert log.spans == [
        MotionSpan(0.0, 1.0, (1.0, 2.0), ""),
        MotionSpan(1.0, 3.0, (1.0, 2.0), "it gave way to bo"),
        MotionSpan(3.0, 4.0, (1.0, 2.0), ""),
    ]
