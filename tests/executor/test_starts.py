"""Each begin of an action has one start in the trace, and nothing else has: counted where they begin."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import Execution, FaultError, Limits
from comity_executor.nodes.leaf import Action
from tests.executor.conftest import within

spans = st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.05, 12.0)), max_size=3)


class Begun(Counter[str]):
    """How often each action began since the counter was made, whoever ticks it."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        super().__init__()
        initialise = Action.initialise

        def counted(action: Action) -> None:
            self[action.name] += 1
            initialise(action)

        patch.setattr(Action, "initialise", counted)


def starts(execution: Execution) -> Counter[str]:
    """How often the trace says that each action began: it runs, or ends without having run before."""
    actions = {node.path for node in execution.nodes if node.kind == "action"}
    started: Counter[str] = Counter()
    running: set[int] = set()
    for event in execution.events:
        if event.path in actions and event.status in ("running", "success", "failure", "halted"):
            started[event.node] += event.path not in running
            running.discard(event.path)
            if event.status == "running":
                running.add(event.path)
    return started


def test_a_question_to_people_who_were_asked_already_starts_each_time(episode) -> None:
    """Ask_to_pass succeeds as soon as it begins, again and again, as Bob may not be asked so soon after."""
    with pytest.MonkeyPatch.context() as patch:
        begun = Begun(patch)
        visits = episode(limits=Limits(blocked_s=0.5, passing_s=20.0))
        for _ in range(4):
            visits.hall.in_the_way = "bob"
            visits.run(for_s=4.0)
            visits.hall.in_the_way = None
            visits.run(for_s=0.2)
        visits.run()
    assert begun["Ask_to_pass(johanna)"] == 4
    assert starts(visits.execution)["Ask_to_pass(johanna)"] == 4


@settings(max_examples=30)
@given(
    in_the_way=spans, pressed=spans, raising=st.sampled_from(("say", "Navigate_to_user", "docked?", "nod"))
)
def test_every_begin_is_one_start(episode, in_the_way, pressed, raising) -> None:
    """Whoever stands in the way, whenever the stop is pressed, and with leaves that raise."""
    with pytest.MonkeyPatch.context() as patch:
        begun = Begun(patch)
        visits = episode("johanna", "alice", limits=Limits(blocked_s=0.3, reach_timeout_s=8.0))
        visits.execution.raise_in(raising, FaultError("on purpose"), times=3)
        while visits.hall.now_s() < 120.0 and visits.execution.tick() == "running":
            visits.execution.resume()
            now_s = visits.hall.now_s()
            visits.hall.in_the_way = "bob" if within(in_the_way, now_s) else None
            visits.hall.emergency_stop = "pressed" if within(pressed, now_s) else False
            visits.hall.step()
    assert starts(visits.execution) == begun
    assert begun.total() > 5
