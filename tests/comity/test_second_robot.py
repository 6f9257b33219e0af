"""The robot protocol, held by a second robot: what is planned for the world runs without it."""

from __future__ import annotations

import pytest

from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity_executor import Execution, History, Limits, ScriptedRobot, switches
from tests.executor.btcpp_structure import faults
from tests.scenarios.every import SCENARIOS


@pytest.fixture(params=sorted(SCENARIOS))
def prepared(request: pytest.FixtureRequest) -> PlannedEpisode:
    return prepare(load_scenario(str(SCENARIOS[request.param])))


def test_the_scripted_robot_carries_out_the_plan_of_every_scenario(prepared: PlannedEpisode) -> None:
    """The same plan and tree with other eyes and wheels; every switch has its cause, and BT.CPP its file."""
    robot = ScriptedRobot(dict.fromkeys(prepared.values, 3.0), name=prepared.file.scenario.robot.name)
    execution = Execution(prepared.plan, robot, prepared.values, Limits.attentive(prepared.attend_s))
    for _ in range(5000):
        if execution.tick() != "running":
            break
        robot.step()
    assert execution.status == "success"
    assert {visit.outcome for visit in execution.visits} <= {"greeted", "skipped"}
    for visit in execution.visits:
        if visit.docked_at is not None:
            wanted = prepared.values[visit.person]["conversational_distance"].number
            assert visit.docked_at.distance_m == pytest.approx(wanted, abs=0.011)
    history = History(execution.nodes, execution.events)
    began = {
        (e.t, e.path)
        for e in history.events
        if history.nodes[e.path].kind == "action" and e.status == "running"
    }
    assert began <= {(switch.event.t, switch.event.path) for switch in switches(history)}
    assert faults(execution.btcpp_xml()) == []
