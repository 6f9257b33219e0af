"""The visits of a plan as a subtree of a tree of the user's own."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from py_trees import display
from py_trees.behaviour import Behaviour
from py_trees.behaviours import Failure, Running, StatusQueue, Success
from py_trees.blackboard import Client
from py_trees.common import Access, ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.decorators import Inverter
from py_trees.trees import BehaviourTree
from py_trees.visitors import SnapshotVisitor

from comity_executor import Execution, Limits, VisitSubtree

AROUND: tuple[Callable[[Behaviour], Behaviour], ...] = (
    lambda node: Sequence("in turn", memory=False, children=[Success("ready?"), node]),
    lambda node: Selector("else", memory=False, children=[Failure("low?"), node]),
    lambda node: Parallel("beside", ParallelPolicy.SuccessOnOne(), [Running("blinks"), node]),
    lambda node: Inverter("not", Inverter("not", node)),
)
"""Trees of a user's, which let what is inside run."""


def nested(visits) -> VisitSubtree:
    """The visits of an episode as a behaviour."""
    return VisitSubtree("Visits", lambda: visits.execution)


def anew(visits) -> Execution:
    return Execution(visits.plan, visits.hall, visits.values)


@settings(max_examples=25)
@given(
    around=st.lists(st.sampled_from(AROUND), max_size=4),
    names=st.sampled_from((("johanna",), ("johanna", "alice"))),
    blocked_s=st.floats(0.0, 12.0),
)
def test_visits_in_a_users_tree_give_the_trace_that_they_give_alone(
    episode, around, names, blocked_s
) -> None:
    def play(visits, tick: Callable[[], object]) -> str:
        while visits.execution.status == "running" and visits.hall.now_s() < 120.0:
            visits.hall.in_the_way = "bob" if 1.0 <= visits.hall.now_s() < 1.0 + blocked_s else None
            tick()
            visits.hall.step()
        return visits.execution.trace_sha256()

    alone, inside = (episode(*names, limits=Limits(blocked_s=0.3)) for _ in range(2))
    root: Behaviour = nested(inside)
    for wrap in around:
        root = wrap(root)
    assert play(inside, BehaviourTree(root).tick) == play(alone, alone.execution.tick)


def test_two_robots_side_by_side_in_one_tree(episode) -> None:
    both, alone = (
        [episode("johanna"), episode("johanna", "alice")],
        [episode("johanna"), episode("johanna", "alice")],
    )
    policy = ParallelPolicy.SuccessOnAll(synchronise=True)
    tree = BehaviourTree(Parallel("robots", policy, [nested(visits) for visits in both]))
    while tree.root.status is not Status.SUCCESS:
        tree.tick()
        for visits in both:
            visits.hall.step()
    traces = [visits.run().execution.trace_sha256() for visits in alone]
    assert [visits.execution.trace_sha256() for visits in both] == traces


def test_a_tree_around_that_halts_the_visits_stops_the_robot_and_is_named(episode) -> None:
    visits = episode("johanna")
    battery = StatusQueue("Charge", [Status.FAILURE] * 30 + [Status.RUNNING] * 5, eventually=Status.FAILURE)
    made: list[Execution] = []

    def make() -> Execution:
        made.append(anew(visits))
        return made[-1]

    tree = BehaviourTree(Selector("Robot", memory=False, children=[battery, VisitSubtree("Visits", make)]))
    for _ in range(31):
        tree.tick()
        visits.hall.step()
    assert visits.hall.speed == 0.0
    assert made[0].status == "stopped"
    last = made[0].events[-1]
    assert (last.halt, last.because[0].text) == ("parent_ended", "Robot stopped Visits")
    while tree.root.status is not Status.SUCCESS:
        tree.tick()
        visits.hall.step()
    assert [each.status for each in made] == ["stopped", "success"]


def test_visits_that_fail_are_a_failure_and_are_not_stopped_again(episode) -> None:
    visits = episode("johanna")
    visits.hall.unreachable = {"johanna"}
    subtree = nested(visits)
    tree = BehaviourTree(Selector("Robot", memory=False, children=[subtree, Success("Say_sorry")]))
    while tree.root.status is not Status.SUCCESS:
        tree.tick()
        visits.hall.step()
    tree.interrupt()
    tree.root.stop(Status.INVALID)
    assert visits.execution.status == "failure"


def test_visitors_and_drawings_of_the_tree_around_see_the_visits(episode) -> None:
    visits = episode("johanna")
    snapshot = SnapshotVisitor()
    tree = BehaviourTree(Sequence("Robot", memory=True, children=[nested(visits)]))
    tree.add_visitor(snapshot)
    tree.setup(visitor=None)
    for _ in range(20):
        tree.tick()
        visits.hall.step()
    inside = {node.id for node in visits.execution.tree.root.iterate() if node.status is not Status.INVALID}
    assert inside <= snapshot.visited.keys()
    assert "Navigate_to_user(johanna)" in display.ascii_tree(tree.root, visited=snapshot.visited)
    assert "Navigate_to_user(johanna)" in display.dot_tree(tree.root).to_string()


def test_the_users_own_entries_on_the_blackboard_stay(episode) -> None:
    own = Client(name="user")
    own.register_key("battery", access=Access.WRITE)
    own.set("battery", 0.8)
    try:
        episode("johanna").run()
        assert own.battery == pytest.approx(0.8)
    finally:
        own.unregister()
