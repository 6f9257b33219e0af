"""The robot waits for a way that is shut, pauses after failures, and has an end to both."""

from __future__ import annotations

import pytest
from places import FLAT, HALL

import comity as front_door

SHUT = FLAT.replace("place: {map: apartment}", "place: {map: apartment, doors: {study: closed}}")
GREET = "goals: [{greet: guest}]\n"


@pytest.fixture
def run(here):
    """Run a scenario with these faults and changes."""

    def visit(text: str, *, faults=(), changes=(), limits: str = "{}"):
        listed = "".join(f"  - {{{fault}}}\n" for fault in faults)
        changed = "".join(f"  - {{{change}}}\n" for change in changes)
        more = (f"faults:\n{listed}" if listed else "") + (f"changes:\n{changed}" if changed else "")
        (here / "visit.scenario.yaml").write_text(f"{text}limits: {limits}\n{more}")
        return front_door.run("visit.scenario.yaml")

    return visit


def of_plans(ran) -> list[tuple[float, str, str]]:
    """When a tree failed, another plan took over, or there was none; with the last word of the reason."""
    return [
        (round(event.t, 2), event.status, event.because[-1].text if event.because else "")
        for event in ran.events
        if event.status in ("replanned", "not_replanned")
    ]


@pytest.mark.parametrize("for_s", [16, 40])
def test_a_door_that_is_shut_for_long_is_waited_for_and_the_visit_succeeds(run, for_s: int):
    ran = run(FLAT + GREET, faults=[f"at_s: 2, fault: door closes, door: study, for_s: {for_s}"])
    assert ran.outcome == "success"
    assert ("the way is waited for until t=62.00 s at most: study may be opened") in of_plans(ran)[1][2]
    assert [t for t, status, _ in of_plans(ran) if status == "replanned"][-1] == 2.0 + for_s


def test_no_wait_is_announced_beyond_the_end_of_the_run(run):
    ran = run(FLAT + GREET, limits="{time_s: 20}", faults=["at_s: 2, fault: door closes, door: study"])
    assert "until t=20.00 s at most" in of_plans(ran)[1][2]


@pytest.mark.parametrize("delay_s", [0.0, 0.2])
def test_a_delayed_sensor_does_not_make_a_person_in_view_one_whom_the_robot_does_not_see(run, delay_s: float):
    walled = HALL.replace("height_m: 5}", "height_m: 5, walls_m: [[[4.5, 0], [4.5, 5]]]}")
    ran = run(walled.replace("robot: {", f"robot: {{sensor: {{delay_s: {delay_s}}}, "))
    told = [text for _, _, text in of_plans(ran)]
    assert ran.outcome == "failed"
    assert not [text for text in told if "not see" in text]
    assert [text for text in told if "not measured yet" in text] == (told[:1] if delay_s else [])


def test_whoever_is_behind_a_door_that_is_shut_from_the_start_is_waited_for(run):
    ran = run(SHUT + GREET, faults=["at_s: 3, fault: door opens, door: study"])
    assert ran.outcome == "success"
    assert [(t, status) for t, status, _ in of_plans(ran)] == [(0.0, "not_replanned"), (3.0, "replanned")]


@pytest.mark.parametrize("pause_s", [0, 6])
def test_who_walks_out_of_a_corner_is_waited_for_and_who_stands_in_it_is_not(run, pause_s: int):
    """Before her there is no place at the start; `comity plan` says that she may come to another."""
    walks = f", walks: {{route: [[0.4, 5.6], [4, 3]], pause_s: {pause_s}, speed_m_s: 1.0}}"
    corner = "schema_version: 1\nname: corner\nplace: {width_m: 8, height_m: 6}\nrobot: {at_m: [6, 1]}\n"
    corner += "people:\n  ann: {at_m: [0.4, 5.6], facing_deg: 135%s}\ngoals: [{greet: ann}]\n"
    ran = run(corner % walks)
    assert ran.outcome == "success"
    assert of_plans(ran)[0][2].endswith("ann, who walks, may move")
    (unmet,) = ran.prepared.unmet
    assert [condition.name for condition in unmet.conditions] == ["ann"]
    assert run(corner % "").outcome == "failed"


def test_patience_has_an_end_that_the_scenario_sets_and_nobody_waits_without_it(run):
    ran = run(SHUT + GREET, limits="{patience_s: 7}")
    assert ran.outcome == "failed"
    assert ran.metrics.duration_s == pytest.approx(7.5, abs=0.1)
    assert of_plans(ran)[-1] == (7.0, "not_replanned", "7 s of waiting for the way are over")
    assert run(SHUT + GREET, limits="{patience_s: 0}").metrics.duration_s < 1.0


def test_nobody_waits_where_no_door_can_open_a_way_and_nobody_can_go(run):
    walled = HALL.replace("height_m: 5}", "height_m: 5, walls_m: [[[4.5, 0], [4.5, 5]]]}")
    assert run(walled).metrics.duration_s < 1.0


