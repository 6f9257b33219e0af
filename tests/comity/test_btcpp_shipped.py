"""The trees of shipped scenarios as BehaviorTree.CPP v4 XML, by the structure that it demands."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import Execution, Limits
from comity_sim2d import World
from tests.executor.btcpp_structure import faults

SCENARIOS = ("tea-visit", "group-at-the-window", "acquaintance", "comity-bench-1/ward-round", "own-wishes")
"""With an agenda and a return, a company, attention to reactions, a map, and wishes."""


def exported(scenario: str) -> str:
    prepared = prepare(load_scenario(scenario))
    world = World(prepared.scene, seed=0, route_map=prepared.route_map)
    limits = Limits.attentive(prepared.attend_s)
    return Execution(prepared.plan, world.robot, prepared.values, limits).btcpp_xml()


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_no_leaf_leaves_a_declared_port_unset_and_every_act_is_tried_again(scenario: str) -> None:
    text = exported(scenario)
    assert faults(text) == []
    tree = ElementTree.fromstring(text)[0]
    acts = [*tree.iter("Act"), *tree.iter("TaskAct")]
    attempts = [act for once in tree.iterfind(".//RetryUntilSuccessful/Fallback") for act in once[:1]]
    assert {act.get("name") for act in acts} == {act.get("name") for act in attempts}
    assert all(act.get("text") for act in acts if act.get("act") == "say")
