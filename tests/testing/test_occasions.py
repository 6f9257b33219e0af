"""A greeting is what was done as the greeting: not what the robot says, hands over or shows afterwards."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.episode import Episode
from comity.testing.amounts.acting import done_for
from comity.testing.collection.cases import claims_in
from comity.testing.trials.attempt import attempted
from comity.testing.verdict import judged

COFFEE = """\
schema_version: 1
name: coffee
place:
  width_m: 6.0
  height_m: 5.0
  furniture:
    - {name: counter, box_m: [0.2, 4.4, 1.6, 0.6]}
robot: {at_m: [1.0, 1.0]}
people:
  "anna, the host": {profile: british_elder, at_m: [4.6, 3.6], facing_deg: 200}
goals:
  - greet: "anna, the host"
  - {say: "Your coffee is ready.", to: "anna, the host"}
  - {offer: coffee, to: "anna, the host", from: counter}
  - take_leave: "anna, the host"
expect:
"""
ANNA = "anna, the host"


@pytest.fixture
def coffee(tmp_path: Path):
    """The test of a visit with full hands: it is greeted in words, and waved at in the end."""

    def claim(*sentences: str):
        path = tmp_path / "coffee.scenario.yaml"
        path.write_text(COFFEE + "".join(f"  - {sentence}\n" for sentence in sentences))
        return claims_in(path)[0]

    return claim


def test_every_act_has_its_occasion(coffee):
    trial: Episode = attempted(coffee("outcome is success").case)
    assert [(each.act, each.occasion) for each in done_for(trial, ANNA)] == [
        ("say", "at the greeting"),
        ("say", "as it tells them something"),
        ("say", "as it brings them something"),
        ("hand_over", "as it brings them something"),
        ("say", "at the farewell"),
        ("wave", "at the farewell"),
    ]


def test_a_greeting_in_words_contains_no_gesture_whatever_follows(coffee):
    assert judged(coffee("greeting contains words and no gesture and no wave")).failures == ()


@pytest.mark.parametrize(
    ("sentence", "got"),
    [
        ("greeting contains a wave", "words; waves, but at the farewell"),
        (
            "greeting contains a gesture",
            "words; hands over, but as it brings them something; waves, but at the farewell",
        ),
        ("greeting contains a nod", "words"),
        ("greeting contains a wave and no words", "words; waves, but at the farewell"),
        ("greeting contains no words", "words"),
    ],
)
def test_what_was_done_only_later_is_told_with_its_occasion(coffee, sentence, got):
    (failure,) = judged(coffee(sentence)).failures
    assert failure.finding.got == got


def test_a_greeting_that_was_broken_off_and_gone_on_with_is_one(coffee):
    """Anna asks for more room while the robot greets her: it draws back and goes on."""
    says = "{conversational_distance: 1.6, greeting_modality: both, greeting_gesture: nod}"
    plain = attempted(coffee("outcome is success").case)
    begins_s = next(event.t for event in plain.events if event.action == "Greet_person")
    change = f'changes: [{{at_s: {begins_s + 0.5:.2f}, person: "{ANNA}", says: {says}}}]'
    claim = coffee("greeting contains words and a nod and no wave", f"outcome is success\n{change}")
    assert judged(claim).failures == ()
    spans = [e for e in attempted(claim.case).events if e.action == "Greet_person"]
    assert [event.status for event in spans].count("running") > 1
