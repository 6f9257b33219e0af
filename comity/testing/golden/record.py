"""A golden episode: the quantised parameters, plan, outcome and events of a case, and what the case read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, model_validator

from comity.output.digest import digest_of
from comity_executor import Cause, History, Node, TraceEvent
from comity_executor.tracing.trace import EventStatus, Halt
from comity_fis.errors import WrongValueError


class StoredStep(BaseModel):
    """One step of the plan."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    text: str
    cost_m: float
    """In metres of way."""


@dataclass(frozen=True, slots=True)
class StoredEvent:
    """An event of the trace, by the place of its node."""

    t: float
    node: str
    path: int
    status: EventStatus
    halt: Halt | None
    because: tuple[Cause, ...]


class Golden(BaseModel):
    """One case as it was."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: Literal["comity-golden-6"] = "comity-golden-6"
    fingerprint: str
    trace_sha256: str
    read: Mapping[str, str]
    """Digests of what the case read, by what it is called."""
    written: Mapping[str, Mapping[str, Any]]
    """What stood in each file of these, by its place in it."""
    outcome: str
    visits: Mapping[str, str]
    rules: tuple[str, ...]
    parameters: Mapping[str, Mapping[str, float | str]]
    exact: Mapping[str, Mapping[str, float]]
    """Those that are numbers, to the last digit."""
    plan: tuple[StoredStep, ...]
    ruled_out: Mapping[str, Mapping[str, str]]
    """By step and choice, why a way to do it was not open."""
    path_length_m: float
    nodes: tuple[Node, ...]
    events: tuple[StoredEvent, ...]
    sha256: str = ""
    """Of all the rest, as it was written; empty before."""

    @model_validator(mode="after")
    def _hang_together(self) -> Self:
        """Nodes are numbered as a tree is, and events are of nodes."""
        for place, node in enumerate(self.nodes):
            if node.path != place or not (node.parent is None or 0 <= node.parent < place):
                raise WrongValueError(expected=f"node {place} of a tree", got=f"{node.path} in {node.parent}")
        for event in self.events:
            if not 0 <= event.path < len(self.nodes):
                raise WrongValueError(expected="an event of a node", got=f"one of node {event.path}")
        return self

    @property
    def history(self) -> History:
        """The trace to ask."""
        events = (
            TraceEvent(event.t, self.nodes[event.path], event.status, event.halt, event.because)
            for event in self.events
        )
        return History(self.nodes, events)

    def digest(self) -> str:
        """What `sha256` is where nobody edited the file."""
        return digest_of(self.model_dump(mode="json", exclude={"sha256"}))
