"""Switches: every start or halt of an action, with the result that caused it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from comity_executor.tracing.history import History, NodeExplanation
from comity_executor.tracing.intervention import INSTANT_S, Intervention, Result
from comity_executor.tracing.trace import TraceEvent


@dataclass(frozen=True, slots=True)
class Switch:
    """An action began or was halted."""

    event: TraceEvent
    cause: TraceEvent
    """The causing result in the same tick."""
    before: Result
    """Previous result of the causing node."""

    reading_of: str | None
    """The person whose reading caused it, if the trace contains the reading."""

    @property
    def without_cause(self) -> Intervention:
        """The intervention that tests the claim: the cause keeps its previous value in this tick."""
        return Intervention(self.cause.path, self.cause.t, self.before, self.reading_of)

    def happens_in(self, history: History) -> bool:
        """Whether the same action begins, or is halted, at the same time in another run of the same tree."""
        event = self.event
        return any(
            (other.path, other.status) == (event.path, event.status) and abs(other.t - event.t) < INSTANT_S
            for other in history.events
        )


def switches(history: History) -> Iterator[Switch]:
    """All switches of a run for which the trace blames a node, in their order."""
    for why in history.whys():
        event = why.event
        if history.nodes[event.path].kind != "action" or event.status not in ("running", "halted"):
            continue
        if cause := _blamed(why, history):
            yield Switch(event, cause, _before(cause, history), _reading_of(cause, history))


def _blamed(why: NodeExplanation, history: History) -> TraceEvent | None:
    if why.switched_by is not None:
        return why.switched_by
    claimed = next((cause.text for cause in why.because if cause.kind == "condition"), None)
    in_tick = (event for event in history.events if event.t == why.event.t)
    return next((event for event in in_tick if f"{event.node} -> {event.status}" == claimed), None)


def _before(cause: TraceEvent, history: History) -> Result:
    """The last other result; of a node that never had one, what would not have given it."""
    for event in reversed(history.events):
        other = event.path == cause.path and event.t < cause.t and event.status != cause.status
        match event.status:
            case "running" | "success" | "failure" as status if other:
                return status
    if history.nodes[cause.path].kind != "condition":
        return "running"
    return "failure" if cause.status == "success" else "success"


def _reading_of(cause: TraceEvent, history: History) -> str | None:
    """The person of a condition that accounts for itself with a number."""
    numbers = [link for link in cause.because if link.kind == "reading" and link.value is not None]
    if not numbers or history.nodes[cause.path].kind != "condition":
        return None
    return history.nodes[cause.path].person
