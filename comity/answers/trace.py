"""What `comity trace` answers: events, reasons and differences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from comity.answers.run import Disturbance
from comity_executor.memory.write import Write
from comity_executor.nodes.cause import Cause
from comity_executor.tracing.trace import EventStatus, Halt
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class EventAnswer(Record):
    """A node changed its status, or was halted."""

    t: float
    node: str
    path: int
    """The node's place in the tree, in pre-order."""
    status: EventStatus
    halt: Halt | None
    because: tuple[Cause, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadingAnswer(Record):
    """What the robot read of one person."""

    person: str
    t: float
    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    speed_m_s: float
    stamp_s: float
    """When it was measured."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReasonAnswer(Record):
    """Why a node is in its state."""

    event: EventAnswer
    """What it did last."""
    switched_by: EventAnswer | None
    """The leaf's result that led to it; null where the event has its own causes."""
    standing_on: tuple[EventAnswer, ...]
    """Further results that have to stay as they are, the latest first."""
    because: tuple[Cause, ...]
    """The chain of causes, nearest first."""
    now: ReadingAnswer | None = None
    """What the robot read of the person that the node is about, at the time that is asked about; the chain
    has what it read when things changed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DifferenceAnswer(Record):
    """The first difference between two runs."""

    t: float
    in_behaviour: bool
    """False where only the numbers behind the same event differ."""
    one: EventAnswer | None
    """Null where that run had ended."""
    other: EventAnswer | None
    causes: tuple[tuple[Cause | None, Cause | None], ...]
    """The links that differ, nearest first, side by side."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceAnswer(Record):
    """`comity trace --json`."""

    episode: str
    status: Literal["running", "done", "crashed"]
    bytes_per_minute: Mapping[str, int] = field(default_factory=dict)
    """Of a run that is done: the trace, the readings and the frames, by file."""
    events: tuple[EventAnswer, ...]
    disturbances: tuple[Disturbance, ...] = ()
    """What happened around the tree: changes, faults, messages and walks of people; with --node only those
    about a person, door or part of that name."""
    blackboard: tuple[Write, ...] | None = None
    """With --blackboard: every entry that was written."""
    why: tuple[ReasonAnswer, ...] | None = None
    """With --why."""
    differences: tuple[DifferenceAnswer, ...] | None = None
    """With --diff: the first in numbers, and the first in what was done."""
