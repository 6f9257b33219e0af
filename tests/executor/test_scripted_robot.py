"""The second robot: the same plans, without a world."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Execution, Robot, ScriptedRobot
from tests.executor.conftest import infer, plan_for


def carried_out(robot: ScriptedRobot, *people: str) -> Execution:
    execution = Execution(plan_for(*people), robot, {person: infer() for person in people})
    for _ in range(5000):
        if execution.tick() != "running":
            break
        robot.step()
    return execution


@given(st.lists(st.floats(0.5, 20), min_size=1, max_size=4))
def test_the_same_plan_is_carried_out(away_m: list[float]) -> None:
    people = {f"person{i}": away for i, away in enumerate(away_m)}
    execution = carried_out(ScriptedRobot(people), *people)
    assert execution.status == "success"
    for visit in execution.visits:
        assert (visit.outcome, visit.greeting) == ("greeted", ("say", "nod"))
        assert visit.docked_at is not None
        assert visit.docked_at.distance_m == pytest.approx(1.01, abs=0.0101)


def test_it_is_a_robot() -> None:
    """Structurally: mypy holds this line, nothing is inherited."""
    robot: Robot = ScriptedRobot({"johanna": 3.0})
    assert robot.read("a stranger") is None


def test_its_trace_says_why_as_any_other(episode) -> None:
    execution = carried_out(ScriptedRobot({"johanna": 3.0}), "johanna")
    docked = next(e for e in execution.events if e.node == "docked?(johanna)" and e.status == "success")
    assert [cause.kind for cause in docked.because] == ["reading", "step", "parameter", "rule", "variable"]
