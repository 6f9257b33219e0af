"""What else is to be done at a person's visit once they are greeted, in this order.

Nothing here depends on culture: what is said, offered and waited for is the scenario's. Culture decides how:
from which side and how far away, how loud, with which words and gestures.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Until = Literal["speaks", "moves"]
"""What ends a pause early, as the robot reads it of the person."""

HANDOVER_S = 3.0
"""Picking something up, and handing it over: what each takes in the reckoning of deadlines (our choice)."""
FAREWELL_S = 7.0
"""Words, a gesture and stepping away, likewise."""
SPEECH_S_PER_CHARACTER = 0.1
"""Likewise: slow speech at any rate that a rulebook gives, so that culture has no say in deadlines."""
LEAST_SPEECH_S = 2.0


@dataclass(frozen=True, slots=True)
class Say:
    """Something to tell a person."""

    text: str

    def __post_init__(self) -> None:
        if not self.text.strip():
            raise ValueError("there is nothing to say")

    @property
    def seconds(self) -> float:
        """What it takes, as deadlines reckon it."""
        return max(LEAST_SPEECH_S, SPEECH_S_PER_CHARACTER * len(self.text))


@dataclass(frozen=True, slots=True)
class Offer:
    """Something to fetch somewhere and to hand over."""

    thing: str
    place: str
    """Where it is fetched."""

    @property
    def seconds(self) -> float:
        """What handing over takes, as deadlines reckon it."""
        return HANDOVER_S


@dataclass(frozen=True, slots=True)
class Wait:
    """A pause before the person."""

    cap_s: float
    """So long, or at most so long where something ends it."""
    until: Until | None = None

    def __post_init__(self) -> None:
        if not 0.0 < self.cap_s < math.inf:
            raise ValueError(f"a pause takes more than no time and ends, got {self.cap_s!r} s")

    @property
    def seconds(self) -> float:
        """What it takes at most."""
        return self.cap_s


@dataclass(frozen=True, slots=True)
class TakeLeave:
    """A farewell: words, a gesture, and a step away."""

    @property
    def seconds(self) -> float:
        """What it takes, as deadlines reckon it."""
        return FAREWELL_S


Task = Say | Offer | Wait | TakeLeave
Agenda = tuple[Task, ...]


def require_agenda(person: str, agenda: Agenda) -> None:
    """Refuse an agenda that goes on after the farewell."""
    if any(isinstance(task, TakeLeave) for task in agenda[:-1]):
        raise ValueError(f"{person}: nothing follows the farewell, got {agenda!r}")


def offers(agenda: Sequence[Task]) -> tuple[Offer, ...]:
    """What is to be fetched, in order."""
    return tuple(task for task in agenda if isinstance(task, Offer))


def takes_leave(agenda: Sequence[Task]) -> bool:
    """Whether there is a farewell."""
    return any(isinstance(task, TakeLeave) for task in agenda)


def seconds_of(agenda: Sequence[Task], *, in_hand: bool = False) -> float:
    """What all of it takes without the ways, as deadlines reckon it.

    Args:
        agenda: What is to be done.
        in_hand: Whether what is offered first was picked up already.
    """
    return sum(task.seconds for task in agenda) + HANDOVER_S * (len(offers(agenda)) - in_hand)
