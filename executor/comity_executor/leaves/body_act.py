"""Speech, gestures and handovers: started once, and recorded when a leaf notices the end."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable

from py_trees.common import Status

from comity_executor.leaves.performing import Performing
from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.cause import Provenance
from comity_executor.nodes.fault import VOICE, trouble_of
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Ports
from comity_executor.robots.goals import ActGoal
from comity_executor.speech.utterance import Utterance


class BodyAct(Action):
    """An act of the robot towards the visited person.

    Args:
        node_id: The act and the person.
        meeting: Context of the visit.
        act: `say`, or another act by its name.
        provenance: The plan step that it carries out.
    """

    def __init__(self, node_id: NodeId, meeting: VisitContext, act: str, provenance: Provenance) -> None:
        super().__init__(node_id, provenance)
        self._meeting = meeting
        self._act = act
        self._performing = Performing(meeting.robot, meeting.senses)
        self._again = ""

    @property
    def ports(self) -> Ports:
        """The act, its text and its manner."""
        manner = self._meeting.manner
        how: Ports = {"volume": manner.volume, "rate": manner.rate, "amplitude": manner.amplitude}
        return {"act": self._act, "person": self._meeting.person, "text": self.text, **how}

    @property
    def text(self) -> str:
        """The text in the script of its language; empty if nothing is said."""
        words = self.words()
        return words.text if isinstance(words, Utterance) else words or ""

    @abstractmethod
    def words(self) -> Utterance | str | None:
        """Our wordings or the plan's own text; None if nothing is said."""

    @abstractmethod
    def goal(self) -> ActGoal:
        """The goal for the robot."""

    @abstractmethod
    def remember(self) -> None:
        """Record the end of the act."""

    def begin(self) -> None:
        """Start the act."""
        self._again = ""
        self._performing.begin(self.goal(), self._meeting.values)

    def step(self) -> Status:
        """SUCCESS when the robot reports the end, FAILURE if interrupted by another program."""
        self._performing.look()
        if self._performing.is_lost:
            self._again = self._next_attempt()
            return Status.FAILURE
        if not self._performing.is_done:
            return Status.RUNNING
        self.remember()
        return Status.SUCCESS

    def end(self) -> None:
        """Abort the act unless it is over; it may have ended since the last tick."""
        was_done = self._performing.is_done
        self._performing.end()
        if self._performing.is_done and not was_done:
            self.remember()

    def how_it_went(self) -> str:
        """Whether it is over or was aborted, and when it is retried, in words."""
        return (
            f"{self._act} is done" if self._performing.is_done else f"{self._act} was broken off{self._again}"
        )

    def _next_attempt(self) -> str:
        """The next attempt, in words; empty after the last one."""
        again = self.parent.next_attempt() if isinstance(self.parent, ActTimeout) else None
        return f", it pauses before attempt {again[0]} until t={again[1]:.2f} s" if again else ""

    def trouble(self) -> str | None:
        """The fault of the voice, if it aborted the act."""
        return trouble_of(self._meeting.robot, VOICE) if self._performing.is_lost else None

    def told(self, names: Iterable[str]) -> tuple[str, ...]:
        """The parameters whose values differ from neutral."""
        values = self._meeting.values
        return tuple(name for name in names if name in values.parameters and values[name].origin != "neutral")
