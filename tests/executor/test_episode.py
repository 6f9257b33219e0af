"""Whole episodes in an empty hall: what the tree makes of a plan."""

from __future__ import annotations

import csv

import pytest

from comity_executor import Limits, ReadingsFile


def test_a_person_is_reached_and_greeted(episode) -> None:
    """The robot rests at the wanted place, faces the person, speaks and nods."""
    visit = episode().run().execution.visits[0]
    assert visit.outcome == "greeted"
    assert visit.greeting == ("say", "nod")
    assert visit.docked_at.distance_m == pytest.approx(1.01, abs=0.01)
    assert visit.docked_at.facing_error_deg <= 5
    assert visit.deviation_reason is None


@pytest.mark.parametrize(
    ("modality", "acts"), [("verbal", ("say",)), ("gestural", ("bow",)), ("both", ("say", "bow"))]
)
def test_the_modality_decides_the_acts(episode, modality: str, acts: tuple[str, ...]) -> None:
    gesture = "none" if modality == "verbal" else "bow"
    assert episode(modality=modality, gesture=gesture).run().execution.visits[0].greeting == acts


def test_people_are_visited_in_the_plans_order(episode) -> None:
    visits = episode("johanna", "alice", "bob").run()
    assert [visit.person for visit in visits.execution.visits] == ["johanna", "alice", "bob"]
    assert [visit.docked_s for visit in visits.execution.visits] == sorted(
        visit.docked_s for visit in visits.execution.visits
    )
    assert visits.execution.status == "success"


def test_who_was_greeted_before_is_skipped(episode) -> None:
    halted = episode("johanna", "alice")
    halted.run(until=lambda: halted.execution.visits[0].outcome == "greeted")
    halted.execution.stop("another tree took over")
    visits = episode("johanna", "alice")
    visits.execution.go_on_from(halted.execution)
    visits.run()
    assert visits.execution.status == "success"
    assert not any("johanna" in call for call in visits.hall.calls)
    assert visits.execution.visits[0].outcome == "greeted"
    assert visits.execution.visits[0].greeting == (), "nothing was performed now"


def test_a_robot_that_is_docked_does_not_move_first(episode) -> None:
    """It holds its place and greets at once."""
    visits = episode(ahead_m=1.46)
    visits.hall.heading = 0.0
    visits.run()
    assert visits.execution.visits[0].outcome == "greeted"
    assert visits.hall.calls == ["dock johanna", "say johanna: Hello, Johanna.", "nod johanna"]


def test_a_shuffle_does_not_undock(episode) -> None:
    """0.18 m are inside the switching band; the hold follows, and nothing is begun anew."""
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.hall.people["johanna"].x += 0.18
    visits.run()
    assert visits.count("Reach_user(johanna)", "running") == 1
    assert visits.hall.read("johanna").distance_m == pytest.approx(1.01, abs=0.01)


def test_who_walks_away_is_followed_and_no_gesture_is_repeated(episode) -> None:
    """Johanna walks 1.3 m when the nod is done and the sentence is not."""
    visits = episode()
    visits.run(until=lambda: ("nod", "johanna") in visits.hall.finished)
    visits.run(for_s=0.05)
    visits.hall.people["johanna"].x += 1.3
    visits.run()
    assert visits.execution.visits[0].greeting == ("say", "nod")
    assert visits.count("Reach_user(johanna)", "running") == 2
    assert visits.hall.now_s() < 15, "setting out again is not held up by the end of the hold"
    assert visits.hall.calls.count("nod johanna") == 1
    assert visits.hall.finished.count(("say", "johanna")) == 1


def test_one_who_cannot_be_reached_does_not_cost_the_next_one_the_visit(episode) -> None:
    visits = episode("johanna", "alice")
    visits.hall.unreachable.add("johanna")
    visits.run()
    johanna, alice = visits.execution.visits
    assert (johanna.outcome, alice.outcome) == ("unreached", "greeted")
    assert johanna.failure == "no free and reachable place to stand near johanna"
    assert visits.execution.status == "failure"


def test_a_stuck_robot_gives_up_after_its_attempts(episode) -> None:
    """Two attempts of 40 simulated seconds, then the visit is over; a whole one would take 10."""
    visits = episode()
    visits.hall.frozen = True
    visits.run()
    assert visits.hall.now_s() == pytest.approx(80.0, abs=0.2)
    assert visits.execution.visits[0].failure.startswith(
        "Approach(johanna) did not end within 40 s (`reach_s`"
    )


