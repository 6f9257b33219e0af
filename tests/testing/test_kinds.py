"""Every kind of expectation: it holds where it should, and fails for the stated reason where it should."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from rooms import FIRST_LINE, scenario

from comity.monitoring.measuring import known_of
from comity.testing.amounts.moments import intrusion
from comity.testing.collection.cases import claims_in
from comity.testing.kinds import KINDS
from comity.testing.measuring.measured import measured
from comity.testing.measuring.safety import dangers
from comity.testing.runner.telling import failure_text
from comity.testing.trials.attempt import attempted
from comity.testing.trials.visits import visit_of
from comity.testing.verdict import Failure, judged
from comity_fis import InputError
from comity_sim2d import measure

PAPER = "matrix: {people: [host], profiles: paper}\n"

# A sentence that holds, one of the same kind that does not, and what is said about that.
PAIRS = {
    "metric": [
        (
            "docking_error at most 1 cm",
            "docking_error of host at most 0.01 mm",
            "docking_error of host at most",
            "too much",
        ),
        (
            "longest_intrusion of host at most 1 s",
            "longest_intrusion at most 0.1 s",
            "at most 0.10 s",
            "s beside sam at t=",
        ),
        ("duration at most 60 s", "duration at most 7 s", "duration at most 7.00 s", "too much"),
        (
            "min_clearance at least 30 cm",
            "min_clearance at least 2 m",
            "min_clearance at least 2.000 m",
            "too little",
        ),
        ("path_length at most 12 m", "path_length at most 3 m", "path_length at most 3.000 m", "too much"),
        (
            "conversational_distance of host between 60 and 70 cm",
            "conversational_distance of guest between 60 and 70 cm",
            "conversational_distance of guest from 0.600 m to 0.700 m",
            "1.091 m, 39.1 cm too much",
        ),
        (
            "conversational_distance of host is 64 cm within 1 cm",
            "approach_speed of host is 0.6 m/s within 0.01 m/s",
            "approach_speed of host from 0.590 m/s to 0.610 m/s",
            "too little",
        ),
    ],
    "state": [("greeting_gesture of host is nod", "host is unreached", "host unreached", "greeted")],
    "event": [
        (
            "Dock_to_user is halted because 'docked?' at least once",
            "say is halted because 'docked?' at least once",
            "say is halted because of “docked?” at least once",
            "never, of 0 in all",
        ),
        ("say is never halted", "Dock_to_user is never halted", "Dock_to_user is halted never", "twice"),
        (
            "docked? succeeds exactly twice",
            "docked? succeeds at least 3 times",
            "docked? succeeds at least 3 times",
            "twice",
        ),
        ("docked? fails at most twice", "docked? fails at most once", "docked? fails at most once", "twice"),
        ("Give_up never succeeds", "nod never succeeds", "nod succeeds never", "once"),
        ("Dock_to_user never fails", "docked? never fails", "docked? fails never", "twice"),
        (
            "docked? succeeds exactly once per person",
            "docked? succeeds exactly twice per person",
            "docked?(host) succeeds exactly twice",
            "once",
        ),
        ("replans at most once", "replans exactly once", "replans exactly once", "never"),
        (
            "updates parameters at most once",
            "updates parameters at least once",
            "updates parameters at least once",
            "never",
        ),
        (
            "docked? succeeds because 'distance 0.64 m'",
            "docked? succeeds because 'distance 0.64 m' at least twice",
            "docked? succeeds because of “distance 0.64 m” at least twice",
            "once, of 2 in all",
        ),
        (
            "docked? fails because 'is not in 0.63..0.65' exactly once",
            "docked? fails because 'a wheel is stuck'",
            "docked? fails because of “a wheel is stuck” at least once",
            "never, of 2 in all",
        ),
        (
            "Dock_to_user is halted because 'conversational_distance' exactly twice",
            "say is halted because 'the person spoke'",
            "say is halted because of “the person spoke” at least once",
            "never, of 0 in all",
        ),
        (
            "replans because 'guest moved' at most once",
            "replans because 'guest moved'",
            "replans because of “guest moved” at least once",
            "never, of 0 in all",
        ),
        (
            "finds no other plan because 'wall' at most once",
            "finds no other plan because 'wall'",
            "finds no other plan because of “wall” at least once",
            "never, of 0 in all",
        ),
    ],
    "duration": [
        (
            "nod lasts 1.5 s",
            "nod lasts 1 s within 0.1 s",
            "nod for from 0.90 s to 1.10 s",
            "nod(host) for 1.50 s, from t=",
        ),
        ("nod lasts at least 1 s", "nod lasts at most 1 s", "nod for at most 1.00 s", "0.5 s too much"),
    ],
    "order": [
        (
            "visits in this order: host, guest",
            "visits in this order: guest, host",
            "guest, then host",
            "host, then guest",
        )
    ],
    "approach": [
        (
            "approach to host from the front",
            "approach from the left or right",
            "left or right of host",
            "front, at",
        )
    ],
    "greeting": [
        (
            "greeting of host contains words and a nod and no touch",
            "greeting of host contains a bow",
            "bow for host",
            "words and nod",
        )
    ],
    "hearing": [
        ("host hears 'Hello, Host'", "host hears 'Good morning'", "“Good morning” to host", "“Hello, Host.”"),
        (
            "host never hears 'Good morning'",
            "host never hears 'Hello'",
            "never “Hello” to host",
            "“Hello, Host.”",
        ),
    ],
    "decided_by": [
        (
            "conversational_distance of host is decided by culture",
            "conversational_distance of host is decided by setting",
            "conversational_distance of host decided by setting",
            "culture",
        ),
        (
            "conversational_distance of host is decided because 'gender is female → close (rule 1, 0.84)'",
            "conversational_distance of guest is decided because 'gender is female → close'",
            "conversational_distance of guest decided because of “gender is female → close”",
            "culture: individualism is LC2 and gender is male → far (rule 4, 0.99)",
        ),
        (
            "conversational_distance of host is decided by culture because 'gender is female → close'",
            "conversational_distance of host is decided by setting because 'gender is female → close'",
            "decided by setting because of “gender is female → close”",
            "culture: ",
        ),
    ],
    "alternative": [
        (
            "visiting host from the left would cost at least 90 cm more",
            "visiting guest from the right would cost at least 1 m more",
            "visiting guest from the right to cost at least 1.000 m more",
            "0.330 m more, 67 cm too little",
        ),
        (
            "visiting host with a wave would cost 1.58 m more",
            "visiting host with a bow would cost 3 m more within 1 m",
            "visiting host with bow to cost from 2.000 m to 4.000 m more",
            "5.430 m more, 143 cm too much",
        ),
        (
            "visiting guest with a handshake is excluded because 'touch consent'",
            "visiting host with a handshake is excluded because 'carries tea'",
            "visiting host with handshake excluded because of “carries tea”",
            "it is excluded: it requires that touch consent is given",
        ),
    ],
    "difference": [
        (
            "differs between german_man and arab_woman: conversational_distance, by at least 20 cm",
            "differs between german_man and arab_woman: conversational_distance, by at least 50 cm",
            "conversational_distance at least 50 cm apart",
            "1.091 m for german_man, 0.640 m for arab_woman: 45.1 cm apart",
        )
    ],
    "sameness": [
        (
            "same for all: safety, outcome, order, approach_direction",
            "same for all: greeting_gesture",
            "one greeting_gesture for all",
            "nod for arab_woman, arab_man; wave for german_woman, german_man",
        )
    ],
}
EVERY = [pair for pairs in PAIRS.values() for pair in pairs]


def test_every_kind_is_tried():
    assert list(PAIRS) == list(KINDS)


@pytest.fixture(scope="module")
def failures(tmp_path_factory) -> dict[str, Failure]:
    """All true and all wrong sentences in one scenario: what fails, by sentence (the first of each)."""
    path = tmp_path_factory.mktemp("kinds") / "room.scenario.yaml"
    sentences = [*(wrong for _, wrong, *_ in EVERY), *(true for true, *_ in EVERY)]
    path.write_text(scenario(*sentences, more=PAPER), encoding="utf-8")
    as_written, *_, across = claims_in(path)
    assert as_written.case.profile == "arab_woman"
    found = [*judged(as_written).failures, *judged(across).failures]
    return {failure.text: failure for failure in reversed(found)}


@pytest.mark.parametrize("true", [true for true, *_ in EVERY])
def test_a_sentence_that_is_true_holds(true, failures):
    assert true not in failures


@pytest.mark.parametrize("at", range(len(EVERY)), ids=[wrong for _, wrong, *_ in EVERY])
def test_a_sentence_that_is_wrong_fails_for_the_stated_reason(at, failures):
    """With its own line, what was expected, what came, and a cause."""
    _, wrong, expected, got = EVERY[at]
    failure = failures[wrong]
    assert failure.where.line == FIRST_LINE + at
    assert expected in failure.finding.expected
    assert got in failure.finding.got
    assert failure.finding.because


@pytest.mark.parametrize(
    ("choice", "got"),
    [
        ("from the front", "front is what the plan has for host"),
        ("with a handshake", "it is excluded: "),
        ("with 'one by one'", "no such choice at any step"),
    ],
)
def test_what_is_planned_already_or_no_choice_has_no_price(judge, choice, got):
    (verdict,) = judge(f"visiting host {choice} would cost at least 1 cm more")
    (failure,) = verdict.failures
    assert failure.finding.got.startswith(got)
    assert any("Reach_user(robot, host, front)" in line for line in failure.finding.because)


def test_without_a_word_about_it_the_outcome_has_to_be_success(judge):
    """A scenario without `expect` is a test, too."""
    walled = "place: {width_m: 8.0, height_m: 6.0, walls_m: [[[5.4, 0], [5.4, 6]]]}"
    (verdict,) = judge(room=lambda room: room.replace("place: {width_m: 8.0, height_m: 6.0}", walled))
    (failure,) = verdict.failures
    assert failure.text == "outcome is success"
    assert failure.finding.got == "partial"
    assert "no free and reachable place before guest" in " ".join(failure.finding.because)


def test_what_comes_too_often_for_a_reason_is_shown_and_so_is_what_came_for_others(judge):
    """Everybody has a distance of their own: the host's is no reason behind the docking to the guest."""
    often, seldom = (
        "docked? succeeds because '%s' at most 0 times",
        "docked? succeeds because '%s' at least 9 times",
    )
    (verdict,) = judge(often % "distance 0.64 m", seldom % "distance 0.64 m")
    too_many, too_few = (failure.finding.because for failure in verdict.failures)
    assert any("docked?(host)" in line for line in too_many)
    assert not any("docked?(guest)" in line for line in too_many)
    assert any("docked?(guest)" in line for line in too_few)
    assert not any("docked?(host)" in line for line in too_few)


