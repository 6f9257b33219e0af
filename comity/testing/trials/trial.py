"""One case, carried out: what expectations are held against."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from comity.episode import Episode
from comity.live_episode import execute
from comity.preparation import Prepared, prepare
from comity.specification.goals import greeted
from comity_executor import is_called, node_names
from comity_executor.memory.meeting import SAY_ACT
from comity_executor.trees.tree import GREETINGS, SKIP
from comity_fis import InputError, closest

if TYPE_CHECKING:
    from comity.testing.trials.case import Case
    from comity_executor import Node, TraceEvent, Visit
    from comity_fis import Inference

MOST_KEPT = 32
"""Episodes of a process that comparisons of profiles need not run again."""


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """What happened in one case."""

    case: Case
    episode: Episode

    @property
    def prepared(self) -> Prepared:
        """What was decided before the world moved."""
        return self.episode.prepared

    @property
    def wanted(self) -> tuple[str, ...]:
        """Whom the goals name, as far as they are not served before the start and not left out on purpose."""
        left_out = {visit.person for visit in self.episode.visits if visit.outcome == "skipped"}
        return tuple(name for name in self.prepared.file.scenario.visited() if name not in left_out)

    @property
    def goals(self) -> tuple[str, ...]:
        """Whom the goals name, served before or not."""
        return tuple(goal for _, goal in greeted(self.prepared.file.scenario.goals))

    @property
    def approached(self) -> tuple[str, ...]:
        """Before whom the robot is to stand, in the plan's order."""
        return tuple(step.person for step in self.prepared.plan.steps if step.action == "Reach_user")

    def visit(self, person: str) -> Visit | None:
        """What came of a visit; None where the plan has none."""
        return next((visit for visit in self.episode.visits if visit.person == person), None)

    def outcome_of(self, person: str) -> str:
        """What came of one person's visit, in a word."""
        visit = self.visit(person)
        if visit is not None:
            return visit.outcome
        return "unreachable" if person in self.prepared.asked.unreachable else "not_asked"

    def judged_s(self, person: str, parameter: str) -> float:
        """When a parameter of somebody counts [s]: that with which their visit was carried out.

        One of a running behaviour, such as the distance, counts as it was when the robot docked last, one of
        an action, such as the gesture, as it was when they were greeted; where there was only one of the
        two, both as they were then. Infinite where there was none: then those of the end count.
        """
        visit, known = self.visit(person), self.prepared.rulebook.parameters.get(parameter)
        if visit is None:
            return math.inf
        times = (visit.greeted_s, visit.docked_s)
        if known is not None and known.kind == "behaviour":
            times = times[::-1]
        return next((time for time in times if time is not None), math.inf)

    def values(self, person: str, parameter: str) -> Inference:
        """Somebody's parameters when one of them counts."""
        return self.episode.values_at(person, self.judged_s(person, parameter))

    def require_goal(self, *people: str) -> None:
        """Refuse a sentence about the visit of somebody whom nobody is to visit: it would hold of nothing.

        Raises:
            InputError: where no goal names them.
        """
        for person in people:
            if person not in self.goals:
                raise InputError(
                    expected="somebody whom the goals name",
                    got=repr(person),
                    remedy=closest(person, self.goals),
                )

    def nodes_named(self, name: str) -> Iterator[Node]:
        """The nodes of a name, which may be given up to its bracket or with it.

        Raises:
            InputError: where the tree has none, and no tree of the scenario could.
        """
        nodes = self.episode.nodes
        found = [node for node in nodes if is_called(node, name)]
        if not found and not self._is_of(self._possible(), name) and not self._is_of_goal(name):
            names = {node.action for node in nodes} | set(self._possible())
            raise InputError(
                expected="a node of the behaviour tree", got=repr(name), remedy=closest(name, names)
            )
        yield from found

    def events_of(self, name: str) -> tuple[TraceEvent, ...]:
        """What the nodes of a name did; nothing where this tree has none.

        Raises:
            InputError: as for `nodes_named`.
        """
        paths = {node.path for node in self.nodes_named(name)}
        return tuple(event for event in self.episode.events if event.path in paths)

    def _is_of(self, names: Iterable[str], name: str) -> bool:
        """Whether it is one of these, alone or with what stands in a node's brackets: who it is about."""
        named = "(" not in name or any(part in self.prepared.file.scenario.people for part in _about(name))
        return named and bare(name) in names

    def _is_of_goal(self, name: str) -> bool:
        """Whether it is another one's node, about somebody who is to be visited: with others, it may be."""
        kinds = {node.action for node in self.episode.nodes}
        return bare(name) in kinds and any(part in self.goals for part in _about(name))

    def _possible(self) -> Iterator[str]:
        """What nodes another profile's tree has, or would have if everybody could be visited."""
        gestures = self.prepared.rulebook.parameters["greeting_gesture"]
        yield from (SAY_ACT, *GREETINGS)
        yield from (gesture.name for gesture in getattr(gestures, "categories", ()))
        if set(self.prepared.file.scenario.visited()) - self._served:
            yield from node_names()

    @property
    def _served(self) -> set[str]:
        """For whom the plan has more than to leave them out."""
        steps = (step for step in self.prepared.plan.steps if step.action != SKIP)
        return {person for step in steps for person in step.people}


def _about(node: str) -> list[str]:
    """What stands in a node's brackets."""
    return node.rpartition("(")[2].rstrip(")").split(", ") if "(" in node else []


def bare(node: str) -> str:
    """A node's name up to its bracket."""
    return node.split("(", maxsplit=1)[0]


def attempted(case: Case) -> Trial:
    """Plan a case and carry it out.

    Raises:
        InputError: if anything that it names cannot be used.
        PlanningFailed: if there is no plan.
    """
    return _attempted(case)


@lru_cache(maxsize=MOST_KEPT)
def _attempted(case: Case) -> Trial:
    return Trial(case, execute(prepared_case(case), seed=case.seed))


def prepared_case(case: Case) -> Prepared:
    """A case with its plan, before the world moves."""
    return prepare(
        case.file,
        profiles=case.profiles,
        rulebook=case.rulebook,
        seed=case.seed,
        at=case.day,
        engine=case.engine,
    )
