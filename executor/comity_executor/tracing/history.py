"""Queries on a trace: the state of every node at any moment, and the reason for it.

A running node stands on results of others. In a fallback the children before it have failed, in a sequence
they have succeeded, and so on up to the root. Of the results that came in the last tick, a condition's goes
before an action's, and the nearest to the node first: it is what switched, with its chain of causes. (That
the structure of a tree answers why-questions is in Han, Giger, Allspaw, Lee, Admoni, Yanco: Building the
foundation of robot explanation generation using behavior trees, ACM THRI 10(3), 2021; the numbers are added
here.)
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby

from comity_executor.nodes.cause import Cause
from comity_executor.nodes.node import Node
from comity_executor.tracing.intervention import INSTANT_S
from comity_executor.tracing.trace import TraceEvent

_GIVES_WAY = {"fallback": "failure", "sequence": "success", "memory_sequence": "success"}
"""Result of a child after which its parent continues with the next one."""


@dataclass(frozen=True, slots=True)
class NodeExplanation:
    """Why a node is in its state."""

    event: TraceEvent
    """Its last event, whose state still holds."""
    switched_by: TraceEvent | None
    """The leaf result that led to it; None if the event has its own causes."""
    standing_on: tuple[TraceEvent, ...]
    """Further results it depends on, the latest first."""

    @property
    def because(self) -> tuple[Cause, ...]:
        """The chain of causes, nearest first."""
        return self.event.because or (self.switched_by.because if self.switched_by else ())


class History:
    """A trace for queries.

    Args:
        nodes: The tree, in pre-order.
        events: In the order in which they happened.
    """

    def __init__(self, nodes: Iterable[Node], events: Iterable[TraceEvent]) -> None:
        self.nodes = tuple(nodes)
        self.events = tuple(events)
        self._children: dict[int, list[Node]] = {node.path: [] for node in self.nodes}
        for node in self.nodes:
            if node.parent is not None:
                self._children[node.parent].append(node)

    @property
    def end_s(self) -> float:
        """Time of the last event [s]."""
        return self.events[-1].t if self.events else 0.0

    def states(self, until: float | None = None) -> dict[int, TraceEvent]:
        """The last event of every node that has one, by path: up to a time [s], or to the end."""
        return {path: self.events[place] for path, place in self._latest(until).items()}

    def why_at(self, t: float) -> tuple[NodeExplanation, ...]:
        """Why actions run, or pause, at a time [s]; if none does, why the last event happened.

        An action pauses if it failed and will be retried.
        """
        latest = self._latest(t)
        running = [
            place
            for path, place in latest.items()
            if self.nodes[path].kind == "action"
            and (self.events[place].status == "running" or self._pauses(place, latest))
        ]
        # What came after an event may go on bearing it, and did not bring it about.
        return tuple(
            self._why(place, self._latest(self.events[place].t))
            for place in sorted(running) or sorted(latest.values())[-1:]
        )

    def _pauses(self, place: int, latest: Mapping[int, int]) -> bool:
        """Whether an action has failed under a decorator that still runs."""
        event = self.events[place]
        parent = self.nodes[event.path].parent
        if parent is None or self.nodes[parent].kind != "decorator" or parent not in latest:
            return False
        return event.status == "failure" and self.events[latest[parent]].status == "running"

    def _paused(self, path: int, latest: Mapping[int, int]) -> Iterator[int]:
        """Where the child of a decorator failed that is to be tried again."""
        below = (latest[child.path] for child in self._children[path] if child.path in latest)
        return (place for place in below if self._pauses(place, latest))

    def why_node(self, path: int, until: float | None = None) -> NodeExplanation | None:
        """Why a node did what it last did, up to a time [s]; None if it has done nothing yet."""
        latest = self._latest(until)
        place = latest.get(path)
        if place is None:
            return None
        pauses = any(self._paused(path, latest))
        return self._why(place, latest if pauses else self._latest(self.events[place].t))

    def whys(self) -> Iterator[NodeExplanation]:
        """Why every event came about, in their order; what a tick did counts for all events of the tick."""
        latest: dict[int, int] = {}
        for _, tick in groupby(enumerate(self.events), key=lambda placed: placed[1].t):
            places = [place for place, _ in tick]
            latest |= {self.events[place].path: place for place in places}
            yield from (self._why(place, latest) for place in places)

    def _latest(self, until: float | None) -> dict[int, int]:
        """The place of every node's last event, by path."""
        return {
            event.path: place
            for place, event in enumerate(self.events)
            if until is None or event.t <= until + INSTANT_S
        }

    def _why(self, place: int, latest: dict[int, int]) -> NodeExplanation:
        event = self.events[place]
        if event.because or (event.status != "running" and not self._children[event.path]):
            return NodeExplanation(event, None, ())
        if event.status != "running":
            decided = self._decided(place)
            return NodeExplanation(event, None if decided is None else self.events[decided], ())
        passed = [self.events[i] for i in self._passed(event.path, latest)]
        passed.sort(key=lambda result: (-result.t, self.nodes[result.path].kind != "condition"))
        passed[:0] = [self.events[i] for i in self._paused(event.path, latest)]
        return NodeExplanation(event, passed[0] if passed else None, tuple(passed[1:]))

    def _passed(self, path: int, latest: dict[int, int]) -> Iterator[int]:
        """Places of the leaves' results that gave way to a node, from the node up to the root."""
        parent = self.nodes[path].parent
        if parent is None:
            return
        if wanted := _GIVES_WAY.get(self.nodes[parent].kind):
            for sibling in self._children[parent]:
                if sibling.path >= path:
                    break
                given = [latest[leaf] for leaf in self._leaves(sibling.path) if leaf in latest]
                fitting = [place for place in given if self.events[place].status == wanted]
                yield from sorted(fitting or given)[-1:]
        yield from self._tried_before(path, latest)
        yield from self._passed(parent, latest)

    def _tried_before(self, path: int, latest: dict[int, int]) -> Iterator[int]:
        """The failure after which a decorator that still runs has tried its child again."""
        parent = self.nodes[path].parent
        if parent is None or self.nodes[parent].kind != "decorator" or not {path, parent} <= latest.keys():
            return
        for place in range(latest[path] - 1, latest[parent], -1):
            event = self.events[place]
            if event.path == path and event.status == "failure":
                decided = None if event.because else self._decided(place)
                yield place if decided is None else decided
                return

    def _decided(self, place: int) -> int | None:
        """The place of the leaf's result that became that of a node above it: the last one before it."""
        below = set(self._leaves(self.events[place].path))
        return next(
            (
                i
                for i in range(place - 1, -1, -1)
                if (e := self.events[i]).path in below and e.status != "running"
            ),
            None,
        )

    def _leaves(self, path: int) -> Iterator[int]:
        """The leaves at or below a node, in pre-order."""
        if not self._children[path]:
            yield path
        for child in self._children[path]:
            yield from self._leaves(child.path)