def test_the_words_of_a_reason_may_be_those_with_which_a_failure_tells_it(judge):
    """A rule has its strength behind it there."""
    (verdict,) = judge(
        "docked? succeeds because 'gender is female then conversational_distance is close (0.84)'",
        "docked? succeeds because 'gender is female then conversational_distance is close (0.8)'",
    )
    assert [failure.text[-6:] for failure in verdict.failures] == ["(0.8)'"]


def test_a_repeated_gesture_is_noticed(write):
    """Planted: nothing that ships repeats one. The count is per person: one nod for each is none too many."""
    (claim,) = claims_in(write("nod succeeds at most once per person"))
    trial, expectation = attempted(claim.case), claim.expectations[0].meaning
    nods = [event for event in trial.events if (event.node, event.status) == ("nod(host)", "success")]
    again = replace(trial, events=(*trial.events, *nods))
    assert list(expectation.judge(trial)) == []
    (finding,) = expectation.judge(again)
    assert (finding.expected, finding.got) == ("nod(host) succeeds at most once", "twice")


def test_a_robot_that_comes_too_near_is_a_danger(write):
    """Planted: the frames are moved towards the person, as the judge believes frames alone."""
    (claim,) = claims_in(write())
    trial = attempted(claim.case)
    frames = trial.frames
    assert list(dangers(trial)) == []
    poses = frames.poses.copy()
    poses[-1, 0, :2] = poses[-1, 2, :2] - [0.5, 0.0]
    planted = replace(trial, frames=replace(frames, poses=poses))
    limits = [danger.limit for danger in dangers(planted)]
    assert "0.3 m from guest" in limits
    assert "at most 0.5 m/s within 1.5 m of guest" in limits


