"""A parameter that Comity has no argument for reaches the robot by its name, with every goal and act."""

from __future__ import annotations

from dataclasses import replace

from comity_domain import PlanStep, StepExplanation
from comity_executor import Execution, other_parameters
from comity_executor.trees import task_tree
from comity_fis import load_rulebook
from tests.executor.conftest import Hall, Stander, infer, plan_for

EVIDENCE = load_rulebook("evidence")
GAZE = "mutual_gaze"


def test_the_robot_receives_it_with_every_goal_and_act(episode):
    visits, values = episode(), EVIDENCE.infer({})
    visits.values["johanna"].parameters[GAZE] = values[GAZE]
    visits.run()
    told = visits.hall.others
    assert {"navigate", "dock", "say", "nod"} <= {name for name, _ in told}
    assert all(others == {GAZE: values[GAZE].value} for _, others in told)


def test_what_has_an_argument_is_not_told_twice():
    """A pose may deviate from the wanted distance: a robot that read both could follow the wrong one."""
    others = other_parameters(EVIDENCE.infer({}))
    assert GAZE in others
    assert not {"conversational_distance", "approach_speed", "greeting_gesture", "voice_volume"} & set(others)


def test_nothing_is_told_of_a_person_of_whom_nothing_was_inferred():
    assert other_parameters(None) == {}


def test_an_act_of_the_agenda_receives_the_parameters_of_its_step_besides_its_thing(monkeypatch):
    """Without its subtree a pause is such an act."""
    others = {action: subtree for action, subtree in task_tree.SUBTREES.items() if action != "Wait"}
    monkeypatch.setattr(task_tree, "SUBTREES", others)
    plan, hall = plan_for("johanna"), Hall({"johanna": Stander(3.0, 0.0)})
    given = {"thing": "a song", "cap_s": 4.0, "until": "speaks"}
    step = PlanStep("Wait", ("robot", "johanna", "4 s"), None, given, 0, StepExplanation("", ()))
    execution = Execution(replace(plan, steps=(*plan.steps, step)), hall, {"johanna": infer()})
    while execution.tick() == "running":
        hall.step()
    assert dict(hall.others)["wait"] == {"cap_s": 4.0, "until": "speaks"}
