"""A trace that answers: why this, where do two runs part, and which outcomes were never seen."""

from __future__ import annotations

import pytest

from comity_executor import History, Limits, first_divergence, leaf_coverage
from tests.executor.conftest import history_of


@pytest.fixture
def interrupted(episode):
    """Johanna steps away while the robot speaks; the robot docks again and ends its greeting."""
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.run(for_s=0.5)
    visits.hall.people["johanna"].x += 0.37
    return visits.run()


def test_the_state_at_any_time_is_what_the_events_up_to_it_say(interrupted) -> None:
    history = history_of(interrupted)
    for event in history.events:
        seen = history.states(event.t)
        for path, state in seen.items():
            last = [e for e in history.events if e.path == path and e.t <= event.t][-1]
            assert state == last


def test_every_running_action_has_a_reason_that_came_before_it(interrupted) -> None:
    """Reasons are results that came before."""
    history = history_of(interrupted)
    for event in history.events:
        for why in history.why_at(event.t):
            assert why.event.t <= event.t
            if why.event.status == "running":
                assert why.switched_by is not None
                for result in (why.switched_by, *why.standing_on):
                    assert result.t <= why.event.t
                    assert result.status in ("success", "failure")
                assert why.switched_by.t == max(r.t for r in (why.switched_by, *why.standing_on))


def test_the_robot_docks_again_because_the_person_left_the_band(interrupted) -> None:
    """From the running action to the reading, the rule and the culture score."""
    history = history_of(interrupted)
    halt = next(e for e in history.events if e.node == "say(johanna)" and e.status == "halted")
    (why,) = history.why_at(halt.t)
    assert why.event.node == "Dock_to_user(johanna)"
    assert why.switched_by is not None
    assert (why.switched_by.node, why.switched_by.status) == ("docked?(johanna)", "failure")
    kinds = [cause.kind for cause in why.because]
    assert kinds == ["reading", "step", "parameter", "rule", "variable"]
    assert "left" in why.because[0].text
    assert why.because[-1].text == "individualism 67"


def test_a_composite_answers_with_the_leaf_that_decided(interrupted) -> None:
    history = history_of(interrupted)
    (visited,) = [node for node in history.nodes if node.name == "visited(johanna)"]
    why = history.why_node(visited.path)
    assert why is not None
    assert why.switched_by is not None
    assert why.switched_by.node in ("say(johanna)", "nod(johanna)")
    assert why.because[0].text.endswith("is done")


def test_a_node_that_did_nothing_yet_has_no_reason(episode) -> None:
    history = history_of(episode().run(for_s=1.0))
    (act,) = [node for node in history.nodes if node.name == "say(johanna)"]
    assert history.why_node(act.path) is None
    assert History((), ()).why_at(3.0) == ()


def test_equal_runs_do_not_part(episode) -> None:
    assert first_divergence(history_of(episode().run()), history_of(episode().run())) is None


def test_two_runs_part_where_one_was_disturbed(episode, interrupted) -> None:
    """The difference in behaviour is the halt that the other run does not have."""
    calm = history_of(episode().run())
    found = first_divergence(calm, history_of(interrupted), in_behaviour=True)
    assert found is not None
    assert found.in_behaviour
    assert found.other is not None
    assert (found.other.node, found.other.status) == ("docked?(johanna)", "failure")
    assert all(mine != theirs for mine, theirs in found.causes)


def test_a_run_that_ended_parts_from_one_that_went_on(episode) -> None:
    short, whole = history_of(episode().run(for_s=1.0)), history_of(episode().run())
    found = first_divergence(short, whole)
    assert found is not None
    assert (found.one, found.other) == (None, whole.events[len(short.events)])


def test_coverage_counts_every_outcome_of_every_behaviour(episode, interrupted) -> None:
    together = {
        each.leaf: each for each in leaf_coverage([history_of(episode().run()), history_of(interrupted)])
    }
    assert together["docked?"].never == ()
    assert together["say"].seen["halted"] == 1
    assert together["Give_up"].never == ("success", "failure", "halted")
    failing = history_of(episode(limits=Limits(act_timeout_s=0.2)).run())
    wider = {each.leaf: each for each in leaf_coverage([history_of(interrupted), failing])}
    assert wider["Give_up"].never == ("failure", "halted")


def test_the_reasons_of_all_events_are_those_of_each_node_at_its_time(interrupted) -> None:
    """Asked all at once or one by one: the last event of a node in a tick has the same reason."""
    history = history_of(interrupted)
    whys = tuple(history.whys())
    assert [why.event for why in whys] == list(history.events)
    for path, state in history.states().items():
        assert history.why_node(path) == next(why for why in reversed(whys) if why.event is state)
