"""A metric is looked at, or it is said that nobody did; and the engine that is named plans."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from downward import needs_fast_downward
from hypothesis import given
from hypothesis import strategies as st

from comity_domain.custom import bind, plan_custom, read_custom
from comity_domain.errors import NoEngine
from comity_fis.errors import InputError

WALKS = (
    """(define (domain walks) (:requirements :fluents :typing) (:types s) (:predicates (at ?s - s))
  (:functions (walked) (way ?a ?b - s))
  (:action go :parameters (?a ?b - s) :precondition (at ?a)
    :effect (and (not (at ?a)) (at ?b) (increase (walked) (way ?a ?b)))))""",
    """(define (problem p) (:domain walks) (:objects a b c - s)
  (:init (at a) (= (walked) 0) (= (way a a) 9) (= (way b b) 9) (= (way c c) 9) (= (way a b) 1)
    (= (way b a) 1) (= (way b c) 1) (= (way c b) 1) (= (way a c) 50) (= (way c a) 50))
  (:goal (at c)) (:metric minimize (walked)))""",
)
"""From a to c: two short ways, or one long one."""

CALLS = (
    """(define (domain calls) (:requirements :fluents :typing :negative-preconditions) (:types g)
  (:predicates (met ?g - g)) (:functions (energy) (total-cost))
  (:action hug :parameters (?g - g) :precondition (and (not (met ?g)) (>= (energy) 1))
    :effect (and (met ?g) (decrease (energy) 1) (increase (total-cost) 50)))
  (:action wave :parameters (?g - g) :precondition (and (not (met ?g)) (>= (energy) 1))
    :effect (and (met ?g) (decrease (energy) 1) (increase (total-cost) 2))))""",
    """(define (problem p) (:domain calls) (:objects a b - g) (:init (= (energy) 7) (= (total-cost) 0))
  (:goal (and (met a) (met b))) (:metric minimize (total-cost)))""",
)
"""Numeric, with costs: 4 for two waves, 100 for two hugs."""

TOUR = (
    """(define (domain tour) (:requirements :typing :durative-actions :fluents) (:types room guest)
  (:predicates (at ?x - room) (in ?g - guest ?x - room) (met ?g - guest) (idle))
  (:functions (way ?a ?b - room))
  (:durative-action go :parameters (?a ?b - room) :duration (= ?duration (way ?a ?b))
    :condition (at start (and (at ?a) (idle)))
    :effect (and (at start (and (not (at ?a)) (not (idle)))) (at end (and (at ?b) (idle)))))
  (:durative-action greet :parameters (?g - guest ?x - room) :duration (= ?duration 4)
    :condition (and (over all (at ?x)) (at start (in ?g ?x)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (met ?g)))))""",
    """(define (problem p) (:domain tour) (:objects k s - room g h - guest)
  (:init (at k) (idle) (in g k) (in h s) (= (way k k) 6) (= (way k s) 6) (= (way s k) 6) (= (way s s) 6))
  (:goal (and (met g) (met h))) (:metric minimize (total-time)))""",
)
"""14 s at best: greet for 4 s, go for 6 s, greet for 4 s."""


@pytest.fixture
def own(tmp_path, monkeypatch):
    """Reads a domain and a problem, and binds nobody."""
    monkeypatch.chdir(tmp_path)

    def read(texts: tuple[str, str]):
        Path("d.pddl").write_text(texts[0])
        Path("p.pddl").write_text(texts[1])
        return bind(read_custom(Path("d.pddl"), Path("p.pddl")))

    return read


def engine(bound, name: str):
    from dataclasses import replace

    return replace(bound, engine=name)


def renamed(texts: tuple[str, str], name: str) -> tuple[str, str]:
    domain, problem = (text.replace("walked", name) for text in texts)
    return domain, problem


@needs_fast_downward
@pytest.mark.parametrize("name", ["walked", "effort", "cost", "total-cost"])
def test_a_cost_may_have_any_name(own, name):
    found = plan_custom(own(renamed(WALKS, name)))
    assert [step.arguments for step in found.plan.steps] == [("a", "b"), ("b", "c")]
    assert (found.plan.cost, found.plan.optimal, found.tells_costs) == (2, True, True)
    assert not found.metric_ignored


@needs_fast_downward
def test_several_increases_in_one_action_add_up(own):
    domain = WALKS[0].replace(
        "(increase (walked) (way ?a ?b))", "(increase (walked) 1) (increase (walked) (way ?a ?b))"
    )
    assert plan_custom(own((domain, WALKS[1]))).plan.cost == 4


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("(increase (walked) (way ?a ?b))", "(decrease (walked) 1)"),
        ("(increase (walked) (way ?a ?b))", "(when (at ?b) (increase (walked) 1))"),
        (":precondition (at ?a)", ":precondition (and (at ?a) (<= (walked) 5))"),
    ],
    ids=["decreased", "on a condition", "read by a condition"],
)
def test_a_number_that_is_more_than_a_cost_is_none(own, old, new):
    assert not own((WALKS[0].replace(old, new), WALKS[1])).classical


@needs_fast_downward
@given(st.sampled_from(["walked", "miles", "w"]), st.integers(0, 9), st.integers(0, 30))
def test_the_name_of_a_cost_changes_no_plan(tmp_path_factory, name, short, long):
    """Law: what a cost is called makes no difference to which plan is best, nor to what it costs."""
    folder = tmp_path_factory.mktemp("named")
    problem = (
        WALKS[1].replace("(way b c) 1", f"(way b c) {short}").replace("(way a c) 50", f"(way a c) {long}")
    )
    costs = set()
    for called in (name, "total-cost"):
        domain, stated = renamed((WALKS[0], problem), called)
        (folder / "d.pddl").write_text(domain)
        (folder / "p.pddl").write_text(stated)
        table = bind(read_custom(folder / "d.pddl", folder / "p.pddl")).tables["go"]
        costs.add(tuple(sorted((objects, row.cost) for objects, row in table.rows.items())))
    assert len(costs) == 1


def test_an_engine_that_improves_by_the_metric_is_let_to(own):
    pytest.importorskip("up_aries")
    found = plan_custom(own(TOUR), time_limit_s=4.0)
    assert not found.metric_ignored
    assert max(one.start_s + one.duration_s for one in found.actions) == pytest.approx(14.0, abs=0.5)


def test_where_no_engine_looked_at_the_metric_the_answer_says_so(own, comity):
    pytest.importorskip("up_aries")
    with_table = tuple(
        text.replace("(total-cost))\n", "(total-cost) (price))\n").replace(
            "(= (energy) 7)", "(= (energy) 7) (= (price) 2)"
        )
        for text in (CALLS[0].replace("(total-cost) 2)", "(total-cost) (price))"), CALLS[1])
    )
    own(with_table)
    words = ["plan", "--domain", "d.pddl", "--problem", "p.pddl", "--engine", "aries", "--limit", "20"]
    assert "aries did not look at the metric" in " ".join(comity(*words).out.split())
    answer = comity(*words, "--json").json
    assert answer["own"]["metric_ignored"] is True
    assert answer["optimal"] is not True


def test_java_engines_start_under_the_limit_and_the_one_that_proves_the_metric_is_taken(own):
    pytest.importorskip("up_enhsp")
    if shutil.which("java") is None:
        pytest.skip("needs Java")
    found = plan_custom(own(CALLS))
    assert found.plan.engine == "enhsp-opt"
    assert {step.action for step in found.plan.steps} == {"wave"}
    assert not found.metric_ignored


@needs_fast_downward
def test_the_engine_that_is_named_plans(own):
    found = plan_custom(engine(own(WALKS), "fast-downward-opt"))
    assert (found.plan.engine, found.plan.cost, found.plan.optimal) == ("fast-downward-opt", 2, True)


@needs_fast_downward
def test_an_engine_that_cannot_take_the_problem_is_refused(own):
    with pytest.raises(NoEngine, match="fast-downward-opt does not take this problem"):
        plan_custom(engine(own(CALLS), "fast-downward-opt"))


def test_an_engine_that_is_not_installed_is_refused(own):
    with pytest.raises(InputError, match="--engine"):
        plan_custom(engine(own(WALKS), "fast-upward"))
