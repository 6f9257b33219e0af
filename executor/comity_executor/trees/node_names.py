"""What nodes may be called, for any person: read off a tree in which everything is done."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from functools import cache

from comity_domain.plans.actions import FETCH, GREET, GREET_TOGETHER, OFFER, REACH, TASKS
from comity_domain.plans.plan import Plan, PlanStep, StepExplanation
from comity_domain.problem.bound_parameters import BEARING, DISTANCE, SPEED
from comity_executor.nodes.limits import Limits
from comity_executor.nodes.node import describe
from comity_executor.robots.scripted import ScriptedRobot
from comity_executor.trees.tree import build_tree
from comity_fis.inference.value import Inference

ONE, MANY = "one", "many"
"""A person who is greeted alone, with an agenda, and a person with company."""
_Kinds = tuple[tuple[str, tuple[str, ...], Mapping[str, float | str]], ...]
"""Of steps: the action, its choices, its parameters."""
_THING: Mapping[str, float | str] = {"thing": "thing", "place": "place"}
_THERE: Mapping[str, float | str] = {
    DISTANCE: 1.0,
    BEARING: 0.0,
    SPEED: 0.3,
}
_ANY: Mapping[str, float | str] = defaultdict(lambda: 1.0, {**_THING, "text": "text", "modality": "both"})
"""What some task of an agenda reads: these words, and else numbers."""
_WORDS = ("verbal", "none")
_FIRST: _Kinds = ((FETCH, (), _THING), (REACH, (), _THERE), (GREET, _WORDS, {}))
_AGENDA: _Kinds = tuple((action, ("thing",) if action == OFFER else _WORDS, _ANY) for action in TASKS)
_TOGETHER: _Kinds = ((REACH, (), _THERE), (GREET_TOGETHER, ("company", *_WORDS), {}))


@cache
def node_names() -> frozenset[str]:
    """The names of nodes up to their bracket, with the usual limits in those of timeouts.

    But for gestures: a rulebook names them.
    """
    steps = (*_steps(ONE, (*_FIRST, *_AGENDA)), *_steps(MANY, _TOGETHER))
    plan = Plan("none", optimal=False, reproducible=True, cost=0, steps=steps)
    nothing = Inference(rulebook="none", mode="exact", inputs={}, parameters={})
    robot = ScriptedRobot({ONE: 1.0, MANY: 1.0})
    tree = build_tree(plan, robot, {ONE: nothing, MANY: nothing}, Limits(attend_s=1.0))
    tree.memory.close()
    return frozenset(node.action for node in describe(tree.root))


def _steps(person: str, kinds: _Kinds) -> tuple[PlanStep, ...]:
    return tuple(
        PlanStep(action, ("robot", person, *choices), None, parameters, 0, StepExplanation("", ()))
        for action, choices, parameters in kinds
    )
