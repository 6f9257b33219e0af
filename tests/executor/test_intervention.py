"""Interventions: one thing is held in one tick, and everything else goes on."""

from __future__ import annotations

import pytest

from comity_executor import History, Intervention, Limits, Switch, switches
from tests.executor.conftest import Episode, Hall, Stander, history_of, plan_for


def episode_of(*interventions: Intervention, limits: Limits | None = None, stuck: bool = False) -> Episode:
    """Johanna takes a step away in mid-greeting; or she cannot be reached."""
    hall = Hall({"johanna": Stander(3.0, 0.0)})
    hall.frozen = stuck
    visits = Episode(hall, plan_for("johanna"), limits, interventions)
    visits.run(until=lambda: visits.is_running("say(johanna)"), for_s=30.0)
    if not stuck:
        visits.run(for_s=0.5)
        hall.people["johanna"].x += 0.37
    return visits.run(for_s=60.0)


def find(history: History, node: str, status: str) -> Switch:
    """The first switch of an action to a status."""
    return next(s for s in switches(history) if (s.event.node, s.event.status) == (node, status))


def test_every_action_that_begins_or_is_halted_is_blamed_on_something() -> None:
    history = history_of(episode_of())
    actions = [
        event
        for event in history.events
        if history.nodes[event.path].kind == "action" and event.status in ("running", "halted")
    ]
    assert [switch.event for switch in switches(history)] == actions


def test_without_its_cause_no_switch_happens() -> None:
    history = history_of(episode_of())
    for switch in switches(history):
        assert switch.happens_in(history)
        assert not switch.happens_in(history_of(episode_of(switch.without_cause))), switch


def test_the_rest_goes_on_as_before_until_then() -> None:
    """The events before the intervention are the same, and one tick later the world has its way."""
    history = history_of(episode_of())
    halt = find(history, "say(johanna)", "halted")
    other = history_of(episode_of(halt.without_cause))
    before = [event for event in history.events if event.t < halt.event.t]
    assert list(other.events[: len(before)]) == before
    later = next(
        event for event in other.events if event.status == "halted" and event.node == halt.event.node
    )
    assert later.t == pytest.approx(halt.event.t + 0.05)


def test_a_condition_held_without_its_reading_lets_another_leaf_see_it() -> None:
    """Face_user looks at the same reading as `docked?`: the trace blames the reading, so both are held."""
    history = history_of(episode_of())
    began = find(history, "Keep_distance(johanna)", "running")
    assert began.cause.node == "docked?(johanna)"
    assert began.reading_of == "johanna"
    only = Intervention(began.cause.path, began.cause.t, began.before)
    assert began.happens_in(history_of(episode_of(only)))
    assert not began.happens_in(history_of(episode_of(began.without_cause)))


def test_a_second_attempt_is_blamed_on_the_end_of_the_first() -> None:
    """Not on what has been so all along."""
    limits = Limits(reach_timeout_s=5.0)
    history = history_of(episode_of(limits=limits, stuck=True))
    began = [switch for switch in switches(history) if switch.event.status == "running"]
    (again,) = [switch for switch in began if switch.event.t > 0.0]
    assert (again.cause.node, again.cause.status) == ("Timeout 5 s(Reach_user, johanna)", "failure")
    (why,) = history.why_at(again.event.t)
    assert why.because[0].text.startswith("Approach(johanna) did not end within 5 s")
    assert not again.happens_in(history_of(episode_of(again.without_cause, limits=limits, stuck=True)))
