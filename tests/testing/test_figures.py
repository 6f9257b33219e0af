"""What stands behind a figure that is out of its bounds: what had a part in it, and nothing else."""

from __future__ import annotations

import re

import numpy as np
import pytest

from comity.testing.amounts.course import MOTIONS
from comity.testing.collection.cases import claims_in
from comity.testing.trials.attempt import attempted
from comity_executor import node_names
from comity_sim2d.metrics import clearances_m

FAULTS = """\
faults:
  - {at_s: 2, fault: wheel stuck, for_s: 6}
  - {at_s: 13, fault: speech fails, for_s: 5}
  - {at_s: 24, fault: wheel stuck, for_s: 7}
"""


@pytest.fixture
def reasons(judge):
    """The reasons of the only sentence, which fails."""

    def of(sentence: str, more: str = FAULTS, **others: object) -> str:
        (verdict,) = judge(sentence, more=more, **others)
        first = verdict.failures[0].finding
        return "\n".join((first.got, *first.because))

    return of


@pytest.mark.parametrize(
    ("sentence", "named"),
    [
        ("docking_time of host at most 5 s", ["Navigate_to_user(host)"]),
        ("duration at most 5 s", ["Navigate_to_user(host)", "say(host)", "say(host)", "guest"]),
        ("path_length at most 1 m", ["Navigate_to_user(host)", "guest"]),
        ("overshoot of host is 9 m", ["Navigate_to_user(host)"]),
        ("plan_cost at most 1 m", []),
        ("min_clearance at least 3 m", []),
        ("plan is unproven", []),
    ],
)
def test_a_fault_is_named_behind_a_figure_that_it_had_a_part_in(sentence, named, reasons):
    """One that came afterwards has none, nor have broken words in a way, or motions in a plan."""
    told = reasons(sentence)
    failed = re.findall(r"^failed .*$", told, re.M)
    for name in named:
        assert any(name in line for line in failed), (name, failed)
    assert all(any(name in line for name in named) for line in failed), failed
    assert named or "fault" not in told


def test_a_late_greeting_has_what_took_the_time_until_then_and_no_side(judge):
    """The wheel that sticks afterwards had no part in it."""
    (verdict,) = judge("host is greeted", more=FAULTS, room=in_a_hurry)
    (failure,) = verdict.failures
    told = "\n".join(failure.finding.because)
    assert re.search(
        r"visit     greeted at t=[\d.]+ s, [\d.]+ s later than its by_s\n(happened .*\n)+did ", told
    )
    assert "failed    Navigate_to_user(host) at t=" in told
    assert "speech fails" in told
    assert "t=24 s" not in told
    assert "desirability" not in told


def in_a_hurry(room: str) -> str:
    return room.replace("greet: host", "{greet: host, by_s: 17}")


@pytest.mark.parametrize(("at_s", "told"), [(3.0, False), (8.5, True)])
def test_words_that_nobody_spoke_when_speech_failed_are_no_reason(at_s, told, reasons):
    """On its way to the host the robot is silent."""
    fault = f"faults: [{{at_s: {at_s}, fault: speech fails, for_s: 4}}]\n"
    assert ("speech fails" in reasons("duration at most 5 s", more=fault)) is told


def test_who_walks_where_the_robot_goes_is_told_with_how_near_and_who_stays_or_is_visited_is_not(reasons):
    def walking(room: str) -> str:
        route = "walks: {route: [[4.6, 2.2], [2.0, 2.4]], speed_m_s: 0.4, loop: true}"
        return room.replace("[4.6, 2.2], facing_deg: 0", f"[4.6, 2.2], facing_deg: 0, {route}")

    assert "walks  " not in reasons("duration at most 5 s", more="")
    met = re.findall(r"^walks .*$", reasons("duration at most 5 s", more="", room=walking), re.M)
    assert len(met) == 1
    assert re.fullmatch(r"walks     sam has `walks`; sam was 0\.\d\d m from the robot at t=[\d.]+ s", met[0])


def test_an_earlier_attempt_is_told_without_its_fault_that_was_over(reasons):
    told = reasons("max_speed at most 0.1 m/s")
    assert re.search(r"^again     Navigate_to_user\(host\) failed at t=", told, re.M) or "fault" not in told
    assert "wheel stuck" not in told


def test_a_time_in_which_nothing_could_be_done_is_told(reasons):
    """Whoever walks into a corner is waited for; no action of the robot has that time."""
    goes = "changes: [{at_s: 0.5, person: guest, moves_to_m: [7.7, 0.4], facing_deg: -45}]\n"
    told = reasons("duration at most 20 s", more=goes + "limits: {patience_s: 12}\n")
    assert re.search(r"^waited    1[12]\.\d\d s from t=[\d.]+ s: ", told, re.M), told


