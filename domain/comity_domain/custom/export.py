"""Exports a bound problem as PDDL for other planners: integer costs, and a record of renamed items."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.custom.reading.reading import COST
from comity_domain.custom.solving.bound import Bound
from comity_domain.custom.solving.stated import stated

if TYPE_CHECKING:
    from unified_planning.io import PDDLWriter
    from unified_planning.model import Action, Fluent, Object, Type


@dataclass(frozen=True, slots=True)
class CustomPddl:
    """The exported PDDL."""

    domain: str
    problem: str
    renamed: Mapping[str, str]
    """New names of items that could not keep theirs, by kind and name, such as `object bow`."""


def custom_pddl(bound: Bound) -> CustomPddl:
    """The planner's problem as PDDL; any planner with action costs finds the same cost for it."""
    from unified_planning.io import PDDLWriter

    writer = PDDLWriter(stated(bound.problem))
    domain, problem = writer.get_domain(), writer.get_problem()
    renamed = dict(_renamed(writer, bound))
    comment = "".join(f"; {line}\n" for line in _legend(bound, renamed))
    # unified-planning makes up its own names for these two.
    name = bound.own.domain_name
    domain = re.sub(r"\(domain [^)]*\)", f"(domain {name})", domain, count=1)
    problem = re.sub(r"\(:domain [^)]*\)", f"(:domain {name})", problem, count=1)
    problem = re.sub(r"\(problem [^)]*\)", f"(problem {bound.own.problem_name})", problem, count=1)
    return CustomPddl(comment + domain, comment + problem, renamed)


def _renamed(writer: PDDLWriter, bound: Bound) -> Iterator[tuple[str, str]]:
    problem = bound.problem
    kinds = {
        "type": problem.user_types,
        "fluent": problem.fluents,
        "action": problem.actions,
        "object": problem.all_objects,
    }
    for kind, items in kinds.items():
        for item in items:
            written = bound.own.as_written(item.name)
            pddl = _name(writer, item)
            if pddl is not None and pddl.lower() != written.lower():
                yield f"{kind} {written}", pddl
    for action in problem.actions:
        if _name(writer, action) is None:
            continue
        for parameter in action.parameters:
            pddl = writer.get_pddl_name(parameter)
            if pddl.lstrip("?") != parameter.name:
                yield f"argument {parameter.name} of {bound.own.as_written(action.name)}", pddl


def _name(writer: PDDLWriter, item: Action | Fluent | Object | Type) -> str | None:
    """The name in the PDDL; None for `object` and for an action that can never be applied."""
    from unified_planning.exceptions import UPException

    try:
        return str(writer.get_pddl_name(item))
    except UPException:
        return None


def _legend(bound: Bound, renamed: Mapping[str, str]) -> Iterator[str]:
    if bound.classical:
        yield f"A cost of {bound.binding.cost_scale} here is 1 of the domain's own."
    for name in bound.dropped:
        if name != COST:
            yield f"{bound.own.as_written(name)} is in the costs, and left out because it is no whole number."
    for name, ruling in bound.rulings.items():
        yield f"{ruling} says with which objects {bound.own.as_written(name)} is permitted and has a cost."
    for written, pddl in renamed.items():
        yield f"{pddl} is the {written}."
