"""A parameter that Comity has no argument for reaches the robot by its name, with every goal and act."""

from __future__ import annotations

from comity_executor import other_parameters
from comity_fis import load_rulebook

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
