"""The readable PDDL file and the code say the same."""

from __future__ import annotations

import pytest
from unified_planning.environment import Environment, get_environment
from unified_planning.io import PDDLReader

from comity_domain.pddl import domain_pddl
from comity_domain.visit_domain import visit_domain

ANY_PROBLEM = """
(define (problem any) (:domain visit-domain)
  (:init (= (total-cost) 0)) (:goal (and)) (:metric minimize (total-cost)))
"""


@pytest.fixture(scope="module")
def written():
    # unified-planning 1.3 reads costs in its global environment only
    return PDDLReader(get_environment()).parse_problem_string(domain_pddl(), ANY_PROBLEM)


@pytest.fixture(scope="module")
def built():
    return visit_domain(Environment())


def signature(named):
    parameters = named.signature if hasattr(named, "signature") else named.parameters
    return [(parameter.name.lower(), parameter.type.name.lower()) for parameter in parameters]


def supertypes(problem):
    return {t.name: t.father.name if t.father else None for t in problem.user_types}


def literals(expressions):
    """Conjuncts as text: PDDL has one conjunction where the code has several preconditions."""
    parts = [part for e in expressions for part in (e.args if e.is_and() else [e])]
    return {str(part).lower() for part in parts}


def actions(problem):
    return {action.name.lower(): action for action in problem.actions}


def test_the_types_are_equal(written, built):
    assert supertypes(written) == supertypes(built)


def test_the_fluents_are_equal(written, built):
    """Apart from the sort of number: PDDL knows only one."""

    def fluents(problem):
        return {f.name: (signature(f), f.type.is_bool_type()) for f in problem.fluents}

    assert fluents(written) == fluents(built)


def test_the_actions_are_equal(written, built):
    assert (
        actions(written).keys()
        == actions(built).keys()
        == {
            *("reach_user", "greet_person", "greet_company"),
        }
    )
    for name, action in actions(built).items():
        twin = actions(written)[name]
        assert signature(twin) == signature(action)
        assert literals(twin.preconditions) == literals(action.preconditions)
        assert {str(e) for e in twin.effects} == {str(e) for e in action.effects}


def test_the_costs_are_equal(written, built):
    def costs(problem):
        (metric,) = problem.quality_metrics
        return {name: str(metric.get_action_cost(action)) for name, action in actions(problem).items()}

    assert costs(written) == costs(built)
    assert costs(built)["greet_person"] == "greet_cost(u, m, g, k)"
