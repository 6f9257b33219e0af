"""The history of the blackboard: every value that an entry got, when, and from which leaf."""

from __future__ import annotations

from dataclasses import dataclass

from comity_domain.plans.plan import PlanStep
from comity_executor.robots.noticed import Noticed
from comity_fis.inference.value import Inference
from comity_fis.record import Record


@dataclass(frozen=True, slots=True)
class Write(Record):
    """One entry got another value."""

    entry: str
    """The entry's key, relative to the namespace of the execution: `johanna/docked`."""
    value: str
    """In words."""
    t: float
    """The world's time at the start of the tick [s]."""
    leaf: str
    """The name of the leaf that wrote it; `execution` where none did."""


def in_words(value: object) -> str:
    """A value of the blackboard, short enough for a cell of a table."""
    match value:
        case None:
            words = "none"
        case bool():
            words = "yes" if value else "no"
        case float():
            words = f"{value:.2f}"
        case object(distance_m=float(distance_m), bearing_deg=float(bearing_deg)):  # a pose or a reading
            words = f"{distance_m:.2f} m, {round(bearing_deg, 1) + 0.0:.1f} deg"  # no negative zero
        case tuple() | frozenset():
            several = [in_words(each) for each in value]
            words = ", ".join(several if isinstance(value, tuple) else sorted(several)) or "none"
        case PlanStep():
            words = f"{value.action}({', '.join(value.arguments)})"
        case Inference():
            words = f"{len(value.parameters)} parameters of {value.rulebook}"
        case Noticed():
            words = f"{value.kind} at {value.distance_m:.2f} m"
        case _:
            words = str(value)
    return words
