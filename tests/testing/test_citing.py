"""A failure names where the rules stand that it goes by: in the rulebook that its case reads."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import comity_fis
from comity.testing.collection.cases import Claim, claims_in
from comity.testing.golden.file import store
from comity.testing.runner.telling import failure_text
from comity.testing.trials.attempt import attempted
from comity.testing.verdict import judged
from comity_fis import InputError

RULES = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text(encoding="utf-8")
WAS = "gender is female then conversational_distance is close"
IS = WAS.replace("close", "far")
LINE = RULES[: RULES.index(WAS)].count("\n") + 1
OWN = "rulebook: rules.yaml\n"
MATRIX = "matrix: {rulebooks: [bruno2017, rules.yaml]}\n"


@pytest.fixture
def rulebook(tmp_path, monkeypatch):
    """Beside the scenario, not where the tests run."""
    monkeypatch.chdir(tmp_path.parent)
    (tmp_path / "rules.yaml").write_text(RULES.replace(WAS, IS), encoding="utf-8")
    return tmp_path / "rules.yaml"


def rules_told(claim: Claim) -> str:
    (found,) = re.findall(
        r"^  rules      (.*(?:\n {13}.*)*)$", failure_text(claim, judged(claim).failures), re.M
    )
    return re.sub(r"\s+", " ", found)


@pytest.mark.parametrize("more", [OWN, MATRIX], ids=["of the scenario", "of the matrix"])
@pytest.mark.parametrize(
    "sentence", ["conversational_distance of host is 64 cm within 1 cm", "docked? never succeeds"]
)
def test_an_edited_rule_is_named_with_its_line_in_the_rulebook_in_use(more, sentence, rulebook, write):
    """Also where a chain of causes has its text and no number."""
    claim = claims_in(write(sentence, more=more))[-1]
    assert f"rule 1 in {rulebook.parent.name}/rules.yaml:{LINE}" in rules_told(claim)


def test_a_shipped_rulebook_is_called_by_its_name(write):
    (claim,) = claims_in(write("conversational_distance of host is 9 m"))
    assert f"rule 1 in bruno2017.yaml:{LINE}" in rules_told(claim)


@pytest.mark.parametrize("sentence", ["approach_speed of host is 0.1 m/s", "duration is 1 s"])
def test_rules_that_hold_as_possible_are_named_too(sentence, write):
    """Nothing is known of the host's age: so these have a say in how fast the robot comes."""
    (claim,) = claims_in(write(sentence))
    assert {"rule 7 in", "rule 8 in"} <= set(re.findall(r"rule \d+ in", rules_told(claim)))


def test_where_no_rule_is_named_there_is_no_such_line(write):
    (claim,) = claims_in(write("never replans", "replans at least once"))
    assert "\n  rules " not in failure_text(claim, judged(claim).failures)


def test_behind_a_golden_difference_the_rule_of_now_has_its_place(rulebook, write):
    (claim,) = claims_in(write(more=OWN))
    store(claim.case, attempted(claim.case))
    text = RULES.replace(WAS, IS).replace(IS, IS.replace("is far", "is medium"))
    rulebook.write_text(f"# a line more\n{text}", encoding="utf-8")
    (claim,) = claims_in(write(more=OWN))
    assert rules_told(claim) == f"rule 1 in {rulebook.parent.name}/rules.yaml:{LINE + 1}"


@pytest.mark.parametrize(
    ("content", "said"),
    [("a: [b\n", "expected YAML"), (RULES.replace(WAS, f"{WAS}d"), "Did you mean 'close'")],
)
def test_a_rulebook_of_the_matrix_that_cannot_be_used_is_told_with_both_lines(content, said, rulebook, write):
    """Where it is wrong, and where it is named."""
    rulebook.write_text(content, encoding="utf-8")
    path = write(more="matrix:\n  rulebooks:\n    - bruno2017\n    - rules.yaml\n")
    with pytest.raises(InputError) as refused:
        claims_in(path)
    folder = path.parent.name
    assert re.match(rf"{folder}/rules.yaml:\d+:\d+: .*{said}", str(refused.value))
    assert refused.value.remedy.endswith(f"The matrix names this file in {folder}/{path.name}:15.")