def test_the_robot_knows_nothing_of_doors_that_are_to_open(run):
    """Until the door opens, the run is the same as where it never does."""
    shut = "at_s: 2, fault: door closes, door: study"
    never = run(FLAT + GREET, faults=[shut])
    later = run(FLAT + GREET, faults=[shut, "at_s: 20, fault: door opens, door: study"])
    assert (never.outcome, later.outcome) == ("failed", "success")
    told = [[(e.t, e.node, e.status, e.because) for e in ran.events if e.t < 20.0] for ran in (never, later)]
    assert told[0] == told[1]


DOORS = FLAT.replace("place: {map: apartment}", "place: {map: apartment, doors: {bath: open}}")
FLAPS = [f"at_s: {at_s}, fault: door closes, door: bath, for_s: 0.5" for at_s in range(2, 60)]
POSTURES = [
    f"at_s: {at_s}, person: marta, situation: {{posture: {posture}}}"
    for at_s in range(2, 60, 2)
    for posture in (("seated", "standing")[at_s // 2 % 2],)
]


@pytest.mark.parametrize(
    ("text", "faults", "changes"),
    [(DOORS + GREET, FLAPS, ()), (HALL, (), POSTURES)],
    ids=["a door elsewhere flaps", "a bystander sits down and gets up"],
)
def test_news_of_no_concern_ends_no_pause(run, text: str, faults, changes):
    """A stuck wheel spends attempts of 5 s; between them the robot pauses for 2, 4 and 8 s."""
    ran = run(text, faults=["at_s: 1, fault: wheel stuck, for_s: 50", *faults], changes=changes)
    assert ran.outcome == "success"
    (first, second, third) = (t for t, status, _ in of_plans(ran) if status == "not_replanned")
    again = [t for t, status, _ in of_plans(ran) if status == "replanned" and t > first]
    assert [round(b - a, 2) for a, b in zip((first, second, third), again, strict=True)] == [2.0, 4.0, 8.0]


def test_whoever_was_in_the_way_and_goes_ends_the_pause(run):
    """Marta stands in the only gap, is asked twice in vain, and goes while the robot pauses."""
    gap = HALL.replace(
        "height_m: 5}", "height_m: 5, walls_m: [[[3.5, 0], [3.5, 1.9]], [[3.5, 3.1], [3.5, 5]]]}"
    )
    gap = gap.replace("at_m: [3.5, 0.6]", "at_m: [3.5, 2.5]")
    pauses = run(gap)
    end_s = next(t for t, status, _ in of_plans(pauses) if status == "not_replanned")
    ran = run(
        gap,
        changes=[f"at_s: {end_s + 0.2:.2f}, person: marta, moves_to_m: [5.5, 0.5]"],
        limits="{replan_pause_s: 20}",
    )
    assert ran.outcome == "success"
    (again,) = (t for t, status, _ in of_plans(ran) if status == "replanned" and t > end_s)
    assert again < end_s + 10.0


def test_new_numbers_give_a_motion_that_is_held_up_no_new_patience(run):
    """Anna asks for another distance every second; with a stuck wheel an attempt is over after 5 s."""
    asks = [
        f"at_s: {t}, person: anna, says: {{conversational_distance: {1.0 + t % 2 / 5}}}" for t in range(2, 30)
    ]
    ran = run(HALL, faults=["at_s: 1, fault: wheel stuck, for_s: 20"], changes=asks)
    tried = [
        (e.t, e.status) for e in ran.events if e.node == "Navigate_to_user(anna)" and e.status != "halted"
    ]
    began_s, failed_s = tried[0][0], tried[1][0]
    assert tried[1][1] == "failure"
    assert failed_s - began_s < 6.5
    assert ran.outcome == "success"


@pytest.mark.parametrize(
    ("goals", "outcome"), [(GREET, "failed"), (GREET[:-2] + ", {greet: host}]\n", "partial")]
)
def test_partial_means_that_somebody_was_greeted_and_somebody_could_not_be(run, goals: str, outcome: str):
    text = SHUT + "  host: {profile: german_woman, at_m: [3.0, 1.4], facing_deg: 90}\n" + goals
    assert run(text, limits="{patience_s: 0}").outcome == outcome


def test_a_way_that_takes_longer_than_its_time_names_the_limit_and_how_far_the_robot_got(run):
    ran = run(FLAT + GREET, limits="{reach_s: 2, reach_attempts: 1, replans: 0}")
    reason = ran.visits[0].failure
    assert (
        "did not end within 2 s (`reach_s` of the scenario's limits allows more); at that moment: " in reason
    )
    assert reason.endswith(" m of way left to guest")
    assert run(FLAT + GREET, limits="{reach_s: 60, reach_attempts: 1, replans: 0}").outcome == "success"
