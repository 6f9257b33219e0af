"""What happens to an episode is told at its time: in the account, the trace, the summary and the page."""

from __future__ import annotations

import re

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from places import HALL

import comity as front_door
from comity.output.run_folder import RunFolder
from comity.replay.episode_data import episode_data
from comity.simulation.walks import WALK_M, walks
from comity_sim2d import Frames

ONCE = settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
WHEN = st.integers(0, 200).map(lambda tenths: tenths / 10)
FAULTS = st.sampled_from(
    (
        "fault: wheel stuck, for_s: 4",
        "fault: speech fails, for_s: 2",
        "fault: sensor blind, for_s: 1",
        "fault: person walks off, person: anna",
        "fault: planner fails",
        "fault: leaf raises, leaf: docked?",
    )
)
CHANGES = st.sampled_from(
    (
        "person: anna, says: {conversational_distance: 1.3}",
        "person: anna, situation: {posture: seated}",
        "emergency_stop_s: 1",
    )
)


def written(kind: str, each: list[tuple[float, str]]) -> str:
    return f"{kind}:\n" + "".join(f"  - {{at_s: {at_s}, {what}}}\n" for at_s, what in each) if each else ""


@ONCE
@given(
    faults=st.lists(st.tuples(WHEN, FAULTS), max_size=3),
    changes=st.lists(st.tuples(WHEN, CHANGES), max_size=3),
)
def test_every_fault_and_change_up_to_the_end_is_told_at_its_time(faults, changes, here):
    (here / "visit.scenario.yaml").write_text(HALL + written("faults", faults) + written("changes", changes))
    episode = front_door.run("visit.scenario.yaml")
    end_s = max(event.t for event in episode.events)
    told = [one for one in episode.disturbances if one.kind != "walk"]
    due = sorted(at_s for at_s, _ in (*faults, *changes) if at_s <= end_s)
    assert [one.t for one in told] == [min(t for t in ticks(end_s) if t >= at_s - 1e-9) for at_s in due]
    assert sum(one.kind == "fault" for one in told) == sum(at_s <= end_s for at_s, _ in faults)
    assert all(one.end_s is None or one.t <= one.end_s for one in told)


def ticks(end_s: float) -> list[float]:
    return [round(k * 0.05, 6) for k in range(round(end_s / 0.05) + 1)]


@ONCE
@given(faults=st.lists(st.tuples(WHEN, FAULTS), max_size=3))
def test_an_attempt_is_repeated_where_the_trace_has_a_failure_with_something_after_it(faults, here, comity):
    (here / "visit.scenario.yaml").write_text(HALL + written("faults", faults))
    answer = comity("run", "visit.scenario.yaml", "--json").json
    events = comity("trace", answer["episode"], "--events", "--json").json["events"]
    for action in answer["repeated"]:
        mine = [event for event in events if event["node"] == action["node"]]
        failed = [
            event["t"] for event in mine[:-1] if event["status"] == "failure" or event["halt"] == "timed_out"
        ]
        assert [one["t"] for one in action["failed"]] == failed
        assert action["attempts"] == len(failed) + 1 > 1
    if not faults:
        assert answer["repeated"] == answer["disturbances"] == []


def test_the_summary_tells_the_fault_and_the_second_attempt(comity):
    out = comity("run", "wheel-sticks").out
    told = out[out.index("What happened on the way") :].split("\n\n")[0]
    assert "wheel stuck for 6 s" in told
    assert "Navigate_to_user(guest) was tried twice" in told


def test_a_walk_stands_in_the_trace_from_its_first_step_on(comity):
    answer = comity("run", "guest-walks-off", "--out", "run", "--json").json
    trace = comity("trace", "run", "--events", "--between", 0.5, 4.9)
    lines = [line for line in trace.out.splitlines() if re.match(r"t= *\d", line)]
    assert [(line.split()[1], line.split()[2]) for line in lines] == [("1.00", "change:"), ("1.00", "walk:")]
    assert comity("trace", "run", "--json").json["disturbances"] == answer["disturbances"]
    about = comity("trace", "run", "--node", "friend", "--json").json
    assert [one["about"] for one in about["disturbances"]] == ["friend"]  # nearer than she likes
    assert about["events"]


@given(
    spans=st.lists(st.tuples(st.integers(30, 90), st.integers(10, 60)), max_size=4),
    speed_m_s=st.floats(0.7, 1.5),
)
def test_walks_are_the_spans_in_which_somebody_moves(spans, speed_m_s):
    """A rest of 1.5 s or more, a walk of half a second or more, and so on."""
    moves = [moving for rest, walk in spans for moving in [False] * rest + [True] * walk] + [False] * 30
    x = np.cumsum([0.0, *(speed_m_s * 0.05 * moving for moving in moves)])
    poses = np.stack([np.stack([x * 0, x * 0, x * 0], axis=1), np.stack([x, x * 0, x * 0], axis=1)], axis=1)
    frames = Frames(("robot", "ann"), (0.3, 0.2), np.arange(len(x)) * 0.05, poses)
    found = [(one.t, one.end_s) for one in walks(frames, ["ann"])]
    ends = np.cumsum([length for pair in spans for length in pair])
    expected = [(ends[2 * i] * 0.05, ends[2 * i + 1] * 0.05) for i in range(len(spans))]
    assert np.allclose(found, expected) if spans else found == []
    assert speed_m_s * 0.5 >= WALK_M


def test_the_page_holds_every_disturbance_at_its_time(comity, here):
    answer = comity("run", "guest-walks-off", "--out", "run", "--json").json
    assert episode_data(RunFolder(here / "run"))["account"]["disturbances"] == answer["disturbances"] != []