def test_who_walks_up_to_the_robot_is_no_danger_that_it_brings_about(write):
    """Planted: the person, and not the robot, is moved in the last frame, in which the robot is at rest."""
    (claim,) = claims_in(write())
    trial = attempted(claim.case)
    frames = trial.frames
    poses = frames.poses.copy()
    poses[-1, 2, :2] = poses[-1, 0, :2] + [0.5, 0.0]
    planted = replace(trial, frames=replace(frames, poses=poses))
    assert list(dangers(planted)) == []


@pytest.mark.parametrize("stays", [True, False])
def test_a_robot_that_stays_beside_somebody_after_the_visit_does_not_leave_them(write, stays):
    """Planted: instead of going to the next it stays to the end, 5 cm within her distance."""
    (claim,) = claims_in(write())
    trial = attempted(claim.case)
    frames, visit = trial.frames, visit_of(trial.visits, "host")
    later, host = frames.time_s > visit.greeted_s, frames.entities.index("host")
    poses = frames.poses.copy()
    poses[later, 0, :2] = poses[0, host, :2] + [0.59 + frames.radius_m[0] + frames.radius_m[host], 0.0]
    planted = replace(trial, frames=replace(frames, poses=poses))
    stay = intrusion(planted if stays else trial).longest(frames, "host")
    assert (stay is not None and stay.length_s > 1.0) == stays


