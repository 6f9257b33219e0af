"""Conditions inside each other are read as one: an action changes what its text says."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sampled
from unified_planning.engines import UPSequentialSimulator

from comity_domain.custom import bind, plan_custom
from comity_domain.custom.pddl.form import MAX_WORDS, parse_form
from comity_domain.custom.pddl.reading import CustomProblem, as_global, from_forms
from comity_fis import InputError

OBJECTS = ("one", "two")
DOMAIN = """(define (domain lamps)
  (:requirements :adl)
  (:types lamp)
  (:predicates (power) (paid) (wired ?x - lamp) (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect {effect}))
"""
PROBLEM = """(define (problem now) (:domain lamps)
  (:objects one two - lamp) (:init {facts}) (:goal (lit one)))
"""
FACTS = ("(power)", "(paid)", "(wired one)", "(wired two)")


def read(effect: str, facts: str = "") -> CustomProblem:
    domain, problem = DOMAIN.format(effect=effect), PROBLEM.format(facts=facts)
    return from_forms(parse_form(domain, "domain.pddl"), parse_form(problem, "problem.pddl"))


def conditions(variables):
    names = st.sampled_from(variables)
    simple = st.one_of(st.sampled_from(["(power)", "(paid)"]), names.map("(wired {})".format))
    return st.one_of(
        simple,
        simple.map("(not {})".format),
        st.just("(exists (?z - lamp) (wired ?z))"),
        st.lists(simple, max_size=2).map(lambda several: f"(and {' '.join(several)})"),
    )


def effects(variables=("?x",), depth=3):
    """Effects of so many layers; only one of them is for all lamps, as unified-planning wants it."""
    lit = st.sampled_from(variables).map("(lit {})".format)
    if not depth:
        return lit
    inner = effects(variables, depth - 1)
    found = [
        st.lists(inner, min_size=1, max_size=2).map(lambda several: f"(and {' '.join(several)})"),
        st.tuples(conditions(variables), inner).map(lambda pair: f"(when {pair[0]} {pair[1]})"),
    ]
    if len(variables) == 1:
        every = effects((*variables, "?y"), depth - 1)
        found.append(every.map("(forall (?y - lamp) {})".format))
    return st.one_of(found)


def holds(form, facts, bound) -> bool:
    if form.head == "and":
        return all(holds(part, facts, bound) for part in form.rest)
    if form.head == "not":
        return not holds(form.rest[0], facts, bound)
    if form.head == "exists":
        return any(holds(form.rest[1], facts, {**bound, "?z": name}) for name in OBJECTS)
    return f"({' '.join(bound.get(str(word), str(word)) for word in form.items)})" in facts


def lights(form, facts, bound) -> set[str]:
    """Which lamps an effect lights, by the meaning of its words: another reading than the package's."""
    if form.head == "and":
        return set().union(*(lights(part, facts, bound) for part in form.rest))
    if form.head == "when":
        return lights(form.rest[1], facts, bound) if holds(form.rest[0], facts, bound) else set()
    if form.head == "forall":
        return set().union(*(lights(form.rest[1], facts, {**bound, "?y": name}) for name in OBJECTS))
    return {bound[str(form.rest[0])]}


@sampled(10)
@given(effect=effects(), facts=st.sets(st.sampled_from(FACTS)))
def test_an_action_changes_what_its_text_says_however_conditions_are_nested(effect, facts):
    problem = read(effect, " ".join(sorted(facts))).problem
    with as_global(problem.environment):
        simulator = UPSequentialSimulator(problem, error_on_failed_checks=False)
        one, lit = problem.object("one"), problem.fluent("lit")
        after = simulator.apply(simulator.get_initial_state(), problem.action("switch"), (one,))
        seen = {name for name in OBJECTS if after.get_value(lit(problem.object(name))).is_true()}
    assert seen == lights(parse_form(effect, "effect"), facts, {"?x": "one"})


NESTED = "(when (power) (and (when (paid) (lit ?x))))"


@pytest.mark.parametrize("facts", ["", "(power)", "(paid)", "(power) (paid)"])
def test_a_goal_is_reached_only_where_all_conditions_hold(facts):
    bound = bind(read(NESTED, facts))
    if facts == "(power) (paid)":
        plan = plan_custom(bound).plan
        assert len(plan.steps) == 1
        assert plan.optimal
    else:
        with pytest.raises(Exception, match="no plan reaches"):
            plan_custom(bound)


def test_conditions_are_joined_in_effects_with_a_time_too():
    text = DOMAIN.format(effect=f"(and (at start {NESTED}) (at end (lit ?x)))")
    text = text.replace(":action", ":durative-action").replace(":effect", ":duration (= ?duration 2) :effect")
    problem = parse_form(PROBLEM.format(facts=""), "problem.pddl")
    action = from_forms(parse_form(text, "domain.pddl"), problem).problem.action("switch")
    conditions = {str(effect.condition) for several in action.effects.values() for effect in several}
    assert conditions == {"(power and paid)", "true"}


def test_a_variable_that_hides_one_of_an_outer_condition_is_placed():
    with pytest.raises(InputError, match=r"wired \?x") as refused:
        read("(when (wired ?x) (forall (?x - lamp) (when (power) (lit ?x))))")
    assert (refused.value.where.file, refused.value.where.line) == ("domain.pddl", 7)
    assert refused.value.where.column == 38
    assert "something else" in refused.value.remedy


def test_a_condition_that_would_be_repeated_too_often_is_refused_at_once():
    long = f"(and {'(power) ' * 2000})"
    with pytest.raises(InputError, match=f"at most {MAX_WORDS} words once conditions"):
        read(f"(when {long} (and {'(when (paid) (lit ?x)) ' * 2000}))")
