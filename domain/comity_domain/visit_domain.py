"""The planning domain of visits in unified-planning: types, fluents and the actions.

`visit.pddl` says the same in PDDL, with comments; a test keeps them equal. The encoding is tight on purpose:
once docked, the robot must greet before it may leave, and nobody is visited twice. That leaves little to
search beside the order, the sides and the greetings.

A company that is greeted at once is an effect on all its members. The condition of that effect never
changes, so that Fast Downward grounds it away: its heuristics know no conditional effects. Turns count the
people who were greeted; where nobody has a priority there is only one turn, followed by itself.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.environment import Environment
    from unified_planning.model import FNode, InstantaneousAction, Parameter, Problem, Type, Variable

Signature = Mapping[str, str]
"""Parameter names with their types."""

SUPERTYPES: Mapping[str, str | None] = {
    "robot": None,
    "place": None,
    "user": "place",
    "side": None,
    "modality": None,
    "gesture": None,
    "company": None,
    "turn": None,
}

_LEG: Signature = {"from": "place", "from_side": "side", "u": "user", "s": "side"}
_WAY: Signature = {"m": "modality", "g": "gesture"}
_GREETING: Signature = {"u": "user", **_WAY}
_TOGETHER: Signature = {"c": "company", "u": "user", "s": "side"}

PREDICATES: Mapping[str, Signature] = {
    "at": {"r": "robot", "p": "place", "s": "side"},
    "docked": {"r": "robot", "p": "place"},
    "free": {"r": "robot"},
    "greeted": {"u": "user"},
    "whole": {"c": "company"},
    "now": {"k": "turn"},
    "reachable": {"u": "user", "s": "side"},
    "permitted": _GREETING,
    "route": _LEG,
    "member": {"u": "user", "c": "company"},
    "overlooks": _TOGETHER,
    "welcome": {"c": "company", **_WAY},
    "then": {"k": "turn", "next": "turn"},
    "then_together": {"c": "company", "k": "turn", "next": "turn"},
}

# One integer function per action cost, all fused into it: Fast Downward refuses sums, reals and negatives.
FUNCTIONS: Mapping[str, Signature] = {
    "travel_cost": _LEG,
    "greet_cost": {**_GREETING, "k": "turn"},
    "greet_together_cost": {**_TOGETHER, **_WAY, "k": "turn"},
    "distance_mm": {"u": "user"},
    "speed_mm_s": {"u": "user"},
    "direction_mdeg": {"u": "user", "s": "side"},
}


def visit_domain(environment: Environment) -> Problem:
    """A problem with the domain only: no objects, no initial state, no goals."""
    from unified_planning.model import Problem
    from unified_planning.model.metrics import MinimizeActionCosts

    problem = Problem("visit", environment)
    _add_fluents(problem)
    reach, greet, together = _reach_user(problem), _greet_person(problem), _greet_company(problem)
    problem.add_actions([reach, greet, together])
    costs = {
        reach: _fluent(reach, problem, "travel_cost", "from", "from_side", "u", "s"),
        greet: _fluent(greet, problem, "greet_cost", "u", "m", "g", "k"),
        together: _fluent(together, problem, "greet_together_cost", "c", "u", "s", "m", "g", "k"),
    }
    problem.add_quality_metric(MinimizeActionCosts(costs, environment=environment))
    return problem


def _add_fluents(problem: Problem) -> None:
    from unified_planning.model import Fluent

    environment = problem.environment
    types = environment.type_manager
    for name, signature in PREDICATES.items():
        fluent = Fluent(name, types.BoolType(), _typed(environment, signature), environment)
        problem.add_fluent(fluent, default_initial_value=False)
    for name, signature in FUNCTIONS.items():
        problem.add_fluent(Fluent(name, types.IntType(), _typed(environment, signature), environment))


def _reach_user(problem: Problem) -> InstantaneousAction:
    signature = {"r": "robot", "u": "user", "s": "side", "from": "place", "from_side": "side"}
    reach = _action(problem, "Reach_user", signature)
    start = _fluent(reach, problem, "at", "r", "from", "from_side")
    free = _fluent(reach, problem, "free", "r")
    reach.add_precondition(free)
    reach.add_precondition(start)
    reach.add_precondition(
        problem.environment.expression_manager.Not(_fluent(reach, problem, "greeted", "u"))
    )
    reach.add_precondition(_fluent(reach, problem, "reachable", "u", "s"))
    reach.add_precondition(_fluent(reach, problem, "route", "from", "from_side", "u", "s"))
    reach.add_effect(_fluent(reach, problem, "at", "r", "u", "s"), True)
    reach.add_effect(_fluent(reach, problem, "docked", "r", "u"), True)
    reach.add_effect(start, False)
    reach.add_effect(_fluent(reach, problem, "docked", "r", "from"), False)
    reach.add_effect(free, False)
    return reach


def _greet_person(problem: Problem) -> InstantaneousAction:
    signature = {"r": "robot", "u": "user", "m": "modality", "g": "gesture", "k": "turn", "next": "turn"}
    greet = _action(problem, "Greet_person", signature)
    greet.add_precondition(_fluent(greet, problem, "docked", "r", "u"))
    greet.add_precondition(_fluent(greet, problem, "permitted", "u", "m", "g"))
    _take_turn(greet, problem, _fluent(greet, problem, "then", "k", "next"))
    greet.add_effect(_fluent(greet, problem, "greeted", "u"), True)
    company = _variable(problem, "c", "company")
    member = problem.fluent("member")(greet.parameter("u"), company)
    greet.add_effect(problem.fluent("whole")(company), False, condition=member, forall=[company])
    return greet


def _greet_company(problem: Problem) -> InstantaneousAction:
    signature = {
        **{"r": "robot", "c": "company", "u": "user", "s": "side"},
        **{"m": "modality", "g": "gesture", "k": "turn", "next": "turn"},
    }
    greet = _action(problem, "Greet_company", signature)
    greet.add_precondition(_fluent(greet, problem, "docked", "r", "u"))
    greet.add_precondition(_fluent(greet, problem, "at", "r", "u", "s"))
    greet.add_precondition(_fluent(greet, problem, "whole", "c"))
    greet.add_precondition(_fluent(greet, problem, "overlooks", "c", "u", "s"))
    greet.add_precondition(_fluent(greet, problem, "welcome", "c", "m", "g"))
    _take_turn(greet, problem, _fluent(greet, problem, "then_together", "c", "k", "next"))
    greet.add_effect(_fluent(greet, problem, "whole", "c"), False)
    user = _variable(problem, "v", "user")
    member = problem.fluent("member")(user, greet.parameter("c"))
    greet.add_effect(problem.fluent("greeted")(user), True, condition=member, forall=[user])
    return greet


def _take_turn(greet: InstantaneousAction, problem: Problem, then: FNode) -> None:
    """What every greeting does: the turn passes on, and the robot may leave."""
    greet.add_precondition(_fluent(greet, problem, "now", "k"))
    greet.add_precondition(then)
    greet.add_effect(_fluent(greet, problem, "now", "k"), False)
    greet.add_effect(_fluent(greet, problem, "now", "next"), True)
    greet.add_effect(_fluent(greet, problem, "free", "r"), True)


def _action(problem: Problem, name: str, signature: Signature) -> InstantaneousAction:
    from unified_planning.model import InstantaneousAction

    environment = problem.environment
    parameters = OrderedDict((p.name, p.type) for p in _typed(environment, signature))
    return InstantaneousAction(name, parameters, environment)


def _fluent(action: InstantaneousAction, problem: Problem, name: str, *parameters: str) -> FNode:
    """A fluent over an action's parameters."""
    return problem.fluent(name)(*(action.parameter(parameter) for parameter in parameters))


def _variable(problem: Problem, name: str, type_name: str) -> Variable:
    """What an effect ranges over."""
    from unified_planning.model import Variable

    return Variable(name, _type(problem.environment, type_name), problem.environment)


def _typed(environment: Environment, signature: Signature) -> list[Parameter]:
    from unified_planning.model import Parameter

    return [
        Parameter(name, _type(environment, type_name), environment) for name, type_name in signature.items()
    ]


def _type(environment: Environment, name: str) -> Type:
    above = SUPERTYPES[name]
    return environment.type_manager.UserType(name, _type(environment, above) if above else None)