@pytest.mark.parametrize(("gap_m", "intrudes"), [(0.42, True), (0.46, False)])
def test_a_passer_by_is_intruded_on_as_the_metrics_have_it(write, gap_m, intrudes):
    """Planted: somebody of whom nothing is known is so far from the robot all the time."""
    (claim,) = claims_in(write(more="passers_by: {count: 1}\n"))
    trial = attempted(claim.case)
    frames = trial.frames
    i, whole_s = frames.entities.index("passer-by 1"), float(frames.time_s[-1])
    poses = frames.poses.copy()
    poses[:, i, :2] = poses[:, 0, :2] + [0.0, gap_m + frames.radius_m[0] + frames.radius_m[i]]
    planted = replace(trial, frames=replace(frames, poses=poses))
    known = known_of(planted.prepared, planted.visits, planted.events, revisions=(), told=())
    planted = replace(planted, metrics=measure(planted.frames, known))
    stay = intrusion(planted).longest(frames, "passer-by 1")
    assert (stay is not None and stay.length_s == whole_s) == intrudes
    assert (measured(claim.case, planted).intrusion_s == whole_s) == intrudes


PAST_ANNA = """\
schema_version: 1
name: past-anna
place: {width_m: 12, height_m: 3.0}
robot: {at_m: [0.8, 1.5]}
people:
  anna: {profile: arab_man, at_m: [4, 1.0], facing_deg: 180}
  bob: {profile: arab_man, at_m: [10.5, 1.5], facing_deg: 180}
goals: [{greet: anna}, {greet: bob}]
expect: [longest_intrusion of anna at most 1 s]
"""


def test_who_is_passed_more_closely_after_their_visit_is_intruded_on(tmp_path):
    """On its way to somebody else, the robot takes leave of nobody."""
    (tmp_path / "past-anna.scenario.yaml").write_text(PAST_ANNA)
    (claim,) = claims_in(tmp_path / "past-anna.scenario.yaml")
    (failure,) = judged(claim).failures
    assert "beside anna" in failure.finding.got


def test_a_wrong_side_has_the_reasons_of_the_plan_by_which_it_was_chosen(judge):
    """Who moves is planned for anew, and then from another side than by the first plan."""
    moves = "changes:\n  - {at_s: 1, person: guest, moves_to_m: [6.8, 5.0], facing_deg: 90}\n"
    verdicts = judge("approach to guest from the front", more=moves)
    (failure,) = [failure for verdict in verdicts for failure in verdict.failures]
    steps = [line for line in failure.finding.because if line.startswith("step      Reach_user(robot, guest")]
    assert steps[0].endswith(", of a new plan")
    assert any("guest moved by" in line for line in failure.finding.because)


