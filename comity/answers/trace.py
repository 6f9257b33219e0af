"""What `comity trace` answers: events, reasons and differences."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer, Halt
from comity.answers.run import DisturbanceAnswer, PlanStatus


class CauseAnswer(Answer):
    """One link of the chain that ends in a cultural variable."""

    kind: str
    text: str
    value: float | str | None


class EventAnswer(Answer):
    """A node changed its status, or was halted."""

    t: float
    node: str
    path: int = Field(description="The node's place in the tree, in pre-order.")
    status: Literal["running", "success", "failure", "halted"] | PlanStatus
    halt: Halt | None
    because: tuple[CauseAnswer, ...]


class ReadingAnswer(Answer):
    """What the robot read of one person."""

    person: str
    t: float
    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    speed_m_s: float
    stamp_s: float = Field(description="When it was measured.")


class ReasonAnswer(Answer):
    """Why a node is in its state."""

    event: EventAnswer = Field(description="What it did last.")
    switched_by: EventAnswer | None = Field(
        description="The leaf's result that led to it; null where the event has its own causes."
    )
    standing_on: tuple[EventAnswer, ...] = Field(
        description="Further results that have to stay as they are, the latest first."
    )
    because: tuple[CauseAnswer, ...] = Field(description="The chain of causes, nearest first.")
    now: ReadingAnswer | None = Field(
        default=None,
        description="What the robot read of the person that the node is about, at the time that is asked "
        "about; the chain has what it read when things changed.",
    )


class DifferenceAnswer(Answer):
    """The first difference between two runs."""

    t: float
    in_behaviour: bool = Field(description="False where only the numbers behind the same event differ.")
    one: EventAnswer | None = Field(description="Null where that run had ended.")
    other: EventAnswer | None
    causes: tuple[tuple[CauseAnswer | None, CauseAnswer | None], ...] = Field(
        description="The links that differ, nearest first, side by side."
    )


class EntryAnswer(Answer):
    """An entry of the blackboard that the leaves share."""

    entry: str = Field(description="Its key, which begins with the person: `johanna/docked`.")
    value: str = Field(description="In words.")
    t: float = Field(description="When it got this value.")
    leaf: str = Field(description="The leaf that wrote it; `execution` where none did.")


class TraceAnswer(Answer):
    """`comity trace --json`."""

    episode: str
    status: Literal["running", "done", "crashed"]
    bytes_per_minute: Mapping[str, int] = Field(
        default={}, description="Of a run that is done: the trace, the readings and the frames, by file."
    )
    events: tuple[EventAnswer, ...]
    disturbances: tuple[DisturbanceAnswer, ...] = Field(
        default=(),
        description="What happened around the tree: changes, faults, messages and walks of people; with "
        "--node only those about a person, door or part of that name.",
    )
    blackboard: tuple[EntryAnswer, ...] | None = Field(
        default=None, description="With --blackboard: every entry that was written."
    )
    why: tuple[ReasonAnswer, ...] | None = Field(default=None, description="With --why.")
    differences: tuple[DifferenceAnswer, ...] | None = Field(
        default=None, description="With --diff: the first in numbers, and the first in what was done."
    )