@pytest.mark.parametrize(
    ("sentence", "said"),
    [("min_clearance at least 3 m", "to"), ("min_centre_distance at least 3 m", "to")],
)
def test_the_least_distance_is_told_with_whom_and_when(sentence, said, write, judge):
    (verdict,) = judge(sentence)
    got = verdict.failures[0].finding.got
    least, person, t = re.match(
        rf"([\d.]+) m {said} (\w+) at t=([\d.]+) s, [\d.]+ cm too little", got
    ).groups()
    (claim,) = claims_in(write(sentence))
    frames = attempted(claim.case).frames
    row = int(np.argmin(np.abs(frames.time_s - float(t))))
    gaps = clearances_m(frames)
    assert gaps[row, frames.entities.index(person) - 1] == gaps.min()
    assert f"goes by   conversational_distance of {person}" in "\n".join(verdict.failures[0].finding.because)
    assert float(least) == pytest.approx(gaps.min() + (0.45 if "centre" in sentence else 0.0), abs=5e-4)


def test_the_least_time_to_a_collision_and_the_greatest_speed_are_told_with_their_time(reasons):
    assert re.match(r"[\d.]+ s with \w+ at t=[\d.]+ s, ", reasons("min_time_to_collision at least 60 s"))
    assert re.match(r"[\d.]+ m/s at t=[\d.]+ s, ", reasons("max_speed at most 0.1 m/s"))


def test_the_longest_intrusion_is_told_with_whom_it_was_and_when_it_began(write, judge):
    """The way leads past marta, nearer than she likes."""
    sentence = "longest_intrusion at most 0.1 s"

    def room(text: str) -> str:
        return text.replace(
            "people:\n", "people:\n  marta: {profile: german_man, at_m: [2.6, 2.6], facing_deg: 270}\n"
        )

    (verdict,) = judge(sentence, room=room)
    length, person, t = re.match(
        r"([\d.]+) s beside (\w+) at t=([\d.]+) s, ", verdict.failures[0].finding.got
    ).groups()
    (claim,) = claims_in(write(sentence, room=room))
    frames = attempted(claim.case).frames
    gap = clearances_m(frames)[:, frames.entities.index(person) - 1]
    during = (frames.time_s >= float(t) - 1e-6) & (frames.time_s <= float(t) + float(length) + 1e-6)
    assert person == "marta"
    assert (gap[during] < 1.091).all()


def test_of_whom_a_fault_sends_off_it_is_told_where_they_went(reasons):
    off = "faults: [{at_s: 1, fault: person walks off, person: guest}]\n"
    told = reasons("walked of guest at most 1 cm", more=off)
    assert "walks     guest has the fault `person walks off` at t=1 s" in told


def test_motions_are_called_as_in_the_tree():
    assert set(MOTIONS) <= set(node_names())


HAPPENS = {
    "faults: [{at_s: 2, fault: wheel stuck, for_s: 1}]": "fault at t=2 s: wheel stuck for 1 s",
    "limits: {resumes: true}\nchanges: [{at_s: 2, emergency_stop_s: 3}]": (
        "the emergency stop was pressed at t=2 s for 3 s"
    ),
    "changes: [{at_s: 2, person: guest, moves_to_m: [7.0, 1.0]}]": "guest went to (7, 1) at t=2 s",
    "faults: [{at_s: 2, fault: person walks off, person: host}]": "fault at t=2 s: host walks off",
    "limits: {time_s: 6}": "the run was stopped: its limit `time_s` is 6 s",
}


@pytest.mark.parametrize("more", HAPPENS)
@pytest.mark.parametrize("sentence", ["duration at most 1 s", "path_length at most 1 cm"])
def test_what_happened_on_the_way_stands_behind_time_and_way_whether_or_not_it_failed(
    sentence, more, reasons
):
    assert f"happened  {HAPPENS[more]}" in reasons(sentence, more=f"{more}\n")


def test_what_happened_after_the_figure_has_no_part_in_it(reasons):
    assert "happened" not in reasons(
        "docking_time of host at most 1 s", more=FAULTS.replace("at_s: 2,", "at_s: 40,")
    )
    assert "happened" not in reasons("plan_cost at most 1 cm")


@pytest.mark.parametrize(("whom", "before"), [("host", []), ("guest", ["host"])])
def test_when_somebody_was_reached_has_the_steps_up_to_there(whom, before, reasons):
    """The plan goes on, to greet them and to others."""
    steps = re.findall(
        r"^step      (\w+)\(robot, (\w+)", reasons(f"docking_time of {whom} at most 1 s", more=""), re.M
    )
    greeted = [(action, name) for name in before for action in ("Reach_user", "Greet_person")]
    assert steps == [*greeted, ("Reach_user", whom)]


