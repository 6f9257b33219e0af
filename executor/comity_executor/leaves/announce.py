"""Announcements to a person who cannot see: the robot approaches, has stopped, or leaves."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping

from py_trees.common import Status

from comity_domain.plans.actions import ANNOUNCED
from comity_domain.problem.bound_parameters import ABOUT_SPEECH, ABOUT_WORDS
from comity_domain.problem.circumstances import SPOKEN_TO_M
from comity_executor.leaves.body_act import BodyAct
from comity_executor.leaves.motion import MotionAction
from comity_executor.leaves.navigate import NavigateToUser
from comity_executor.leaves.performing import Performing
from comity_executor.memory.visit_context import SAY_ACT, VisitContext
from comity_executor.nodes.cause import Account, Provenance
from comity_executor.nodes.fault import VOICE, trouble_of
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Condition, Ports
from comity_executor.robots.goals import ActGoal, speech
from comity_executor.speech.manner import manner_of
from comity_executor.speech.utterance import Utterance
from comity_fis.inference.value import Inference

MARGIN_M = 0.15
"""Extra distance at which the robot halts to speak [m]: covers noise and the tick's length (our choice)."""
REACTS_S = 0.1
"""Time from the reading to braking [s]: two control ticks (our choice)."""
GONE_M = 1.0
"""Additional distance after which the robot announces itself again [m] (our choice)."""


def is_announced(meeting: VisitContext) -> bool:
    """Whether the plan includes announcing the approach to this person."""
    return ANNOUNCED in meeting.reach.parameters


def halting_m(meeting: VisitContext, speed_m_s: float) -> float:
    """Distance at which a robot of this speed must brake to rest `SPOKEN_TO_M` before the person [m].

    The sum of that distance, the distance covered during the base's latency, v^2 / (2 a) for braking, and a
    margin.
    """
    base = meeting.robot.capabilities
    braking_m = speed_m_s**2 / (2.0 * base.braking_m_s2)
    return SPOKEN_TO_M + MARGIN_M + base.tolerance_m + speed_m_s * (base.latency_s + REACTS_S) + braking_m


class IsComingTold(Condition):
    """`coming_told?`: was the approach announced, and has the robot not been far away since?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("coming_told?", meeting.person), meeting.reach_grounds)
        self._meeting = meeting.seen_by(self, reads=("announced",))
        self._text = ""

    @property
    def ports(self) -> Ports:
        """The person concerned."""
        return {"person": self._meeting.person}

    def check(self) -> bool:
        """True once the words were spoken, until the robot has been far away."""
        meeting, person = self._meeting, self._meeting.person
        reading = meeting.senses.read(person)
        far_m = halting_m(meeting, meeting.limits.cruise_speed_m_s) + GONE_M
        if meeting.shared.announced != person:
            self._text = f"{person} was not told that the robot comes, and does not see it"
        elif reading is not None and reading.distance_m > far_m:
            self._text = f"{person} is {reading.distance_m:.2f} m away, and was told nearer by"
        else:
            self._text = ""
        return not self._text

    def explain(self) -> Account | None:
        """Whether the approach was announced, and if not, why."""
        return Account(self._text or f"{self._meeting.person} was told", parameter=ANNOUNCED)


class ComeNear(NavigateToUser):
    """Approach the person, and halt before the robot is nearer than `SPOKEN_TO_M`."""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(meeting, verb="Come_near")

    def begin(self) -> None:
        """Start, unless the robot is near already: then it stays until it has spoken."""
        if self._is_near():
            MotionAction.begin(self)
        else:
            super().begin()

    def step(self) -> Status:
        """SUCCESS when the robot must halt or is close to its pose; FAILURE as for any path."""
        return Status.SUCCESS if self._is_near() else super().step()

    def _is_near(self) -> bool:
        person = self.meeting.person
        reading = self.meeting.senses.read(person)
        if reading is None or reading.distance_m > halting_m(self.meeting, reading.speed_m_s):
            return False
        text = f"{person}, who does not see, is {reading.distance_m:.2f} m away, and is spoken to first"
        self.say(Account(text, reading.distance_m, ANNOUNCED))
        return True


class Announcement(BodyAct):
    """An announcement of what the robot does.

    Args:
        verb: Verb in the node's name.
        meeting: Context of the visit.
        reads: Entries of the blackboard that it reads.
    """

    def __init__(self, verb: str, meeting: VisitContext, *, reads: tuple[str, ...] = ()) -> None:
        super().__init__(NodeId.of(verb, meeting.person), meeting, SAY_ACT, meeting.reach_grounds)
        self.verb = verb
        self._meeting = meeting.seen_by(self, reads=("values", *reads), writes=("announced", "stopped_s"))

    def goal(self) -> ActGoal:
        """The act, in the manner that suits the person."""
        meeting = self._meeting
        return speech(SAY_ACT, meeting.person, self.words(), manner=meeting.manner)

    @abstractmethod
    def words(self) -> Utterance:
        """The words to say."""

    def explain(self) -> Account | None:
        """The words said, and that the person cannot see."""
        return Account(
            f"{self.how_it_went()}: {self._meeting.person} does not see, and is told “{self.words().latin}”",
            parameter=ANNOUNCED,
            others=self.told((*ABOUT_SPEECH, *ABOUT_WORDS)),
            fault=self.trouble(),
        )


class SayComing(Announcement):
    """Tell the person that the robot comes."""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__("Say_coming", meeting)

    def words(self) -> Utterance:
        """The announcement in the person's language."""
        return self._meeting.speaker.coming(self._meeting.person, self._meeting.values)

    def remember(self) -> None:
        """Record that leaving must be announced, too."""
        self._meeting.shared.announced = self._meeting.person


