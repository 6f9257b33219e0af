"""Every halt has a type and a chain of causes, from the reading to the culture score."""

from __future__ import annotations

import pytest
from py_trees.behaviour import Behaviour
from py_trees.behaviours import StatusQueue
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.trees import BehaviourTree

from comity_executor import Limits, TraceEvent
from comity_executor.tracing.recorder import Recorder

SUCCESS_ON_ONE = ParallelPolicy.SuccessOnOne()


def halt_of(visits, node: str) -> TraceEvent:
    """The one halt of a node."""
    (halt,) = [event for event in visits.execution.events if event.node == node and event.status == "halted"]
    return halt


def test_facing_ends_early_because_docking_turned_true(episode) -> None:
    halt = halt_of(episode().run(), "Face_user(johanna)")
    assert halt.halt == "achieved_early"
    assert halt.because[1].text == "docked?(johanna) -> success"


def test_a_greeting_is_preempted_with_the_whole_chain(episode) -> None:
    """The line of the design: the distance that left the band, and the rule that set it."""
    visits = episode()
    visits.run(until=lambda: visits.is_running("say(johanna)"))
    visits.run(for_s=0.5)
    visits.hall.people["johanna"].x += 0.37  # of which the hold closes 2 cm in one period
    visits.hall.step()
    visits.run(for_s=0.0)
    halt = halt_of(visits, "say(johanna)")
    assert halt.halt == "preempted"
    chain = [(cause.kind, cause.text, cause.value) for cause in halt.because]
    assert chain == [
        ("reading", "distance 1.36 m left 0.76..1.31 around 1.01", pytest.approx(1.36)),
        ("condition", "docked?(johanna) -> failure", None),
        ("step", "Reach_user(robot, johanna, front)", None),
        ("parameter", "conversational_distance 1.0100 m (culture)", 1.01),
        ("rule", "if individualism is LC1 and gender is female then conversational_distance is far", 0.7),
        ("variable", "individualism 67", 67.0),
    ]


def test_an_act_that_takes_too_long_is_timed_out_and_its_companion_ends_with_the_parent(episode) -> None:
    visits = episode(limits=Limits(act_timeout_s=0.5)).run()
    spoken, nodded = halt_of(visits, "say(johanna)"), halt_of(visits, "nod(johanna)")
    assert spoken.halt == nodded.halt == "timed_out"
    assert spoken.because[0].text.startswith("say(johanna) did not end within 0.5 s")
    held = halt_of(visits, "Keep_distance(johanna)")
    assert held.halt == "parent_ended"
    assert held.because[0].text.startswith("say(johanna) did not end within 0.5 s")


def test_the_hold_ends_when_the_greeting_is_done(episode) -> None:
    halt = halt_of(episode().run(), "Keep_distance(johanna)")
    assert halt.halt == "parent_ended"
    assert halt.because[0].text == "say is done"


def test_an_emergency_halts_everything_that_ran(episode) -> None:
    visits = episode().run(for_s=1.0)
    running = {node for node in (event.node for event in visits.execution.events) if visits.is_running(node)}
    visits.execution.stop("the red button")
    halts = [event for event in visits.execution.events if event.halt == "emergency"]
    assert {event.node for event in halts} == running
    assert all(event.because[0].text == "the red button" for event in halts)


def leaf(name: str, *results: Status) -> Behaviour:
    """A leaf with these results in turn; the last one stays."""
    return StatusQueue(name, queue=list(results[:-1]), eventually=results[-1])


def last_halt(root: Behaviour, node: str, ticks: int = 2) -> tuple[str | None, str]:
    """How the last halt of a node is typed, and the condition it is put down to."""
    tree = BehaviourTree(root)
    recorder = Recorder(lambda: float(tree.count))
    recorder.watch(root)
    tree.add_visitor(recorder)
    for _ in range(ticks):
        tree.tick()
    halt = [event for event in recorder.events if event.node == node and event.status == "halted"][-1]
    return halt.halt, next(cause.text for cause in halt.because if cause.kind == "condition")


RUNNING, SUCCESS, FAILURE = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def test_a_sibling_that_only_began_is_not_blamed() -> None:
    root = Parallel(
        "p", SUCCESS_ON_ONE, [leaf("begins", RUNNING), leaf("works", RUNNING), leaf("fails", FAILURE)]
    )
    assert last_halt(root, "works", ticks=1) == ("parent_ended", "fails -> failure")


def test_a_sibling_that_failed_all_along_is_not_blamed_for_failing_otherwise() -> None:
    """The first branch fails in both ticks, by another leaf each time; the second one decides."""
    fails = Sequence(
        "fails", False, [leaf("first", SUCCESS, FAILURE), leaf("second", FAILURE), leaf("third", SUCCESS)]
    )
    root = Selector("choose", False, [fails, leaf("flips", FAILURE, RUNNING), leaf("works", RUNNING)])
    assert last_halt(root, "works") == ("preempted", "flips -> running")


def test_within_the_branch_the_leaf_that_failed_it_is_blamed() -> None:
    """Of two guards that changed, the one that now holds did not end the sequence."""
    guards = Sequence("guards", False, [leaf("good", SUCCESS), leaf("bad", SUCCESS, FAILURE)])
    either = Selector("either", False, [leaf("tried", FAILURE), guards])
    root = Sequence("all", False, [either, leaf("works", RUNNING)])
    assert last_halt(root, "works") == ("preempted", "bad -> failure")


def test_a_condition_that_turned_is_blamed_before_the_action_that_it_started() -> None:
    """As in docked(u): the question failed, so Reach_user runs, so the greeting is halted."""
    docked = Selector("docked", False, [leaf("docked?", SUCCESS, FAILURE), leaf("reach", RUNNING)])
    root = Sequence("achieve", False, [docked, leaf("greet", RUNNING)])
    assert last_halt(root, "greet") == ("preempted", "docked? -> failure")


def test_what_turned_true_ends_the_work_for_it_early() -> None:
    root = Selector("done", False, [leaf("done?", FAILURE, SUCCESS), leaf("work", RUNNING)])
    assert last_halt(root, "work") == ("achieved_early", "done? -> success")


def test_everything_below_a_halted_node_is_halted_for_the_same_reason() -> None:
    inner = Sequence("inner", True, [leaf("before", SUCCESS), leaf("works", RUNNING)])
    root = Sequence("outer", False, [leaf("guard", SUCCESS, FAILURE), inner])
    assert last_halt(root, "works") == ("preempted", "guard -> failure")
