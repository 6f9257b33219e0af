"""How long one thing that the robot does takes: a pause, an utterance, a way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import Amount, told, told_apart
from comity.testing.metrics.course import runs

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class Lasting:
    """In simulated seconds, every time that the node runs, until its result or its halt."""

    RULE: ClassVar[str] = "NAME _LASTS amount [_WITHIN amount]"
    EXAMPLE: ClassVar[str] = "Wait_before lasts 3 s within 0.1 s"

    node: str
    seconds: float
    within_s: float

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a node, an amount and how far off it may be."""
        node, lasts, within = parts
        assert isinstance(lasts, Amount)
        return cls(node, lasts.size("s"), within.size("s") if within else causes.TICK_S)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Every run that is too short or too long; and that there is none."""
        nodes = {node.path: node.name for node in trial.nodes_named(self.node)}
        ran = list(runs(trial, nodes))
        expected = f"{self.node} for {told(self.seconds, 's')}, within {told(self.within_s, 's')}"
        if not nodes:
            because = tuple(causes.of_absence(trial, self.node))
            yield Finding(expected, causes.absent(self.node), because)
        elif not ran:
            got = f"{self.node} never ran for longer than a tick"
            yield Finding(expected, got, tuple(causes.of_last(trial, self.node)))
        for took, start, node in ran:
            if abs(took - self.seconds) > self.within_s + 1e-6:
                lasts, lasted = told_apart((self.seconds, took), "s")
                within, _ = told_apart((self.within_s, abs(took - self.seconds)), "s")
                expected = f"{self.node} for {lasts}, within {within}"
                got = f"{node} for {lasted}, from t={start:.2f} s"
                yield Finding(expected, got, tuple(causes.of_node(trial, node, ended_s=start + took)))
