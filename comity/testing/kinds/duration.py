"""Duration of a node of the behaviour tree: a pause, an utterance, a motion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.amount import Amount, Bounds
from comity.testing.amounts.course import runs
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.nodes import events_of, nodes_named

if TYPE_CHECKING:
    from comity.episode import Episode


SLACK_S = 1e-6
"""Precision of differences between sums of ticks [s]."""


@dataclass(frozen=True, slots=True)
class Duration(Expectation):
    """Duration of every run of a node [simulated s], until its result or halt."""

    RULE: ClassVar[str] = "NAME _LASTS bounds"
    EXAMPLE: ClassVar[str] = "Wait_before lasts 3 s within 0.1 s"

    node: str
    bounds: Bounds

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a node and bounds; a duration without a tolerance must match to a tick."""
        node, bounds = parts
        bounds.require_possible(f"what {node} lasts", 0.0, None, "s")
        exact = bounds.least if bounds.least == bounds.most else None
        return cls(node, Bounds.around(exact, Amount(causes.TICK_S, "s")) if exact else bounds)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Every run that is too short or too long, and the absence of runs."""
        nodes = nodes_named(episode, self.node)
        ran = list(runs(events_of(nodes, episode.events)))
        expected = f"{self.node} for {self.bounds.told('s')}"
        if not nodes:
            yield Finding(expected, causes.absent(self.node), tuple(causes.of_absence(episode, self.node)))
        elif not ran:
            got = f"{self.node} never ran for longer than a tick"
            yield Finding(expected, got, tuple(causes.of_last(episode.history, nodes)))
        for took_s, start_s, node in ran:
            if not self.bounds.holds(took_s, "s", slack=SLACK_S):
                yield Finding(
                    f"{self.node} for {self.bounds.told('s', took_s)}",
                    f"{node.name} for {self.bounds.missed_by(took_s, 's', f', from t={start_s:.2f} s')}",
                    tuple(causes.of_node(episode.history, node.name, ended_s=start_s + took_s)),
                )
