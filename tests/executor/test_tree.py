"""From a plan to a tree."""

from __future__ import annotations

from dataclasses import replace

import pytest
from py_trees import display

from comity_executor import Execution, NodeId, tree_text


def test_the_tree_of_one_visit(episode) -> None:
    """One postcondition-precondition-action block per action of the plan."""
    drawing = "\n".join(
        line.rstrip()
        for line in """
? Safe
   → Stop
      ○ emergency?
      □ Stand_still
   → Goal
      ○ plan_holds?
      ? visited(johanna)
         ○ greeted?(johanna)
         ○ given_up?(johanna)
         → Achieve(johanna)
            ? docked(johanna)
               ○ docked?(johanna)
               ◇ Retry 2(johanna)
                  ◇ Timeout 40 s(Reach_user, johanna)
                     ⇉ Approach(johanna)
                        ◇ Mind_way(johanna)
                           ? Pass(johanna)
                              ○ way_free?(johanna)
                              →* Ask_way(johanna)
                                 □ Wait_for_way(johanna)
                                 □ Ask_to_pass(johanna)
                                 □ Await_way(johanna)
                        →* Reach_user(johanna)
                           □ Navigate_to_user(johanna)
                           □ Dock_to_user(johanna)
                           □ Face_user(johanna)
            ⇉ Greet_person(johanna)
               □ Keep_distance(johanna)
               ⇉ Perform(johanna)
                  ? done(say, johanna)
                     ○ done?(say, johanna)
                     ◇ Timeout 10 s(say, johanna)
                        □ say(johanna)
         □ Give_up(johanna)
      ○ all_greeted?""".strip().splitlines()
    )
    assert tree_text(episode(modality="verbal", gesture="none").execution.nodes) == drawing


def test_the_drawing_shows_the_last_status(episode) -> None:
    execution = episode().run(for_s=0.0).execution
    lines = tree_text(execution.nodes, {event.path: event.status for event in execution.events}).splitlines()
    assert "   → Goal  running" in lines
    assert "         ○ greeted?(johanna)  failure" in lines


def test_py_trees_draws_the_tree_with_what_each_leaf_has_to_say(episode) -> None:
    root = episode("johanna", "alice").run(for_s=1.0).execution.tree.root
    drawing = display.unicode_tree(root, show_status=True)
    assert "docked?(johanna) [✕] -- distance 2.55 m is not in 1.00..1.02 around 1.01" in drawing
    for draw in (display.unicode_tree, display.ascii_tree, display.xhtml_tree, display.dot_tree):
        assert all(node.name in str(draw(root)).replace('"', "") for node in root.iterate())


def test_a_node_says_what_it_does_and_for_which_person_beside_its_name(episode) -> None:
    nodes = episode("johanna", "alice").execution.nodes
    assert all(node.name == NodeId(node.action, node.about, node.person).name for node in nodes)
    docked = [node.person for node in nodes if node.action == "docked?"]
    assert docked == ["johanna", "alice"]
    (timeout,) = (node for node in nodes if node.name == "Timeout 10 s(say, alice)")
    assert (timeout.kind, timeout.action, timeout.about) == ("decorator", "Timeout 10 s", ("say", "alice"))


def test_nodes_are_numbered_in_preorder_below_their_parents(episode) -> None:
    nodes = episode("johanna", "alice").execution.nodes
    assert [node.path for node in nodes] == list(range(len(nodes)))
    assert all(node.parent < node.path for node in nodes[1:])
    assert nodes[0].parent is None


def test_nobody_to_visit_is_a_success(episode) -> None:
    visits = episode()
    assert Execution(replace(visits.plan, steps=()), visits.hall, {}).tick() == "success"


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (lambda reach, greet: (reach,), "needs Reach_user and then Greet_person, got Reach_user"),
        (lambda reach, greet: (greet, reach), "got Greet_person, Reach_user"),
        (lambda reach, greet: (reach, greet, greet), "got Reach_user, Greet_person, Greet_person"),
        (lambda reach, greet: (replace(reach, action="Dance"), greet), "no behaviour for action 'Dance'"),
        (
            lambda reach, greet: (replace(reach, parameters={}), greet),
            "needs a number conversational_distance",
        ),
        (
            lambda reach, greet: (reach, replace(greet, arguments=("robot", "johanna", "sung", "nod"))),
            "unknown modality 'sung'",
        ),
        (
            lambda reach, greet: (reach, replace(greet, arguments=("robot", "johanna", "both", "none"))),
            "names no gesture",
        ),
    ],
)
def test_a_plan_that_cannot_be_executed_is_refused(episode, spoil, complaint: str) -> None:
    visits = episode()
    with pytest.raises(ValueError, match=complaint):
        Execution(replace(visits.plan, steps=spoil(*visits.plan.steps)), visits.hall, visits.values)


def test_a_person_without_parameters_is_refused(episode) -> None:
    visits = episode()
    with pytest.raises(ValueError, match="johanna, whose parameters are not given"):
        Execution(visits.plan, visits.hall, {})
