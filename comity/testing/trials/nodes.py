"""Nodes named by a word of a sentence: `docked?` for all people, `docked?(host)` for one of them."""

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
"""Present names of tree nodes by their names in earlier versions."""


@dataclass(frozen=True, slots=True)
class NodeWord:
    """A word that names nodes, as written in a sentence; the tree may not contain them."""

    action: str
    about: tuple[str, ...]
    """Arguments in brackets; empty for the nodes of all people."""

    @classmethod
    def of(cls, word: str) -> NodeWord:
        """Parse `docked?` or `done?(say, host)`."""
        action, bracket, about = word.partition("(")
        inside = about.rpartition("(")[2].rstrip(") ")
        return cls(action, tuple(inside.split(", ")) if bracket else ())

    def may_be_about(self, person: str) -> bool:
        """Whether the word may mean nodes of a person's visit."""
        return not self.about or person in self.about


def nodes_named(episode: Episode, word: str) -> tuple[Node, ...]:
    """The nodes with a name, given with or without its brackets.

    Raises:
        InputError: if neither this tree nor any possible tree of the scenario has such a node.
    """
    found = tuple(node for node in episode.nodes if is_called(node, word))
    if not found:
        _require_possible(episode.prepared, {node.action for node in episode.nodes}, word)
    return found


def events_of(nodes: Iterable[Node], events: Iterable[TraceEvent]) -> tuple[TraceEvent, ...]:
    """Events of these nodes."""
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
    """Names of nodes in trees of other profiles, and in the tree in which everybody is visited."""
    gestures = prepared.rulebook.parameters["greeting_gesture"]
    yield from (SAY_ACT, *GREETINGS)
    yield from (gesture.name for gesture in getattr(gestures, "categories", ()))
    if set(prepared.file.scenario.visited()) - _served(prepared):
        yield from node_names()


def _served(prepared: PlannedEpisode) -> set[str]:
    """People for whom the plan has more than a dropped visit."""
    steps = (step for step in prepared.plan.steps if step.action != SKIP)
    return {person for step in steps for person in step.people}
