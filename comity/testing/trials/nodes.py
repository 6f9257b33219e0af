"""The nodes that a word of a sentence names: `docked?` those of all people, `docked?(host)` one of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.testing.trials.visits import goals_of
from comity_domain.plans.actions import GREETINGS, SKIP
from comity_executor import is_called, node_names
from comity_executor.memory.visit_context import SAY_ACT
from comity_fis import InputError, closest

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.preparation import PlannedEpisode
    from comity_executor import Node, TraceEvent

FORMER_NODES: Mapping[str, str] = {"utter": SAY_ACT}
"""Nodes of the behaviour tree by the names that they had in earlier versions."""


@dataclass(frozen=True, slots=True)
class NodeWord:
    """A word that names nodes, as a sentence writes it: the tree need not have them."""

    action: str
    about: tuple[str, ...]
    """What stands in brackets; empty for the nodes of all people."""

    @classmethod
    def of(cls, word: str) -> NodeWord:
        """From `docked?` or `done?(say, host)`."""
        action, bracket, about = word.partition("(")
        inside = about.rpartition("(")[2].rstrip(") ")
        return cls(action, tuple(inside.split(", ")) if bracket else ())

    def may_be_about(self, person: str) -> bool:
        """Whether nodes of a person's visit may be meant."""
        return not self.about or person in self.about


def nodes_named(episode: Episode, word: str) -> tuple[Node, ...]:
    """The nodes of a name, given up to its bracket or with it.

    Raises:
        InputError: where the tree has none, and no tree of the scenario could.
    """
    found = tuple(node for node in episode.nodes if is_called(node, word))
    if not found:
        _require_possible(episode.prepared, {node.action for node in episode.nodes}, word)
    return found


def events_of(nodes: Iterable[Node], events: Iterable[TraceEvent]) -> tuple[TraceEvent, ...]:
    """What these nodes did."""
    paths = {node.path for node in nodes}
    return tuple(event for event in events if event.path in paths)


def _require_possible(prepared: PlannedEpisode, here: Set[str], word: str) -> None:
    named, scenario = NodeWord.of(word), prepared.file.scenario
    elsewhere = set(_of_other_trees(prepared))
    of_people = not named.about or any(part in scenario.people for part in named.about)
    of_a_goal = any(part in goals_of(scenario) for part in named.about)
    if not (of_people and named.action in elsewhere) and not (of_a_goal and named.action in here):
        former = FORMER_NODES.get(named.action)
        remedy = f"Write `{former}`." if former else closest(word, here | elsewhere)
        raise InputError(expected="a node of the behaviour tree", got=repr(word), remedy=remedy)


def _of_other_trees(prepared: PlannedEpisode) -> Iterator[str]:
    """What the nodes of another profile's tree do, or would do if everybody could be visited."""
    gestures = prepared.rulebook.parameters["greeting_gesture"]
    yield from (SAY_ACT, *GREETINGS)
    yield from (gesture.name for gesture in getattr(gestures, "categories", ()))
    if set(prepared.file.scenario.visited()) - _served(prepared):
        yield from node_names()


def _served(prepared: PlannedEpisode) -> set[str]:
    """The people for whom the plan has more than to drop their visit."""
    steps = (step for step in prepared.plan.steps if step.action != SKIP)
    return {person for step in steps for person in step.people}
