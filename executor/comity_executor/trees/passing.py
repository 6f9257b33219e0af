"""A person is in the way: wait, ask to pass, wait for an answer; then this attempt to get somewhere fails.

    Mind_way(u) > Pass(u) ?     RUNNING instead of SUCCESS
    |- <> way_free?(u)          of people; things are the business of the motion
    '- Ask_way(u) ->(memory)
       |- Wait_for_way(u)       SUCCESS after `blocked_s`: a passer-by stands there for a moment only
       |- Ask_to_pass(u)        in the manner that suits the one who is asked
       '- Await_way(u)          FAILURE after `passing_s`

It stands beside Reach_user in a parallel, so that the robot goes on by itself as soon as the way is free; and
beside Go_to, with `tea, u` in the brackets, where the way is to what is fetched for a person (`fetching`).
After people were asked in vain the next attempt goes round, however far that is; where no way leads round,
they are asked once more, and never again unless they move, whatever is replanned (`asking`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.leaves.performing import Performing
from comity_executor.memory.shared import PassageRequest
from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.cause import Account, Provenance
from comity_executor.nodes.composites import fallback, never_succeeding, sequence
from comity_executor.nodes.fault import trouble_with
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Condition, Ports
from comity_executor.robots.goals import speech
from comity_executor.robots.status import known_motion
from comity_executor.speech.manner import NORMAL, manner_of
from comity_fis.inference.value import Inference
from comity_fis.listing import with_verb

ASK = "ask_to_pass"


@dataclass(frozen=True, slots=True)
class Passage:
    """A way that a person may be in, and for whose sake the robot goes it."""

    meeting: VisitContext
    """Whose branch it belongs to."""
    about: tuple[str, ...]
    """What the names of its nodes have in brackets, the person last."""
    provenance: Provenance
    """The step of the plan that leads along it."""


def way_to(meeting: VisitContext) -> Passage:
    """The way to a person."""
    return Passage(meeting, (meeting.person,), meeting.reach_grounds)


def passing(way: Passage, values: Mapping[str, Inference]) -> Behaviour:
    """The branch that minds a way.

    Args:
        way: Where to, and for whom.
        values: The parameters of people who may be asked, by name.
    """
    limits = way.meeting.limits
    ask = sequence(
        NodeId.of("Ask_way", *way.about),
        [
            WaitForWay(way, "Wait_for_way", for_s=limits.blocked_s, then=Status.SUCCESS),
            AskToPass(way, values),
            WaitForWay(way, "Await_way", for_s=limits.passing_s, then=Status.FAILURE),
        ],
        memory=True,
    )
    pass_ = fallback(NodeId.of("Pass", *way.about), [IsWayFree(way), ask])
    return never_succeeding(NodeId.of("Mind_way", *way.about), pass_)


class IsWayFree(Condition):
    """`way_free?`: is nobody in the way?"""

    def __init__(self, way: Passage) -> None:
        super().__init__(NodeId.of("way_free?", *way.about), way.provenance)
        self._meeting = way.meeting
        self._hindered_by: tuple[str, ...] = ()

    def check(self) -> bool:
        """Ask the robot whether a person blocks its motion."""
        self._hindered_by = hindered_by(self._meeting)
        return not self._hindered_by

    def explain(self) -> Account | None:
        """Who it is."""
        if not self._hindered_by:
            return Account("nobody holds the robot up")
        fault = trouble_with(self._meeting.robot, *self._hindered_by)
        return Account(f"{with_verb(self._hindered_by, 'is', 'are')} in the way", fault=fault)


class WaitForWay(Action):
    """Wait for so long: the way may become free, which ends this from outside.

    Args:
        way: The way that it is on.
        verb: Names the node.
        for_s: How long.
        then: What comes of it in the end.
    """

    def __init__(self, way: Passage, verb: str, *, for_s: float, then: Status) -> None:
        super().__init__(NodeId.of(verb, *way.about), way.provenance)
        writes = ("in_vain",) if then is Status.FAILURE else ()
        self._meeting = way.meeting.seen_by(self, writes=writes)
        self._for_s = for_s
        self._then = then
        self._began_s = 0.0
        self._who: tuple[str, ...] = ()

    @property
    def ports(self) -> Ports:
        """How long, and what then."""
        return {"person": self._meeting.person, "for_s": self._for_s, "then": self._then.name}

    def begin(self) -> None:
        """Look at the clock, and who it is."""
        self._began_s = self._meeting.senses.now_s()
        self._who = hindered_by(self._meeting) or ("somebody",)

    def step(self) -> Status:
        """RUNNING until the time is over."""
        over = self._meeting.senses.now_s() - self._began_s >= self._for_s - 1e-9
        if over and self._then is Status.FAILURE:
            self._meeting.asking.note_in_vain(self._who)
        return self._then if over else Status.RUNNING

    def explain(self) -> Account | None:
        """Who stood there for so long."""
        return Account(f"{self._stood} {self._for_s:g} s", self._for_s)

    @property
    def _stood(self) -> str:
        if self._then is Status.SUCCESS:
            return f"{with_verb(self._who, 'has', 'have')} been in the way for"
        asked = with_verb(self._who, "was", "were")
        return f"{asked} asked to let the robot pass, and the way was not free within"


class AskToPass(Action):
    """Ask all who are in the way, one after the other, each at most once for every attempt."""

    def __init__(self, way: Passage, values: Mapping[str, Inference]) -> None:
        super().__init__(NodeId.of("Ask_to_pass", *way.about), way.provenance)
        self._way = way
        self._meeting = way.meeting.seen_by(self, writes=("asked",))
        self._values = values
        self._performing = Performing(way.meeting.robot, way.meeting.senses)
        self._asked: list[PassageRequest] = []
        """In this attempt; the last one is being asked."""
        self._is_asking = False
        self._texts: list[str] = []

    def begin(self) -> None:
        """Speak to the first, where anybody may be asked."""
        self._asked, self._texts, self._is_asking = [], [], False
        self._ask_next()

    def step(self) -> Status:
        """SUCCESS when all is said or nobody is to be asked; FAILURE when broken off or never at its end."""
        if not self._asked:
            return Status.SUCCESS
        meeting, asked = self._meeting, self._asked[-1]
        self._performing.look()
        late = meeting.senses.now_s() - asked.t >= meeting.limits.act_timeout_s
        self._is_asking = not (self._performing.is_lost or self._performing.is_done or late)
        if self._is_asking:
            return Status.RUNNING
        if not self._performing.is_done:
            return Status.FAILURE
        return Status.RUNNING if self._ask_next() else Status.SUCCESS

    def end(self) -> None:
        """Fall silent; who was interrupted in being asked, as by a new plan, was not asked."""
        if self._is_asking:
            self._meeting.asking.take_back(self._asked[-1])
        self._is_asking = False
        self._performing.end()

    def explain(self) -> Account | None:
        """Who was asked, and how."""
        if not self._asked:
            return Account("whoever is in the way was asked already")
        told = zip(self._asked, self._texts, strict=True)
        return Account("; ".join(f"{asked.person} was asked: {text}" for asked, text in told))

    def _ask_next(self) -> bool:
        """Speak, loudly or softly, formally or not, as suits the one who is asked; whether there is one."""
        meeting, now_s = self._meeting, self._meeting.senses.now_s()
        before = {asked.person for asked in self._asked}
        left = (name for name in hindered_by(meeting) if name not in before)
        who = next((name for name in left if meeting.asking.may_ask(name, now_s)), None)
        if who is None:
            return False
        values = self._values.get(who)
        asked, words = (
            PassageRequest(now_s, who, self._way.about),
            meeting.speaker.request_to_pass(who, values),
        )
        manner = manner_of(values) if values else NORMAL
        self._performing.begin(speech(ASK, who, words, manner=manner), values)
        self._asked.append(asked)
        self._texts.append(words.latin)
        meeting.asking.note(asked)
        self._is_asking = True
        return True


def hindered_by(meeting: VisitContext) -> tuple[str, ...]:
    """Who blocks the motion."""
    motion = known_motion(meeting.robot)
    return tuple(motion.blocked_by) if motion.is_blocked else ()
