"""The planning domain of visits in unified-planning: types, fluents and the two actions.

`visit.pddl` says the same in PDDL, with comments; a test keeps them equal. The encoding is tight on purpose:
once docked, the robot must greet before it may leave, and nobody is visited twice. That leaves little to
search beside the order, the sides and the greetings.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.environment import Environment
    from unified_planning.model import FNode, InstantaneousAction, Parameter, Problem, Type

Signature = Mapping[str, str]
"""Parameter names with their types."""

SUPERTYPES: Mapping[str, str | None] = {
    "robot": None,
    "place": None,
    "user": "place",
    "side": None,
    "modality": None,
    "gesture": None,
}

_LEG: Signature = {"from": "place", "from_side": "side", "u": "user", "s": "side"}
_GREETING: Signature = {"u": "user", "m": "modality", "g": "gesture"}

PREDICATES: Mapping[str, Signature] = {
    "at": {"r": "robot", "p": "place", "s": "side"},
    "docked": {"r": "robot", "p": "place"},
    "free": {"r": "robot"},
    "greeted": {"u": "user"},
    "reachable": {"u": "user", "s": "side"},
    "permitted": _GREETING,
    "route": _LEG,
}

# One integer function per action cost, all fused into it: Fast Downward refuses sums, reals and negatives.
FUNCTIONS: Mapping[str, Signature] = {
    "travel_cost": _LEG,
    "greet_cost": _GREETING,
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
    reach, greet = _reach_user(problem), _greet_person(problem)
    problem.add_actions([reach, greet])
    costs = {
        reach: _fluent(reach, problem, "travel_cost", "from", "from_side", "u", "s"),
        greet: _fluent(greet, problem, "greet_cost", "u", "m", "g"),
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
    signature = {"r": "robot", "u": "user", "m": "modality", "g": "gesture"}
    greet = _action(problem, "Greet_person", signature)
    greet.add_precondition(_fluent(greet, problem, "docked", "r", "u"))
    greet.add_precondition(_fluent(greet, problem, "permitted", "u", "m", "g"))
    greet.add_effect(_fluent(greet, problem, "greeted", "u"), True)
    greet.add_effect(_fluent(greet, problem, "free", "r"), True)
    return greet


def _action(problem: Problem, name: str, signature: Signature) -> InstantaneousAction:
    from unified_planning.model import InstantaneousAction

    environment = problem.environment
    parameters = OrderedDict((p.name, p.type) for p in _typed(environment, signature))
    return InstantaneousAction(name, parameters, environment)


def _fluent(action: InstantaneousAction, problem: Problem, name: str, *parameters: str) -> FNode:
    """A fluent over an action's parameters."""
    return problem.fluent(name)(*(action.parameter(parameter) for parameter in parameters))


def _typed(environment: Environment, signature: Signature) -> list[Parameter]:
    from unified_planning.model import Parameter

    def typed(name: str) -> Type:
        above = SUPERTYPES[name]
        return environment.type_manager.UserType(name, typed(above) if above else None)

    return [Parameter(name, typed(type_name), environment) for name, type_name in signature.items()]