class SayStopped(Announcement):
    """Tell the person where the robot has stopped."""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__("Say_stopped", meeting, reads=("reach", "docked_at", "docked_s"))

    def words(self) -> Utterance:
        """The position as the person would see it: in front, to the left."""
        meeting = self._meeting
        docked_at = meeting.memory.docked_at
        bearing_deg = meeting.wanted.bearing_deg if docked_at is None else docked_at.bearing_deg
        return meeting.speaker.stopped(meeting.person, bearing_deg, meeting.values)

    def remember(self) -> None:
        """Record it for this docking; the next one is announced again."""
        self._meeting.shared.stopped_s = self._meeting.memory.docked_s
        self._meeting.shared.announced = self._meeting.person


class IsStopTold(Condition):
    """`stop_told?`: was it announced that the robot has stopped, and where?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("stop_told?", meeting.person), meeting.reach_grounds)
        self._meeting = meeting.seen_by(self, reads=("stopped_s", "docked_s"))

    @property
    def ports(self) -> Ports:
        """The person concerned."""
        return {"person": self._meeting.person}

    def check(self) -> bool:
        """Once for every docking."""
        return self._meeting.shared.stopped_s == self._meeting.memory.docked_s

    def explain(self) -> Account | None:
        """Whether the words are spoken."""
        told = "was told" if self.check() else "does not see, and was not told yet,"
        return Account(f"{self._meeting.person} {told} that the robot has stopped", parameter=ANNOUNCED)


class IsLeaveTold(Condition):
    """`leave_told?`: has the robot's leaving been announced to everyone who needs it?

    Args:
        meeting: Context of the visit.
        about: Arguments in the node's name.
        provenance: The plan step for which the robot leaves.
        goes_to: The person it goes to, who is not left; None: it goes to a place.
    """

    def __init__(
        self, meeting: VisitContext, about: tuple[str, ...], provenance: Provenance, *, goes_to: str | None
    ) -> None:
        super().__init__(NodeId("leave_told?", about, meeting.person), provenance)
        self._meeting = meeting.seen_by(self, reads=("announced",))
        self._goes_to = goes_to

    @property
    def ports(self) -> Ports:
        """The person who is not left."""
        return {"goes_to": self._goes_to or ""}

    def check(self) -> bool:
        """Look up who was last told that the robot approaches."""
        return self._meeting.shared.announced in (None, self._goes_to)

    def explain(self) -> Account | None:
        """The person who needs the announcement."""
        who = self._meeting.shared.announced
        if who in (None, self._goes_to):
            return None
        return Account(f"{who} does not see, and was not told yet that the robot leaves")


class SayLeaving(Action):
    """Tell the person next to the robot that it leaves.

    Args:
        meeting: Context of the visit.
        about: Arguments in the node's name.
        provenance: The plan step for which the robot leaves.
        values: Everyone's parameters, by name.
    """

    def __init__(
        self,
        meeting: VisitContext,
        about: tuple[str, ...],
        provenance: Provenance,
        values: Mapping[str, Inference],
    ) -> None:
        super().__init__(NodeId("Say_leaving", about, meeting.person), provenance)
        self._meeting = meeting.seen_by(self, writes=("announced",))
        self._performing = Performing(meeting.robot, meeting.senses)
        self._values = values
        self._who = ""
        self._text = ""

    @property
    def ports(self) -> Ports:
        """The person visited next."""
        return {"goes_to": self._meeting.person}

    def begin(self) -> None:
        """Speak in the manner that suits the person."""
        self._who = self._meeting.shared.announced or self._meeting.person
        values = self._values[self._who]
        words = self._meeting.speaker.leaving(self._who, values)
        self._text = words.latin
        self._performing.begin(speech(SAY_ACT, self._who, words, manner=manner_of(values)), values)

    def step(self) -> Status:
        """SUCCESS when the words are said, FAILURE if interrupted by another program."""
        self._performing.look()
        if self._performing.is_lost:
            return Status.FAILURE
        if not self._performing.is_done:
            return Status.RUNNING
        self._meeting.shared.announced = None
        return Status.SUCCESS

    def end(self) -> None:
        """Stop speaking, unless all is said."""
        self._performing.end()

    def explain(self) -> Account | None:
        """The words said."""
        said = "was told" if self._performing.is_done else "could not be told"
        fault = trouble_of(self._meeting.robot, VOICE) if self._performing.is_lost else None
        return Account(f"{self._who} does not see, and {said} “{self._text}”", fault=fault)


class LeaveUntold(Action):
    """SUCCESS at once: a robot that cannot speak does not stay next to the person forever."""

    def __init__(self, meeting: VisitContext, about: tuple[str, ...], provenance: Provenance) -> None:
        super().__init__(NodeId("Leave_untold", about, meeting.person), provenance)
        self._meeting = meeting.seen_by(self, writes=("announced",))
        self._who: str | None = None

    @property
    def ports(self) -> Ports:
        """Before whose visit."""
        return {"goes_to": self._meeting.person}

    def step(self) -> Status:
        """Clear the pending announcement."""
        self._who, self._meeting.shared.announced = self._meeting.shared.announced, None
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """The person left without an announcement."""
        return Account(f"{self._who} does not see, and could not be told that the robot leaves")
