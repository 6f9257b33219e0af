"""What leaves share stands on py_trees' blackboard; executions do not meet there, and leave nothing."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from threading import Barrier, Thread

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from py_trees.behaviours import Success
from py_trees.blackboard import ActivityType, Blackboard
from py_trees.common import Status

from comity_executor import FaultError, Limits
from comity_executor.memory.board import Namespace
from comity_executor.memory.shared import SharedMemory
from comity_executor.memory.write import in_words

disturbances = st.fixed_dictionaries(
    {
        "names": st.sampled_from((("johanna",), ("johanna", "alice"), ("bob", "johanna"))),
        "raising": st.sampled_from(("say", "Navigate_to_user", "docked?", "nod")),
        "blocked": st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 12.0)),
        "pressed": st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 5.0)),
    }
)


def on_the_blackboard() -> set[object]:
    """All keys and clients that py_trees knows of in this process."""
    return {*Blackboard.storage, *Blackboard.metadata, *Blackboard.clients}


@pytest.fixture(autouse=True)
def _nothing_is_left_behind() -> Iterator[None]:
    before = on_the_blackboard()
    yield
    gc.collect()
    assert on_the_blackboard() <= before


def disturbed(episode, choices):
    """An episode with faults, people in the way and presses of the stop; `advance` takes one step of it."""
    visits = episode(*choices["names"], limits=Limits(blocked_s=0.3, reach_timeout_s=8.0))
    visits.execution.raise_in(choices["raising"], FaultError("on purpose"), times=2)
    return visits


def advance(visits, choices) -> bool:
    """Whether it goes on after one more tick."""
    now_s = visits.hall.now_s()
    visits.hall.in_the_way = "carol" if _within(choices["blocked"], now_s) else None
    visits.hall.emergency_stop = "pressed" if _within(choices["pressed"], now_s) else False
    visits.execution.resume()
    goes_on = visits.execution.tick() == "running" and now_s < 90.0
    visits.hall.step()
    return goes_on


def trace_alone(episode, choices) -> str:
    visits = disturbed(episode, choices)
    while advance(visits, choices):
        pass
    return visits.execution.trace_sha256()


@pytest.mark.parametrize("end", ["success", "failure", "stopped"])
def test_an_execution_leaves_nothing_on_the_blackboard(episode, end: str) -> None:
    before = on_the_blackboard()
    visits = episode("johanna")
    visits.hall.unreachable = {"johanna"} if end == "failure" else set()
    assert on_the_blackboard() > before
    visits.run(for_s=2.0 if end == "stopped" else 300.0)
    visits.execution.stop("by the test")
    assert visits.execution.status == end
    assert on_the_blackboard() == before
    assert visits.execution.visits[0].outcome == ("greeted" if end == "success" else "unreached")


def test_an_execution_that_is_dropped_while_it_drives_leaves_nothing_either(episode) -> None:
    before = on_the_blackboard()
    visits = episode("johanna").run(for_s=2.0)
    assert visits.hall.speed > 0.0
    assert on_the_blackboard() > before
    del visits
    gc.collect()
    assert on_the_blackboard() == before


def test_the_robot_stops_though_the_blackboard_was_cleared_while_it_drove(episode) -> None:
    visits = episode("johanna").run(for_s=2.0)
    assert visits.hall.speed > 0.0
    Blackboard.clear()
    visits.execution.tree.root.stop(Status.INVALID)
    assert visits.hall.speed == 0.0


def test_a_leaf_has_to_declare_what_it_reads_and_writes() -> None:
    memory = SharedMemory(Namespace(lambda: 0.0))
    seen = memory.seen_by(Success("looks"), reads=("outdated",))
    assert seen.outdated is None
    with pytest.raises(AttributeError, match=r"looks.*write access"):
        seen.outdated = "too late"
    with pytest.raises(AttributeError, match=r"looks.*read/write access"):
        seen.base  # noqa: B018


def test_the_blackboard_names_readers_and_writers(episode) -> None:
    visits = episode("johanna")
    shared = {each.key: each for each in visits.execution.blackboard}
    given_up = shared["johanna/given_up"]
    assert given_up.value is False
    assert given_up.readers == ("given_up?(johanna)", "all_greeted?")
    assert given_up.writers == ("Give_up(johanna)",)
    visits.hall.unreachable = {"johanna"}
    visits.run()
    after = {each.key: each for each in visits.execution.blackboard}["johanna/given_up"]
    assert after == replace(given_up, value=True)


def test_a_name_with_a_dot_or_a_slash_is_one_part_of_a_key(episode) -> None:
    visits = episode("dr. mabuse/2").run()
    assert visits.execution.visits[0].outcome == "greeted"


@settings(max_examples=15)
@given(choices=disturbances)
def test_what_was_written_leads_to_what_stands_there(episode, choices) -> None:
    """In order of time, by leaves that declared it; each write is another value than the one before."""
    visits = disturbed(episode, choices)
    shared = {each.key: each for each in visits.execution.blackboard}
    while advance(visits, choices):
        pass
    last: dict[str, str] = {}
    for before, write in pairwise((None, *visits.execution.writes)):
        assert before is None or before.t <= write.t
        assert last.get(write.entry) != write.value
        assert write.leaf == "execution" or write.leaf in shared[write.entry].writers
        last[write.entry] = write.value
    now = {each.key: in_words(each.value) for each in visits.execution.blackboard}
    assert last.items() <= now.items()


@settings(max_examples=25)
@given(choices=disturbances)
def test_no_leaf_uses_what_it_has_not_declared(episode, choices) -> None:
    """py_trees denies it, and the leaf would fail: its activity stream has no such entry."""
    Blackboard.enable_activity_stream(1_000_000)
    try:
        trace_alone(episode, choices)
        activities = Blackboard.activity_stream.data
    finally:
        Blackboard.disable_activity_stream()
    denied = (ActivityType.ACCESS_DENIED.value, ActivityType.NO_KEY.value)
    assert [item for item in activities if item.activity_type in denied] == []
    assert len(activities) > 100


@settings(max_examples=15)
@given(first=disturbances, second=disturbances, turns=st.randoms(use_true_random=False))
def test_interleaved_executions_give_the_traces_that_they_give_alone(episode, first, second, turns) -> None:
    alone = [trace_alone(episode, choices) for choices in (first, second)]
    both = [(disturbed(episode, choices), choices) for choices in (first, second)]
    under_way = list(both)
    while under_way:
        one = turns.choice(under_way)
        if not advance(*one):
            under_way.remove(one)
    assert [visits.execution.trace_sha256() for visits, _ in both] == alone


@settings(max_examples=8)
@given(first=disturbances, second=disturbances)
def test_executions_in_two_threads_give_the_traces_that_they_give_alone(episode, first, second) -> None:
    alone = [trace_alone(episode, choices) for choices in (first, second)]
    traces, together = ["", ""], Barrier(2)

    def play(number: int, choices: object) -> None:
        together.wait()
        traces[number] = trace_alone(episode, choices)

    threads = [Thread(target=play, args=each) for each in enumerate((first, second))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert traces == alone


def _within(span: tuple[float, float], now_s: float) -> bool:
    start, length = span
    return start <= now_s < start + length
