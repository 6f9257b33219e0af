"""Why the robot was nearer to a person than they like is said, in run, trace and page."""

from __future__ import annotations

import json

import pytest

from comity_sim2d.metrics import intrusion_of

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
    "asks-to-pass": ("yumi", "it had asked yumi to let it pass"),
    "guest-walks-off": ("friend", "it went on from its place before friend"),
    "comity-bench-1/starts-next-to-someone": ("neighbour", "it went on from where it started"),
    "comity-bench-1/walks-at-the-robot": ("kim", "kim came to it"),
    "comity-bench-1/full-waiting-room": ("a", "its place before guest is as near"),
}


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
    from comity.report.episodes.nearness import SHORTEST_S, nearness_answers

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
