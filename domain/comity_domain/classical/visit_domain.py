"""The visit domain as a unified-planning problem: what each action needs, does and costs.

`visit.pddl` expresses the same with comments, for readers and for PDDL tools; a test compares the two. Costs
are whole centimetres of travel, or their equivalent: a less preferred option costs 100 * weight *
-ln(desirability), with the weight in metres and the desirability in [0, 1].
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import Any

from unified_planning.environment import Environment, get_environment
from unified_planning.model import Fluent, InstantaneousAction, Problem, Variable
from unified_planning.model.metrics import MinimizeActionCosts

from comity_domain.plans.actions import (
    FETCH,
    GREET,
    GREET_TOGETHER,
    LEAVE,
    OFFER,
    REACH,
    RETURN,
    SKIP,
)
from comity_domain.problem.agenda import PLAIN, PlainTask

TYPES: Mapping[str, str | None] = {
    **dict.fromkeys(("robot", "place", "side", "modality", "gesture", "company", "turn", "task", "thing")),
    "user": "place",
    "location": "place",
}
"""Each type with its supertype: people are places, and the robot stands on one of their sides."""

STATES: Mapping[str, str] = {
    # state that changes
    "at": "robot place side",
    "docked": "robot place",
    "free": "robot",
    "holds": "robot thing",
    "greeted": "user",
    "due": "task",
    "done": "task",
    "whole": "company",
    "waits": "user",
    "skipped": "user",
    "now": "turn",
    # what the person and the map allow
    "reachable": "user side",
    "permitted": "user modality gesture",
    "route": "place side user side",
    "after": "user user",
    "dropped": "user",
    "way_to": "place side location side",
    # what the hands permit
    "empty": "thing",
    "suits": "thing user",
    "leaves_open": "thing gesture",
    # agendas
    "begun": "user",
    "only_greeted": "user",
    "opens": "user task",
    "follows": "task task",
    "last": "task",
    "of": "task user",
    **{kind.fact: "task" for kind in PLAIN},
    "farewell": "task",
    "brings": "task thing",
    "first_brought": "task",
    "kept": "thing location",
    # groups of people
    "member": "user company",
    "overlooks": "company user side",
    "welcome": "company modality gesture",
    # counting of greeted people
    "lasts": "turn",
    "then": "turn turn",
    "then_together": "company turn turn",
}
"""Predicates with the types of their arguments; `visit.pddl` explains each."""

NUMBERS: Mapping[str, str] = {
    "travel_cost": "place side user side",
    "fetch_cost": "place side location",
    "greet_cost": "user modality gesture turn",
    "greet_together_cost": "company user side modality gesture turn",
    "leave_cost": "user modality gesture",
    "skip_cost": "user",
    # parameters bound at planning time, rounded; the plan has them at full precision
    "distance_mm": "user",
    "speed_mm_s": "user",
    "direction_mdeg": "user side",
    **{number: "task" for kind in PLAIN for number in kind.thousandths},
}
"""Numeric fluents (whole numbers >= 0) with the types of their arguments."""

Priced = tuple[InstantaneousAction, Any]
"""An action and its cost: a fluent of its parameters, or a number."""
NOTHING = 0


def empty_problem(name: str, environment: Environment | None = None) -> Problem:
    """The domain without any objects.

    Args:
        name: Name of the problem.
        environment: The environment of its parts; None: unified-planning's global one, the only one in which
            its release 1.3 grounds actions.
    """
    return _Domain(get_environment(environment)).problem(name)


class _Domain:
    """Builds the actions: types, fluents and connectives."""

    def __init__(self, environment: Environment) -> None:
        types, number = environment.type_manager, environment.type_manager.IntType()
        self._environment = environment
        self._types: dict[str, Any] = {}
        for name, above in TYPES.items():
            self._types[name] = types.UserType(name, None if above is None else self._types[above])
        states = {name: self._fluent(name, types.BoolType(), of) for name, of in STATES.items()}
        numbers = {name: self._fluent(name, number, of) for name, of in NUMBERS.items()}
        self.fluents = {**states, **numbers}
        self._is = SimpleNamespace(**self.fluents)
        """`self._is.greeted(u)` is the condition that `u` was greeted."""
        join = environment.expression_manager
        self._and, self._or, self._not = join.And, join.Or, join.Not

    def problem(self, name: str) -> Problem:
        problem = Problem(name, self._environment)
        for fluent in self.fluents.values():
            problem.add_fluent(fluent, default_initial_value=0 if fluent.name in NUMBERS else False)
        actions = (
            self._reach_user(),
            self._greet_person(),
            self._greet_company(),
            self._fetch(),
            self._return_to_user(),
            *map(self._plain, PLAIN),
            self._offer(),
            self._take_leave(),
            self._skip_visit(),
        )
        priced = dict(actions)
        problem.add_actions(priced)
        problem.add_quality_metric(MinimizeActionCosts(priced, environment=self._environment))
        return problem

    def _fluent(self, name: str, kind: Any, of: str) -> Fluent:
        arguments = OrderedDict((f"x{i}", self._types[t]) for i, t in enumerate(of.split()))
        return Fluent(name, kind, arguments, environment=self._environment)

    def _action(self, name: str, **parameters: str) -> tuple[InstantaneousAction, Sequence[Any]]:
        """An action and its parameters, each given with its type."""
        types = OrderedDict((p, self._types[t]) for p, t in parameters.items())
        action = InstantaneousAction(name, types, self._environment)
        return action, action.parameters

    def _any(self, name: str, kind: str) -> Variable:
        return Variable(name, self._types[kind], self._environment)

    def _reach_user(self) -> Priced:
        """Go to a person and dock at their conversational distance, from one of their sides.

        A visit in progress continues with its remaining tasks. A visit is finished before the robot goes on.
        """
        act, (r, u, s, origin, origin_side, h) = self._action(
            REACH, r="robot", u="user", s="side", origin="place", origin_side="side", h="thing"
        )
        holds, t, v = self._is, self._any("t", "task"), self._any("v", "user")
        act.add_precondition(holds.free(r))
        act.add_precondition(holds.at(r, origin, origin_side))
        act.add_precondition(holds.holds(r, h))
        act.add_precondition(holds.suits(h, u))
        act.add_precondition(self._or(self._not(holds.greeted(u)), holds.begun(u)))
        act.add_precondition(self._not(holds.waits(u)))
        act.add_precondition(holds.reachable(u, s))
        act.add_precondition(holds.route(origin, origin_side, u, s))
        act.add_effect(holds.at(r, u, s), True)
        act.add_effect(holds.docked(r, u), True)
        act.add_effect(holds.at(r, origin, origin_side), False)
        act.add_effect(holds.docked(r, origin), False)
        act.add_effect(holds.due(t), True, self._and(holds.begun(u), holds.opens(u, t)), forall=[t])
        act.add_effect(holds.waits(v), False, holds.after(v, u), forall=[v])
        act.add_effect(holds.free(r), False)
        return act, holds.travel_cost(origin, origin_side, u, s)

    def _greet_person(self) -> Priced:
        """Greet the person the robot is docked to: in words, with a gesture, or both.

        Words alone take the gesture `none`.
        """
        act, (r, u, m, g, k, following, h) = self._action(
            GREET,
            **{"r": "robot", "u": "user", "m": "modality", "g": "gesture"},
            **{"k": "turn", "next": "turn", "h": "thing"},
        )
        holds, t, c = self._is, self._any("t", "task"), self._any("c", "company")
        act.add_precondition(holds.docked(r, u))
        act.add_precondition(self._not(holds.greeted(u)))
        act.add_precondition(holds.permitted(u, m, g))
        act.add_precondition(holds.holds(r, h))
        act.add_precondition(holds.leaves_open(h, g))
        act.add_precondition(holds.now(k))
        act.add_precondition(holds.then(k, following))
        act.add_effect(holds.greeted(u), True)
        act.add_effect(holds.now(k), False, self._not(holds.lasts(k)))
        act.add_effect(holds.now(following), True)
        act.add_effect(holds.free(r), True, holds.only_greeted(u))
        act.add_effect(holds.due(t), True, holds.opens(u, t), forall=[t])
        act.add_effect(holds.whole(c), False, holds.member(u, c), forall=[c])
        return act, holds.greet_cost(u, m, g, k)

    def _greet_company(self) -> Priced:
        """Greet a whole company at once, docked where all of them see and hear the robot."""
        act, (r, c, u, s, m, g, k, following) = self._action(
            GREET_TOGETHER,
            **{"r": "robot", "c": "company", "u": "user", "s": "side", "m": "modality", "g": "gesture"},
            **{"k": "turn", "next": "turn"},
        )
        holds, v, w = self._is, self._any("v", "user"), self._any("w", "user")
        act.add_precondition(holds.docked(r, u))
        act.add_precondition(holds.at(r, u, s))
        act.add_precondition(holds.whole(c))
        act.add_precondition(holds.overlooks(c, u, s))
        act.add_precondition(holds.welcome(c, m, g))
        act.add_precondition(holds.now(k))
        act.add_precondition(holds.then_together(c, k, following))
        act.add_effect(holds.whole(c), False)
        act.add_effect(holds.free(r), True)
        act.add_effect(holds.now(k), False, self._not(holds.lasts(k)))
        act.add_effect(holds.now(following), True)
        act.add_effect(holds.greeted(v), True, holds.member(v, c), forall=[v])
        first = self._and(holds.member(w, c), holds.after(v, w))
        act.add_effect(holds.waits(v), False, first, forall=[v, w])
        return act, holds.greet_together_cost(c, u, s, m, g, k)

    def _fetch(self) -> Priced:
        """Fetch an object from its location: before reaching its person, or while they wait for it.

        A fetched object is brought straight to its person.
        """
        act, (r, u, t, h, place, s, origin, origin_side, e) = self._action(
            FETCH,
            **{"r": "robot", "u": "user", "t": "task", "h": "thing", "l": "location", "s": "side"},
            **{"origin": "place", "origin_side": "side", "e": "thing"},
        )
        holds = self._is
        not_greeted = self._or(self._not(holds.greeted(u)), holds.begun(u))
        before = self._and(holds.free(r), holds.first_brought(t), not_greeted)
        act.add_precondition(holds.of(t, u))
        act.add_precondition(holds.brings(t, h))
        act.add_precondition(holds.kept(h, place))
        act.add_precondition(self._or(before, holds.due(t)))
        act.add_precondition(holds.at(r, origin, origin_side))
        act.add_precondition(holds.way_to(origin, origin_side, place, s))
        act.add_precondition(holds.holds(r, e))
        act.add_precondition(holds.empty(e))
        act.add_effect(holds.at(r, place, s), True)
        act.add_effect(holds.holds(r, h), True)
        act.add_effect(holds.at(r, origin, origin_side), False)
        act.add_effect(holds.docked(r, origin), False)
        act.add_effect(holds.holds(r, e), False)
        return act, holds.fetch_cost(origin, origin_side, place)

    def _return_to_user(self) -> Priced:
        """Return to a person with an object fetched during their visit."""
        act, (r, u, s, t, h, origin, origin_side) = self._action(
            RETURN,
            **{"r": "robot", "u": "user", "s": "side", "t": "task", "h": "thing"},
            **{"origin": "location", "origin_side": "side"},
        )
        holds = self._is
        act.add_precondition(holds.of(t, u))
        act.add_precondition(holds.brings(t, h))
        act.add_precondition(holds.due(t))
        act.add_precondition(holds.holds(r, h))
        act.add_precondition(holds.at(r, origin, origin_side))
        act.add_precondition(holds.reachable(u, s))
        act.add_precondition(holds.route(origin, origin_side, u, s))
        act.add_effect(holds.at(r, u, s), True)
        act.add_effect(holds.docked(r, u), True)
        act.add_effect(holds.at(r, origin, origin_side), False)
        return act, holds.travel_cost(origin, origin_side, u, s)

    def _plain(self, kind: type[PlainTask]) -> Priced:
        """Do a task without a choice: say a message, or wait."""
        act, (r, u, t) = self._action(kind.action, r="robot", u="user", t="task")
        self._before_user(act, r, u, t)
        act.add_precondition(self.fluents[kind.fact](t))
        self._finish(act, r, t)
        return act, NOTHING

    def _offer(self) -> Priced:
        """Hand over the object that the robot holds."""
        act, (r, u, t, h, e) = self._action(OFFER, r="robot", u="user", t="task", h="thing", e="thing")
        holds = self._is
        self._before_user(act, r, u, t)
        act.add_precondition(holds.brings(t, h))
        act.add_precondition(holds.holds(r, h))
        act.add_precondition(holds.empty(e))
        act.add_effect(holds.holds(r, h), False)
        act.add_effect(holds.holds(r, e), True)
        self._finish(act, r, t)
        return act, NOTHING

    def _take_leave(self) -> Priced:
        """Say goodbye, in words, with a gesture, or both, and step away."""
        act, (r, u, t, m, g, h) = self._action(
            LEAVE, r="robot", u="user", t="task", m="modality", g="gesture", h="thing"
        )
        holds = self._is
        self._before_user(act, r, u, t)
        act.add_precondition(holds.farewell(t))
        act.add_precondition(holds.permitted(u, m, g))
        act.add_precondition(holds.holds(r, h))
        act.add_precondition(holds.leaves_open(h, g))
        act.add_effect(holds.done(t), True)
        act.add_effect(holds.due(t), False)
        act.add_effect(holds.free(r), True)
        return act, holds.leave_cost(u, m, g)

    def _skip_visit(self) -> Priced:
        """Drop a visit at its cost; which ones is decided before."""
        act, (_, u) = self._action(SKIP, r="robot", u="user")
        act.add_precondition(self._is.dropped(u))
        act.add_effect(self._is.skipped(u), True)
        return act, self._is.skip_cost(u)

    def _before_user(self, act: InstantaneousAction, r: Any, u: Any, t: Any) -> None:
        """Require that the robot is docked to the task's person and that the task is due."""
        act.add_precondition(self._is.of(t, u))
        act.add_precondition(self._is.docked(r, u))
        act.add_precondition(self._is.due(t))

    def _finish(self, act: InstantaneousAction, r: Any, t: Any) -> None:
        """After a task the next one is due; after the last one the robot may go on."""
        holds, following = self._is, self._any("n", "task")
        act.add_effect(holds.done(t), True)
        act.add_effect(holds.due(t), False)
        act.add_effect(holds.due(following), True, holds.follows(t, following), forall=[following])
        act.add_effect(holds.free(r), True, holds.last(t))