@pytest.mark.parametrize(
    ("change", "fails", "holds", "because"),
    [
        (
            "person: guest, moves_to_m: [6.8, 5.0]",
            "never replans",
            ("replans exactly once", "never updates parameters"),
            "guest moved",
        ),
        (
            "person: host, says: {conversational_distance: 0.9}",
            "never updates parameters",
            ("updates parameters exactly once", "never replans"),
            "host asked for conversational_distance 0.9",
        ),
    ],
)
def test_another_plan_is_counted_and_so_are_new_numbers_for_the_same(judge, change, fails, holds, because):
    """Whoever walks off is planned for again; whoever asks for something else gets it by the same steps."""
    (verdict,) = judge(fails, *holds, more=f"changes:\n  - {{at_s: 2, {change}}}\n")
    (failure,) = verdict.failures
    assert failure.text == fails
    assert failure.finding.got == "once"
    assert because in " ".join(failure.finding.because)


def test_a_gesture_that_the_rules_no_longer_give_is_missed_and_does_not_hide_what_else_fails(judge):
    """Another rule may give it: the word is known, and other sentences are judged, too."""
    (verdict,) = judge("bow lasts 1.5 s", "duration at most 2 s")
    lasting, late = verdict.failures
    assert lasting.finding.got == "the tree has no bow"
    because = " ".join(lasting.finding.because)
    assert "Greet_person(robot, host, both, nod)" in because
    assert "goes by   greeting_gesture of host nod: individualism is LC1 → nod (rule 19, 0.84)" in because
    assert late.text == "duration at most 2 s"


WALLED_IN = "place: {width_m: 8.0, height_m: 6.0, walls_m: [[[2.0, 0], [2.0, 2.0]], [[2.0, 2.0], [0, 2.0]]]}"


def _walled_in(room: str) -> str:
    return room.replace("place: {width_m: 8.0, height_m: 6.0}", WALLED_IN)


def test_where_nobody_can_be_reached_what_is_said_of_their_nodes_is_judged_with_the_rest(judge):
    """A wall that somebody adds takes the nodes out of the tree: that is no slip of the pen."""
    sentences = (
        "host is greeted",
        "Navigate_to_user never fails",
        "Dock_to_user(guest) succeeds at least once",
        "Dock_to_user is halted because 'docked?'",
        "docked? succeeds because 'distance'",
        "Greet_person lasts 1.5 s",
    )
    (verdict,) = judge(*sentences, room=_walled_in)
    failed = {failure.text: failure.finding for failure in verdict.failures}
    assert failed["host is greeted"].got == "unreachable"
    assert sentences[1] not in failed
    for sentence in sentences[2:]:
        assert "no free and reachable place before guest" in " ".join(failed[sentence].because)
    assert failed["Greet_person lasts 1.5 s"].got == "the tree has no Greet_person"


@pytest.mark.parametrize(
    ("node", "near"),
    [("Navigat_to_user", "Navigate_to_user"), ("docked(gast)", "docked"), ("nood", "nod")],
)
def test_a_slip_in_a_node_that_no_tree_has_is_refused_where_nobody_is_reached_too(node, near, judge):
    with pytest.raises(InputError) as refused:
        judge(f"'{node} never fails'", room=_walled_in)
    assert f"Did you mean '{near}'?" in refused.value.remedy


@pytest.mark.parametrize(
    "sentence", ["docking_error of host at most 0.001 mm", "approach to host from the back"]
)
def test_a_stop_is_told_with_the_docking_that_ended_there_and_not_with_a_later_one(judge, sentence):
    more = "  - greet: host\n  - {say: Tea?, to: host}\n  - take_leave: host\n"
    (verdict,) = judge(sentence, room=lambda room: room.replace("  - greet: host\n", more))
    (failure,) = verdict.failures
    stood = re.search(r"at (t=[\d.]+ s)", failure.finding.got)[1]
    assert f"{stood}  docked?(host) success" in failure.finding.because


