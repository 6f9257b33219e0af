"""A real robot goes to no child, nor to anybody who may be one, but in a study with consent."""

from __future__ import annotations

from itertools import product

import pytest
from gliding import Gliding

import comity
from comity_fis import InputError

SCENARIO = """schema_version: 1
name: one
place: {{width_m: 8, height_m: 6}}
robot: {{at_m: [1, 1]}}
adults_only: {adults_only}
child_study: {child_study}
people:
  anna: {{at_m: [3.0, 3.0], guardian_consent: {consent}, profile: {{name: anna{age}}}}}
goals: [{{greet: anna}}]
"""
AGES = {"": None, ", age: 17": 17, ", age: 18": 18, ", age: 40": 40}


CASES = [*product(AGES, *[("true", "false")] * 3)]


@pytest.mark.parametrize(("age", "adults_only", "child_study", "consent"), CASES)
def test_whom_a_real_robot_may_go_to(here, age, adults_only, child_study, consent):
    path = here / "one.scenario.yaml"
    text = SCENARIO.format(age=age, adults_only=adults_only, child_study=child_study, consent=consent)
    path.write_text(text, encoding="utf-8")
    robot = Gliding({"anna": (3.0, 3.0, 0.0)})
    years = AGES[age]
    may = (years is not None and years >= 18) or (child_study == consent == "true")
    may = may or (years is None and adults_only == "true")
    if may:
        assert comity.run(path, robot=robot).outcome == "success"
    else:
        with pytest.raises(InputError, match="adults before a real robot"):
            comity.run(path, robot=robot)
        assert robot.log == []
    assert comity.run(path).outcome == "success"  # the simulated one goes to everybody


@pytest.mark.parametrize(("age", "is_noted"), [(6, True), (17.9, True), (18, False), (40, False)])
def test_what_is_inferred_for_a_child_has_a_note(age, is_noted):
    for values in (comity.infer({"age": age}), comity.infer(age=age)):
        assert any("under 18" in note for note in values.notes) == is_noted