def test_a_passer_by_in_the_way_is_waited_for(episode) -> None:
    visits = episode()
    visits.hall.blocked_by["johanna"] = "bob"
    visits.run(for_s=1.5)
    del visits.hall.blocked_by["johanna"]
    assert visits.run().execution.visits[0].outcome == "greeted"
    assert visits.count("Navigate_to_user(johanna)", "failure") == 0


def test_a_way_that_stays_blocked_is_a_failure_with_its_reason(episode) -> None:
    visits = episode()
    visits.hall.blocked_by["johanna"] = "a cart stands in the door"
    visits.run()
    assert visits.execution.visits[0].failure == "blocked: a cart stands in the door"
    assert visits.hall.now_s() == pytest.approx(4.05, abs=0.11), "two attempts of 2 s patience"


def test_an_act_that_never_ends_times_out(episode) -> None:
    visits = episode(limits=Limits(act_timeout_s=0.5))
    visits.run()
    johanna = visits.execution.visits[0]
    assert johanna.outcome == "not_greeted"
    assert johanna.docked_at is not None
    allows = "(`act_s` of the scenario's limits allows more)"
    assert johanna.failure == f"say(johanna) did not end within 0.5 s {allows}"


@pytest.mark.parametrize("call", ["choose_pose", "navigate", "dock", "face", "read", "say", "nod"])
def test_an_exception_is_a_failure_with_its_text(episode, call: str) -> None:
    visits = episode("johanna", "alice")
    visits.hall.faults[call] = RuntimeError("servo 3 is hot")
    visits.run()
    failure = visits.execution.visits[0].failure
    assert failure.startswith("RuntimeError: servo 3 is hot (conftest.py:")
    assert failure in [cause.text for event in visits.execution.events for cause in event.because]
    assert visits.hall.at_rest


def test_the_chosen_pose_and_its_reason_are_remembered(episode) -> None:
    visits = episode()
    visits.hall.table = True
    visit = visits.run().execution.visits[0]
    assert visit.pose.pose_free is False
    assert visit.deviation_reason == "a table stands in front"
    assert visit.docked_at.bearing_deg == pytest.approx(30, abs=3)


def test_losing_sight_for_a_moment_does_not_undock(episode) -> None:
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.hall.blind.add("johanna")
    visits.run(for_s=0.5)
    visits.hall.blind.clear()
    visits.run()
    assert visits.count("docked?(johanna)", "failure") == 1, "only before docking"


def test_losing_sight_for_long_does(episode) -> None:
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.hall.blind.add("johanna")
    visits.run(for_s=1.5)
    assert visits.count("docked?(johanna)", "failure") == 2
    assert not visits.is_running("say(johanna)")


def test_the_robot_rests_at_every_end(episode) -> None:
    """However the episode ends: greeted, stopped in any phase, given up."""
    assert episode().run().hall.at_rest
    for seconds in (0.0, 1.0, 2.0, 3.0, 4.0):
        visits = episode().run(for_s=seconds)
        visits.execution.stop("the red button")
        assert visits.hall.at_rest, f"stopped at {seconds} s"
        assert visits.execution.status == "stopped"
    stuck = episode(limits=Limits(reach_timeout_s=1.0))
    assert stuck.run().execution.status == "failure"
    assert stuck.hall.at_rest


def test_nothing_happens_after_the_end(episode) -> None:
    visits = episode().run()
    before = visits.execution.events
    visits.hall.people["johanna"].x += 5
    assert visits.execution.tick() == "success"
    visits.execution.stop("too late")
    assert visits.execution.events == before
    assert visits.execution.status == "success"


def test_the_series_holds_what_the_tree_saw_once_a_tick(episode) -> None:
    visits = episode().run()
    series = visits.execution.readings
    times = [row["t"] for _, row in series.rows()]
    assert times == sorted(set(times))
    assert series.people == ["johanna"]
    assert len(series) == len(times) == visits.hall.ticks + 1, "the first tick is at 0 s"


def test_the_series_on_disk_is_the_series(episode, tmp_path) -> None:
    series = episode("johanna", "alice").run().execution.readings
    with ReadingsFile(tmp_path / "readings.csv") as written:
        written.keep(series)
    with (tmp_path / "readings.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(series)
    for row, (person, values) in zip(rows, series.rows(), strict=True):
        assert row.pop("person") == person
        assert {name: float(value) for name, value in row.items()} == pytest.approx(values, abs=1e-6)
