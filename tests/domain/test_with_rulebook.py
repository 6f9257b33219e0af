"""With the inference of the shipped rulebook instead of hand-made values."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

from comity_domain import START, Spot, Visitee, VisitRequest, make_plan
from comity_fis import load_rulebook

README = Path(__file__).parents[2] / "domain" / "README.md"


def test_the_example_of_the_readme_runs_and_prints_a_reach_and_a_greeting():
    (program,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec(program, {})
    first, second = output.getvalue().splitlines()
    assert first.startswith("Reach_user robot johanna ")
    assert second.startswith("Greet_person robot johanna ")
    assert "rule " in first


def test_the_plan_carries_the_inferred_parameters_unrounded():
    values = load_rulebook("bruno2017").infer({"individualism": 38.0, "gender": "female"})
    travel = {(START, Spot("johanna", "front")): 5.0}
    reach, _ = make_plan(VisitRequest("robot", (Visitee("johanna", values),), travel)).steps
    assert reach.parameters["conversational_distance"] == values["conversational_distance"].number
    assert reach.parameters["approach_speed"] == values["approach_speed"].number