def test_each_run_that_lasted_otherwise_is_told_with_how_it_ended_itself(judge):
    stopped = "changes:\n  - {at_s: 1, emergency_stop_s: 2}\n  - {at_s: 4, emergency_stop_s: 1}\n"
    stopped += "limits: {resumes: true}\ngoals:\n"
    (verdict,) = judge(
        "Navigate_to_user(host) lasts 60 s", room=lambda room: room.replace("goals:\n", stopped)
    )
    ended = [failure.finding for failure in verdict.failures]
    assert len(ended) >= 3
    for finding in ended[:2]:
        took, start, _ = map(float, re.findall(r"[\d.]+(?= s)", finding.got))
        assert finding.because[0].startswith(f"t={start + took:.2f} s  Navigate_to_user(host) halted")
        assert "the emergency stop is pressed" in finding.because[1]
    assert not any("emergency" in line for line in ended[-1].because)


def test_a_node_with_children_lasts_from_running_to_its_result_or_its_halt(judge):
    """Greet_person ends by itself, Reach_user when the robot has docked."""
    (verdict,) = judge("Greet_person(host) lasts 1 s", "Reach_user(host) lasts 1 s")
    greet, reach = (failure.finding for failure in verdict.failures)
    assert greet.got.startswith("Greet_person(host) for 1.50 s, from t=")
    assert "from t=0.00 s" in reach.got
    assert "Reach_user(host) halted" in reach.because[0]


def test_behind_a_figure_stands_what_was_planned_and_where_time_and_way_went(write):
    """What failed on the way, too; and what is behind several figures is told once."""
    stuck = "faults:\n  - {at_s: 2, fault: wheel stuck, for_s: 8}\n"
    (claim,) = claims_in(write("duration at most 10 s", "path_length at most 2 m", more=stuck))
    verdict = judged(claim)
    reasons = verdict.failures[0].finding.because
    assert reasons[0].startswith("step      Reach_user(robot, host, front), cost 3")
    told = (
        "goes by   conversational_distance of host 0.640 m: individualism is LC1 and gender is female → close"
    )
    assert any(line.startswith(f"{told} (rule 1, 0.84), → medium (rule 2, 0.17)") for line in reasons)
    did = [line for line in reasons if line.startswith("did")]
    ways = [float(way) for line in did for way in re.findall(r" and (\S+) m", line)]
    assert sum(ways) > 7.0
    assert any(line.startswith("failed    Navigate_to_user(host) at t=7") for line in reasons)
    text = failure_text(claim, verdict.failures)
    assert text.count("Reach_user(robot, host, front)") == 1


def test_the_rule_for_somebody_who_is_passed_by_is_named_behind_time_way_and_price(write):
    """Sam is nobody's goal, and the way leads round him; a price hangs on where others want the robot."""
    sentences = (
        "duration at most 7 s",
        "path_length at most 3 m",
        "visiting guest from the left would cost at least 9 m more",
    )
    (claim,) = claims_in(write(*sentences))
    late, long, cheap = (failure.finding.because for failure in judged(claim).failures)
    of_sam = (
        "goes by   conversational_distance of guest, sam 1.091 m: individualism is LC2 and gender is male"
    )
    assert any(line.startswith(of_sam) for line in late)
    assert any(line.startswith(of_sam) for line in long)
    assert any(line.startswith("goes by   conversational_distance of host 0.640 m") for line in cheap)


def test_a_parameter_behind_several_figures_is_told_once_in_a_text(write):
    (claim,) = claims_in(write("duration at most 7 s", "path_length at most 3 m", "plan_cost at most 1 m"))
    text = failure_text(claim, judged(claim).failures)
    assert text.count("conversational_distance of host 0.640 m") == 1
    assert text.count("greeting_gesture of guest") == 1


def test_whose_a_parameter_is_stands_beside_it(judge):
    (verdict,) = judge("conversational_distance at least 2 m")
    host, guest = verdict.failures
    assert host.finding.because[0].startswith("parameter conversational_distance of host 0.640 m")
    assert guest.finding.because[0].startswith("parameter conversational_distance of guest 1.091 m")


