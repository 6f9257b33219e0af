"""The lines of `comity infer` stay short, however many rules there are."""

from __future__ import annotations

from comity.report.values.inference import POSSIBLE_SHOWN, possible
from comity_fis import load_rulebook


def test_of_many_possible_rules_the_first_are_named_and_the_others_counted():
    inference = load_rulebook("bruno2017").infer({"individualism": 67})
    fired = inference["approach_speed"].fired
    assert "rules 7, 8 hold as possible" in possible(fired, inference.inputs)
    many = possible([*fired] * 1000, inference.inputs)
    assert f"and {2000 - POSSIBLE_SHOWN} more hold as possible" in many
    assert len(many) < 200
