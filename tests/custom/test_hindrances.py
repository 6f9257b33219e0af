"""Where there is no plan, the message names the goal that fails and the condition that cannot be met."""

from __future__ import annotations

import pytest

from comity_domain import NoPlan, PlanningFailed
from comity_domain.custom import Binding, BindingRefusedError, bind, plan_custom, read_custom
from comity_domain.custom.binding.binding import ActionBinding, Option
from comity_domain.custom.binding.option_check import refuse_options

DOMAIN = """(define (domain rooms)
  (:types place box - object)
  (:predicates (at ?p - place) (in ?b - box ?p - place) (held ?b - box) (open ?p - place) (lit ?p - place))
  (:action go
    :parameters (?from ?to - place)
    :precondition (and (at ?from) (open ?to))
    :effect (and (not (at ?from)) (at ?to)))
  (:action take
    :parameters (?b - box ?p - place)
    :precondition (and (at ?p) (in ?b ?p))
    :effect (and (held ?b) (not (in ?b ?p)))))
"""
PROBLEM = """(define (problem fetch)
  (:domain rooms)
  (:objects hall kitchen - place tea - box)
  (:init (at hall) (open hall) (in tea kitchen))
  (:goal (and (at hall) %s)))
"""


@pytest.fixture
def own(tmp_path):
    """The rooms with another goal, changed as text."""

    def write(goal: str, *changes: tuple[str, str], domain: str = DOMAIN):
        problem = PROBLEM % goal
        for old, new in changes:
            assert old in problem + domain
            problem, domain = problem.replace(old, new), domain.replace(old, new)
        (tmp_path / "d.pddl").write_text(domain)
        (tmp_path / "p.pddl").write_text(problem)
        return bind(read_custom(tmp_path / "d.pddl", tmp_path / "p.pddl"))

    return write


@pytest.mark.parametrize(
    ("goal", "changes", "reason", "remedy"),
    [
        (
            "(held Tea)",
            [],
            "no plan reaches the goal (held tea)",
            "go did not need (open ?to), or if take did not need (at ?p), or if take did not need (in ?b",
        ),
        (
            "(lit hall)",
            [],
            "no plan reaches the goal (lit hall)",
            "No action makes (lit hall) true: add one, or state it in the problem.",
        ),
        (
            "(at kitchen)",
            [("(open hall)", "(open hall) (open kitchen)")],
            "each goal has a plan, and no plan reaches all of them",
            "It would be possible without (at hall) or (at kitchen).",
        ),
        (
            "(held tea)",
            [("(in tea kitchen)", ""), ("(and (at ?p) (in", "(and (at ?p) (lit ?p) (in")],
            "no plan reaches the goal (held tea)",
            "No single condition of an action stands in the way",
        ),
    ],
)
def test_the_goal_and_the_condition_are_named(own, goal, changes, reason, remedy):
    with pytest.raises(NoPlan) as failed:
        plan_custom(own(goal, *changes))
    assert failed.value.reason == reason
    assert remedy in failed.value.remedy


MAXIMIZE = ("(at hall) (held tea)))", "(at hall) (held tea))) (:metric maximize (joy))")
WITH_JOY = DOMAIN.replace("(:action go", "(:functions (joy))\n  (:action go").replace(
    "(held ?b) (not", "(held ?b) (increase (joy) 1) (not"
)


def test_a_metric_to_maximize_is_named_as_what_no_engine_can(own, monkeypatch):
    from comity_domain.custom.solving import choosing

    monkeypatch.setattr(choosing, "_can", lambda *_: False)
    joy = ("(in tea kitchen)", "(in tea kitchen) (= (joy) 0)")
    bound = own("(held tea)", joy, MAXIMIZE, domain=WITH_JOY)
    with pytest.raises(
        PlanningFailed, match=r"a metric to maximize \(.*p\.pddl:5:\d+\)\. Minimize what is lost instead"
    ):
        plan_custom(bound)


def test_what_is_more_than_classical_is_named_where_options_are_refused():
    binding = Binding(
        actions={"take": ActionBinding(person="b", options={"p": Option(parameter="greeting_gesture")})}
    )
    with pytest.raises(BindingRefusedError, match="options beside a metric to maximize"):
        refuse_options(binding, "a metric to maximize")
