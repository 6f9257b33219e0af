"""What unified-planning takes is read; the rest is refused with its line and what to write."""

from __future__ import annotations

import pytest
from downward import needs_fast_downward

from comity_domain.custom import bind, custom_pddl, plan_custom, read_custom
from comity_fis.errors import InputError

PROBLEM = "(define (problem p) (:domain d) (:init (p)) (:goal (q)))"
DOMAIN = """(define (domain d) (:requirements :strips{more})
  (:predicates (p) (q))
  (:action wait :parameters () :precondition (p){wait})
  (:action act :parameters () :precondition (p) :effect (q)))"""
DURATIVE = """(define (domain d) (:requirements :durative-actions :fluents)
  (:predicates (p) (q)) (:functions (charge))
  (:durative-action load :parameters () :duration (= ?duration 10) :condition (at start (p))
    :effect (and (at end (q))
      (at end (increase (charge) (* ?duration 5))))))"""


@pytest.fixture
def read(tmp_path):
    def read(domain: str):
        (tmp_path / "d.pddl").write_text(domain)
        (tmp_path / "p.pddl").write_text(PROBLEM)
        return bind(read_custom(tmp_path / "d.pddl", tmp_path / "p.pddl"))

    return read


@needs_fast_downward
@pytest.mark.parametrize("wait", ["", " :effect (and)", " :effect ()"])
def test_an_action_without_effects_is_read_and_no_plan_needs_it(read, wait):
    bound = read(DOMAIN.format(more="", wait=wait))
    assert [step.action for step in plan_custom(bound).plan.steps] == ["act"]
    assert "(:action act" in custom_pddl(bound).domain


@pytest.mark.parametrize(
    ("requirement", "remedy"),
    [
        (":object-fluents", "a predicate"),
        (":preferences", "price"),
        (":constraints", "preconditions"),
        (":derived-predicates", "the actions that change"),
        (":fluent", "Did you mean ':fluents'"),
    ],
)
def test_a_requirement_that_cannot_be_met_says_what_to_write(read, requirement, remedy):
    with pytest.raises(InputError) as refused:
        read(DOMAIN.format(more=f" {requirement}", wait=""))
    assert "d.pddl:1:" in str(refused.value)
    assert remedy in refused.value.remedy
    assert ("Did you mean" in refused.value.remedy) == (requirement == ":fluent")


def test_a_duration_in_an_effect_says_what_to_write(read):
    with pytest.raises(InputError) as refused:
        read(DURATIVE)
    assert "d.pddl:5:" in str(refused.value)
    assert "under :duration" in refused.value.remedy
