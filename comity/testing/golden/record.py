"""A golden episode: the quantised parameters, plan, outcome and events of a case, and its inputs."""

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
    """Cost in metres of path."""


@dataclass(frozen=True, slots=True)
class StoredEvent:
    """An event of the trace, with the number of its node."""

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
    """Digests of the inputs, by name."""
    written: Mapping[str, Mapping[str, Any]]
    """Values of each input file, by their place in it."""
    outcome: str
    visits: Mapping[str, str]
    rules: tuple[str, ...]
    parameters: Mapping[str, Mapping[str, float | str]]
    exact: Mapping[str, Mapping[str, float]]
    """Numeric parameters, exactly."""
    plan: tuple[StoredStep, ...]
    ruled_out: Mapping[str, Mapping[str, str]]
    """By step and choice, the reason for an exclusion."""
    path_length_m: float
    nodes: tuple[Node, ...]
    events: tuple[StoredEvent, ...]
    sha256: str = ""
    """Digest of all other fields as written; empty before writing."""

    @model_validator(mode="after")
    def _hang_together(self) -> Self:
        """Check that nodes are numbered as a tree, and that events refer to existing nodes."""
        for place, node in enumerate(self.nodes):
            if node.path != place or not (node.parent is None or 0 <= node.parent < place):
                raise WrongValueError(expected=f"node {place} of a tree", got=f"{node.path} in {node.parent}")
        for event in self.events:
            if not 0 <= event.path < len(self.nodes):
                raise WrongValueError(expected="an event of a node", got=f"one of node {event.path}")
        return self

    @property
    def history(self) -> History:
        """The recorded trace."""
        events = (
            TraceEvent(event.t, self.nodes[event.path], event.status, event.halt, event.because)
            for event in self.events
        )
        return History(self.nodes, events)

    def digest(self) -> str:
        """The value of `sha256` if nobody edited the file."""
        return digest_of(self.model_dump(mode="json", exclude={"sha256"}))
