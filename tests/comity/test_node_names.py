"""Every name that a node may have is known beforehand."""

from __future__ import annotations

import pytest

from comity.testing.collection.cases import claims_in
from comity.testing.trials.attempt import attempted
from comity_executor import node_names
from tests.scenarios.every import SCENARIOS

BY_A_NUMBER = ("Retry ", "Timeout ")
SHOWN = (
    "empty-room",
    "group-at-the-window",
    "tests/on-time-with-tea",
    "tests/errands-between",
    "emergency-stop",
)


@pytest.mark.parametrize("scenario", SHOWN)
def test_a_tree_has_no_node_of_another_name(scenario):
    trial = attempted(claims_in(SCENARIOS[scenario])[0].case)
    acts = {act.act for act in trial.acts} | {"wave", "bow", "nod"}
    names = {node.action for node in trial.nodes}
    assert {name for name in names - acts if not name.startswith(BY_A_NUMBER)} <= node_names()


def test_names_have_no_bracket_and_no_person():
    assert {"docked?", "Greet_company", "Give_up", "Step_away", "Stand_still", "say"} < node_names()
    assert not any("(" in name or name == "one" for name in node_names())
