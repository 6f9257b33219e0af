"""The agenda of a visit: the tasks after the greeting, in order.

Nothing here depends on culture: the scenario decides what is said, offered and waited for. Culture decides
how: the side, the distance, the volume, the words and gestures.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, Literal, Self

Until = Literal["speaks", "moves"]
"""Events of the person that end a pause early."""
_UNTIL: Mapping[Until, str] = {"speaks": "says something", "moves": "moves"}

HANDOVER_S = 3.0
"""Duration of picking something up, and of handing it over, as estimated for deadlines [s] (our choice)."""
FAREWELL_S = 7.0
"""Estimated duration of a farewell: words, a gesture and stepping away [s]."""
SPEECH_S_PER_CHARACTER = 0.1
"""Estimated duration of speech per character [s]: slow at any rate of a rulebook, so that culture does not
affect deadlines."""
LEAST_SPEECH_S = 2.0


class PlainTask(ABC):
    """A task without a choice, done before the person by one action of the plan.

    A subclass states all that the planner needs: the action of the problem, the step of the plan, its reason
    and its duration. `PLAIN` lists the subclasses; `visit.pddl` has the action of each with comments.
    """

    __slots__ = ()
    action: ClassVar[str]
    """Name of the action. The robot performs an act of this name in lower case, unless the executor has a
    subtree for it."""
    effect: ClassVar[str]
    """The name of the goal condition in the tree, a participle: `waited`."""
    fact: ClassVar[str]
    """The predicate of the problem that holds for tasks of this kind."""
    thousandths: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Fields stored as numeric fluents in thousandths of their unit, by fluent."""
    shaped_by: ClassVar[tuple[str, ...]] = ()
    """Behaviour parameters that the step also gets, if the rulebook has them."""

    @classmethod
    @abstractmethod
    def read(cls, detail: str, numbers: Mapping[str, int]) -> Self:
        """The task that a problem describes.

        Args:
            detail: What the problem omits (`detail` of the task), or a name that stands for it.
            numbers: The values of `thousandths`.
        """

    @property
    @abstractmethod
    def seconds(self) -> float:
        """Duration as estimated for deadlines [s]."""

    @property
    @abstractmethod
    def parameters(self) -> Mapping[str, float | str]:
        """The parameters of the step, without those of `shaped_by`."""

    @property
    def arguments(self) -> tuple[str, ...]:
        """The arguments of the step after the robot and the person."""
        return tuple(map(str, self.parameters.values()))

    @property
    def detail(self) -> str:
        """What a problem does not express of the task; empty if it expresses everything."""
        return ""

    @abstractmethod
    def reason(self, person: str) -> str:
        """Why the step is as it is."""


@dataclass(frozen=True, slots=True)
class Say(PlainTask):
    """Say a message to a person."""

    action = "Say"
    effect = "said"
    fact = "message"
    shaped_by = ("voice_volume", "speech_rate")

    text: str

    def __post_init__(self) -> None:
        if not self.text.strip():
            raise ValueError("there is nothing to say")

    @classmethod
    def read(cls, detail: str, numbers: Mapping[str, int]) -> Self:
        """A message; `detail` is its text."""
        return cls(detail)

    @property
    def seconds(self) -> float:
        """Duration as estimated for deadlines [s]."""
        return max(LEAST_SPEECH_S, SPEECH_S_PER_CHARACTER * len(self.text))

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The text."""
        return {"text": self.text}

    @property
    def detail(self) -> str:
        """The text: the problem has only its cost, which is 0."""
        return self.text

    def reason(self, person: str) -> str:
        """The text comes from the scenario."""
        return "the scenario's words, without a choice"


@dataclass(frozen=True, slots=True)
class Offer:
    """Fetch an object and hand it over."""

    thing: str
    place: str
    """The location where it is fetched."""

    @property
    def seconds(self) -> float:
        """Duration of handing over, as estimated for deadlines [s]."""
        return HANDOVER_S


@dataclass(frozen=True, slots=True)
class Wait(PlainTask):
    """A pause next to the person."""

    action = "Wait"
    effect = "waited"
    fact = "pause"
    thousandths = MappingProxyType({"cap_ms": "cap_s"})

    cap_s: float
    """Duration of the pause [s], or its maximum if an event may end it early."""
    until: Until | None = None

    def __post_init__(self) -> None:
        if not 0.0 < self.cap_s < math.inf:
            raise ValueError(f"a pause takes more than no time and ends, got {self.cap_s!r} s")

    @classmethod
    def read(cls, detail: str, numbers: Mapping[str, int]) -> Self:
        """A pause; the event that ends it early is irrelevant to the search."""
        return cls(numbers["cap_ms"] / 1000.0)

    @property
    def seconds(self) -> float:
        """The maximum duration [s]."""
        return self.cap_s

    @property
    def parameters(self) -> Mapping[str, float | str]:
        """The maximum duration [s], and the event that ends it early."""
        return {"cap_s": self.cap_s, **({"until": self.until} if self.until else {})}

    @property
    def arguments(self) -> tuple[str, ...]:
        """The maximum duration with its unit."""
        return (f"{self.cap_s:g} s", *([self.until] if self.until else ()))

    def reason(self, person: str) -> str:
        """What ends the pause."""
        if self.until is None:
            return f"the scenario's {self.cap_s:g} s, at the distance of the greeting, without a choice"
        return f"until {person} {_UNTIL[self.until]}, for {self.cap_s:g} s at most, without a choice"


@dataclass(frozen=True, slots=True)
class TakeLeave:
    """A farewell: words, a gesture, and a step away."""

    @property
    def seconds(self) -> float:
        """Duration as estimated for deadlines [s]."""
        return FAREWELL_S


PLAIN: tuple[type[PlainTask], ...] = (Say, Wait)
"""All kinds of plain tasks."""
Task = PlainTask | Offer | TakeLeave
Agenda = tuple[Task, ...]


def require_agenda(person: str, agenda: Agenda) -> None:
    """Reject an agenda that continues after the farewell."""
    if any(isinstance(task, TakeLeave) for task in agenda[:-1]):
        raise ValueError(f"{person}: nothing follows the farewell, got {agenda!r}")


def offers(agenda: Sequence[Task]) -> tuple[Offer, ...]:
    """The objects to fetch, in order."""
    return tuple(task for task in agenda if isinstance(task, Offer))


def takes_leave(agenda: Sequence[Task]) -> bool:
    """Whether there is a farewell."""
    return any(isinstance(task, TakeLeave) for task in agenda)


def seconds_of(agenda: Sequence[Task], *, in_hand: bool = False) -> float:
    """Duration of an agenda without travel, as estimated for deadlines [s].

    Args:
        agenda: The tasks.
        in_hand: Whether the first offered object was picked up already.
    """
    return sum(task.seconds for task in agenda) + HANDOVER_S * (len(offers(agenda)) - in_hand)