def test_the_plan_has_a_cost_and_a_gap_that_sentences_bound(judge):
    """In metres of way, and 0 where no plan costs less; the steps stand behind it."""
    (verdict,) = judge("plan_cost is 7.51 m within 1 cm", "plan_gap at most 0", "plan_cost at most 7 m")
    (failure,) = verdict.failures
    assert failure.finding.got == "7.510 m, 51 cm too much"
    assert failure.finding.because[0].startswith("step      Reach_user(robot, host, front), cost 315:")


def test_whether_a_plan_is_proven_is_told_with_its_cost_and_the_least_that_any_has(judge):
    (verdict,) = judge("plan is proven", "plan is unproven")
    (failure,) = verdict.failures
    assert (failure.text, failure.finding.got) == ("plan is unproven", "proven")
    assert "costs 7.51 m, none less than 7.51 m" in failure.finding.because[0]


def test_the_way_of_people_is_that_of_their_frames_and_nobody_is_left_out(judge):
    moves = "changes:\n  - {at_s: 2, person: sam, moves_to_m: [4.6, 3.2]}\n"
    wrong = ("walked of sam at most 90 cm", "walked of host at least 1 cm")
    (verdict,) = judge("walked of sam is 1 m within 2 cm", "walked is 1 m within 2 cm", *wrong, more=moves)
    sam, host = verdict.failures
    assert (sam.text, host.text) == wrong
    assert sam.finding.got.startswith("1.00")
    assert host.finding.got == "0.000 m, 1 cm too little"
    assert sam.finding.because[0] == "walks     sam has `moves_to_m` at t=2 s"
    assert any(line.startswith("did ") for line in sam.finding.because)
    (stays,) = host.finding.because
    assert stays.startswith("walks     host stays: the scenario has no `walks`")


def test_of_people_who_all_stay_it_is_told_that_they_do(judge):
    (verdict,) = judge("walked at least 1 m")
    (stay,) = verdict.failures[0].finding.because
    assert stay.startswith("walks     nobody walks: the scenario has no `walks`")


def test_when_and_where_the_robot_stood_before_somebody_is_a_number(judge):
    """The place that it chose last, which nobody barred, is the wanted one."""
    (verdict,) = judge(
        "docking_time of host between 5 and 10 s",
        "chosen_distance of host is 64 cm within 1 cm",
        "chosen_bearing of host is 0 deg within 1 deg",
        "docking_time of guest at most 10 s",
        "chosen_distance of guest at most 1 m",
    )
    late, far = verdict.failures
    assert late.finding.expected == "docking_time of guest at most 10.00 s"
    assert far.finding.got == "1.091 m, 9.1 cm too much"
    assert "Reach_user(robot, guest, front)" in " ".join(late.finding.because)


def test_a_choice_that_is_open_is_not_excluded(judge):
    (verdict,) = judge("visiting host with a wave is excluded")
    (failure,) = verdict.failures
    assert failure.finding.got == "it is not excluded"


NOTHING_TO_JUDGE = {
    "visiting guest with a dance would cost 3 m more": "a way to greet, or another choice of a plan",
    "visiting guest with a wav would cost 3 m more": "got 'wav'. Did you mean 'wave'?",
    "visiting guest with a nodd is excluded": "got 'nodd'. Did you mean 'nod'?",
    "visiting sam from the left would cost at least 1 cm more": "somebody whom the goals name",
    "visiting sam with a wave is excluded": "somebody whom the goals name",
    "docking_time of sam at most 3 s": "somebody whom the goals name",
    "docket? fails because 'distance'": "got 'docket?'. Did you mean 'docked?'?",
    "overshoot of sam at most 3 m": "somebody whom the goals name, got 'sam'",
    "greeting of sam contains no words": "somebody whom the goals name",
    "docking_error of sam at most 5 cm": "somebody whom the goals name",
    "approach to sam from the front": "somebody whom the goals name",
    "visits in this order: host, sam": "somebody whom the goals name",
    "sam is unreachable": "somebody whom the goals name",
    "e succeeds at least once": "a node of the behaviour tree, got 'e'",
    "Dock_to succeeds at least once": "a node of the behaviour tree, got 'Dock_to'",
    "greeting_gesture of guest is nood": "got 'nood'. Did you mean 'nod'?",
    "conversational_distance of host is near": "like `conversational_distance is 0.64 m within 0.01 m`.",
    "min_clearance is red": "a number: min_clearance is one, got 'red'. Write `min_clearance at most` or",
    "path_length of host at most 3 m": "path_length, which is of the whole run. Leave `of` out.",
    "'differs between arab_woman and german_man: greeting_gesture, by at least 20 cm'": "which is a word",
}


