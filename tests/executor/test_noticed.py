"""What the robot notices of how a person takes its coming, and that it leaves them their distance."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Limits
from comity_executor.robots.noticed import BACK_M, IN_M, TURNED_DEG, noticed
from comity_fis.learning.signals import WORDS

ATTENTIVE = Limits.attentive(4.0)


class Spoken:
    def __init__(self, text: str) -> None:
        self.t, self.text = 0.0, text


def docked_with(episode, act):
    """Greet johanna, and let something happen half a second after the docking."""
    visits = episode(limits=ATTENTIVE)
    visits.run(until=lambda: visits.is_running("Attend_to(johanna)"))
    visits.run(for_s=0.5)
    act(visits.hall)
    return visits.run()


def move(hall, metres: float = 0.0, degrees: float = 0.0) -> None:
    """Away from the robot, along the line between the two."""
    johanna = hall.people["johanna"]
    johanna.x += metres
    johanna.heading += math.radians(degrees)


@given(st.floats(-IN_M + 0.001, BACK_M - 0.001), st.floats(-TURNED_DEG + 0.1, TURNED_DEG - 0.1))
def test_small_movements_say_nothing(reading, farther, turn):
    first = reading()
    now = reading(distance_m=first.distance_m + farther, bearing_deg=turn)
    assert noticed(first, now, (), 1.0) is None


@given(st.floats(BACK_M + 0.001, 0.5), st.floats(0.5, 2.0))
def test_who_becomes_farther_stepped_back_from_where_the_robot_stood(reading, farther, at):
    seen = noticed(reading(distance_m=at), reading(distance_m=at + farther), (), 1.0)
    assert seen is not None
    assert (seen.kind, seen.distance_m) == ("step_back", at)


def test_words_go_before_movements(reading):
    first = reading()
    now = reading(distance_m=first.distance_m + 0.2)
    said = [Spoken("Good morning."), Spoken(WORDS["ask_closer"].upper())]
    seen = noticed(first, now, said, 1.0)
    assert seen is not None
    assert seen.kind == "ask_closer"


@pytest.mark.parametrize(
    ("metres", "degrees", "kind"),
    [
        (0.2, 0, "step_back"),
        (-0.12, 0, "lean_in"),
        (0, 60, "turn_away"),
        (0, 0, "nothing"),
        (0.04, 5, "nothing"),
    ],
)
def test_the_robot_notices_and_stays_where_it_is(episode, metres, degrees, kind):
    """A gap that a person opened is not closed, one that they closed is not opened, nor are they circled."""
    visits = docked_with(episode, lambda hall: move(hall, metres, degrees))
    visit = visits.execution.visits[0]
    assert visit.noticed is not None
    assert visit.noticed.kind == kind
    assert visit.noticed.distance_m == pytest.approx(1.01, abs=0.011)
    assert visit.outcome == "greeted"
    assert visits.hall.read("johanna").distance_m == pytest.approx(1.01 + metres, abs=0.011)
    assert visits.count("Reach_user(johanna)", "running") == 1


@pytest.mark.parametrize(("kind", "moves_m"), [("ask_closer", -0.10), ("ask_farther", 0.10)])
def test_a_request_is_granted_at_once(episode, kind, moves_m):
    visits = docked_with(episode, lambda hall: hall.said.update(johanna=[Spoken(WORDS[kind])]))
    assert visits.execution.visits[0].noticed.kind == kind
    assert visits.hall.read("johanna").distance_m == pytest.approx(1.01 + moves_m, abs=0.011)


def test_no_request_leads_below_the_safety_floor(episode):
    visits = episode(limits=ATTENTIVE, distance_m=0.32)
    visits.run(until=lambda: visits.is_running("Attend_to(johanna)"))
    visits.run(for_s=0.5)
    visits.hall.said["johanna"] = [Spoken(WORDS["ask_closer"])]
    visits.run()
    assert visits.hall.read("johanna").distance_m >= 0.30 - 1e-6


def test_what_was_said_before_the_robot_stood_there_is_no_answer_to_it(episode):
    visits = episode(limits=ATTENTIVE)
    visits.hall.said["johanna"] = [Spoken(WORDS["ask_closer"])]
    visits.run()
    assert visits.execution.visits[0].noticed.kind == "nothing"


def test_who_walks_away_is_still_followed(episode):
    """1.3 m at once are no step back: the robot goes after them, and greets them there."""
    visits = docked_with(episode, lambda hall: move(hall, 1.3))
    assert visits.execution.visits[0].outcome == "greeted"
    assert visits.count("Reach_user(johanna)", "running") == 2


def test_a_robot_without_time_for_it_notices_nothing(episode):
    visits = episode().run()
    assert visits.execution.visits[0].noticed is None
    assert visits.count("Attend_to(johanna)", "running") == 0


def test_the_trace_says_what_was_noticed(episode):
    visits = docked_with(episode, lambda hall: move(hall, 0.2))
    said = [
        cause.text
        for event in visits.execution.events
        if event.node == "Attend_to(johanna)"
        for cause in event.because
    ]
    assert "johanna stepped back at 1.01 m" in said