def test_who_walks_up_to_the_robot_is_named_behind_how_near_they_were(write, judge):
    def room(text: str) -> str:
        return text.replace(
            "people:\n", "people:\n  marta: {profile: german_man, at_m: [4.4, 4.8], facing_deg: 180}\n"
        )

    goes = "changes: [{at_s: 1, person: marta, moves_to_m: [2.2, 2.6]}]\n"
    sentence = "longest_intrusion of marta at most 0 s"
    (verdict,) = judge(sentence, more=goes, room=room)
    because = "\n".join(verdict.failures[0].finding.because)
    assert "walks     marta has `moves_to_m` at t=1 s" in because


def test_a_chosen_place_has_the_plan_by_which_it_was_chosen(reasons):
    asks = "changes: [{at_s: 2, person: host, says: {approach_direction: 80}}]\n"
    told = reasons("chosen_bearing of host between -10 and 10 deg", more=asks)
    assert re.search(r"^replanned at t=2\.\d+ s: host asked for approach_direction 80", told, re.M)
    assert "Reach_user(robot, host, left)" in told
    assert "Reach_user(robot, host, front)" not in told


def test_the_highest_speed_has_what_limits_speeds_and_no_distance(reasons):
    told = reasons("max_speed at most 0.1 m/s", more="")
    assert "limit     on its way at most 0.7 m/s, the robot's `max_speed_m_s`" in told
    assert "goes by   approach_speed of host" in told
    assert "conversational_distance" not in told


def test_many_failures_of_one_action_for_one_reason_are_one_line(reasons):
    told = reasons("duration at most 60 s", more="faults: [{at_s: 5, fault: speech fails, for_s: 100}]\n")
    (line,) = re.findall(r"^failed    say\(\w+\) .*$", told, re.M)[:1]
    assert re.search(r"and \d+ more times until t=[\d.]+ s: fault at t=5 s: speech fails", line)


def test_nobody_who_was_never_reached_has_figures_of_a_stop(reasons):
    told = reasons("stop_distance_error of host at most 10 m", more="limits: {time_s: 4}\n")
    assert told.startswith("none: nothing happened to measure it by")


@pytest.mark.parametrize("written", ["{cm:.1f} cm", "{mm:.0f} mm", "{m:.3f} m"])
@pytest.mark.parametrize("wish_m", [0.7, 0.825, 0.9, 1.1])
def test_a_number_is_what_it_is_in_whatever_unit_it_is_written(written, wish_m, judge):
    number = written.format(cm=100 * wish_m, mm=1000 * wish_m, m=wish_m)
    asks = f"changes: [{{at_s: 1, person: host, says: {{conversational_distance: {wish_m}}}}}]\n"
    (verdict,) = judge(f"conversational_distance of host is {number}", more=asks)
    assert verdict.passed


@pytest.mark.parametrize(
    "sentence", ["duration at most 9 s", "docking_time of guest at most 9 s", "mean_speed at least 1 m/s"]
)
def test_a_slow_robot_is_named_behind_what_took_long(sentence, reasons):
    """Not even its `approach_speed` is what it drives, which the rules would be blamed for."""
    slow = "limit     the robot drives at most 0.3 m/s everywhere, its `max_speed_m_s`"
    assert slow not in reasons(sentence, more="").splitlines()
    told = reasons(
        sentence, more="", room=lambda room: room.replace("[1.0, 1.0]", "[1.0, 1.0], max_speed_m_s: 0.3")
    )
    assert slow in told.splitlines()


def test_a_share_of_the_time_beside_visits_has_what_was_done_then(reasons):
    """The robot passes him on its way to the host; of his own visit nothing is said."""
    told = reasons("compliance_share of guest at least 1", more="", room=past_the_guest)
    assert re.search(r"^t=[\d.]+ s  Navigate_to_user\(host\) running", told, re.M)
    assert "Reach_user(robot, guest" not in told.split("goes by")[0]


def past_the_guest(room: str) -> str:
    """He stands beside the way to the host, who cannot wait."""
    here = room.replace("at_m: [6.8, 1.2], facing_deg: 180", "at_m: [2.6, 2.6], facing_deg: 270")
    return here.replace("- greet: host", "- {greet: host, priority: 9}")


def test_the_longest_intrusion_of_all_is_that_of_one_person(judge):
    crowded = {"more": "", "room": past_the_guest}
    (verdict,) = judge("longest_intrusion at most 0.1 s", **crowded)
    (failure,) = verdict.failures
    length_s, person = re.match(r"([\d.]+) s beside (\w+) at t=", failure.finding.got).groups()
    (verdict,) = judge(f"longest_intrusion of {person} is {length_s} s", **crowded)
    assert verdict.passed, verdict.failures