@pytest.mark.parametrize("sentence", NOTHING_TO_JUDGE)
def test_a_sentence_about_nothing_in_the_scenario_is_refused(sentence, write):
    """It would hold whatever happens, or fail without a word about its slip."""
    path = write(sentence, more="matrix: {people: [host], profiles: [arab_woman, german_man]}\n")
    claim = next(claim for claim in claims_in(path) if claim.expectations)
    with pytest.raises(InputError) as refused:
        judged(claim)
    assert NOTHING_TO_JUDGE[sentence] in str(refused.value)
    assert refused.value.where
    assert refused.value.where.line == FIRST_LINE


def test_a_node_is_named_up_to_its_bracket_or_with_it(judge):
    sentences = (
        "docked? succeeds twice",
        "docked?(host) succeeds once",
        "Dock_to_user is halted because 'docked?' exactly twice",
        "Dock_to_user is halted because 'docked?(host)' exactly once",
        "bow(host) never succeeds",
    )
    assert judge(*(each.replace("succeeds ", "succeeds exactly ") for each in sentences))[0].passed


def test_a_number_that_nothing_was_measured_by_is_a_failure(judge):
    walled = "place: {width_m: 8.0, height_m: 6.0, walls_m: [[[5.4, 0], [5.4, 6]]]}"
    (verdict,) = judge(
        "overshoot of guest at most 3 m",
        "outcome is partial",
        room=lambda room: room.replace("place: {width_m: 8.0, height_m: 6.0}", walled),
    )
    (failure,) = verdict.failures
    assert failure.finding.got == "none: nothing happened to measure it by"
    assert "no free and reachable place before guest" in " ".join(failure.finding.because)


def test_a_plain_number_is_told_without_a_unit(judge):
    (verdict,) = judge("touches at least 1")
    (failure,) = verdict.failures
    assert failure.finding.got == "0, 1 too little"


def test_who_is_no_goal_is_told_to_hear_only_that_they_are_in_the_way(judge):
    (verdict,) = judge("sam hears 'Hello'")
    (failure,) = verdict.failures
    assert failure.finding.got == "not a word"
    assert failure.finding.because[0].startswith("no goal names sam")


def test_a_number_without_within_is_told_with_the_digits_in_which_it_differs(judge):
    (verdict,) = judge("conversational_distance of host is 64 cm")
    (failure,) = verdict.failures
    assert failure.finding.expected == "conversational_distance of host exactly 0.6400 m"
    assert failure.finding.got.startswith("0.6402")


@pytest.mark.parametrize(
    ("sentence", "sides"),
    [
        (
            "conversational_distance of host is 640.21 mm within 0.001 mm",
            r"from (\S+) m to (\S+) m, got (\S+) m,",
        ),
        ("docking_error of host at most 0 mm", r"at most (\S+) m, got (\S+) m at"),
        (
            "differs between arab_woman and german_man: conversational_distance, by at least 45.1 cm",
            r"at least (\S+) cm apart, got .*: (\S+) cm apart",
        ),
        ("say lasts 1.004 s within 0.001 s", r"say for from (\S+) s to (\S+) s, got .*\) for (\S+) s,"),
    ],
)
def test_sides_that_differ_are_told_with_the_digits_in_which_they_do(sentence, sides, judge):
    finding = judge(sentence)[-1].failures[0].finding
    told = f"expected {finding.expected}, got {finding.got}"
    found = re.search(sides, told)
    assert found, told
    assert len(set(found.groups())) == len(found.groups())


def test_behind_a_figure_of_one_visit_stands_nothing_of_another(judge):
    (verdict,) = judge("overshoot of guest at least 3 m")
    (failure,) = verdict.failures
    assert "guest" in " ".join(failure.finding.because)
    assert not any("host" in line for line in failure.finding.because)
