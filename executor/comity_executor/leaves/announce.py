"""Telling a person who does not see, in words, that the robot comes, has stopped, and leaves."""

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
"""So much earlier than it must the robot halts to speak: for noise and the tick's length (our choice)."""
REACTS_S = 0.1
"""From the reading to the brakes: two control ticks (our choice)."""
GONE_M = 1.0
"""So much farther away than where it was told, the robot is told of again (our choice)."""


def is_announced(meeting: VisitContext) -> bool:
    """Whether the plan has the robot tell this person that it comes."""
    return ANNOUNCED in meeting.reach.parameters


def halting_m(meeting: VisitContext, speed_m_s: float) -> float:
    """The distance at which a robot of this speed has to brake so as to rest before it is `SPOKEN_TO_M` near.

    It is the sum of that, the way during the base's latency, v^2 / (2 a) of braking, and a margin [m].
    """
    base = meeting.robot.capabilities
    braking_m = speed_m_s**2 / (2.0 * base.braking_m_s2)
    return SPOKEN_TO_M + MARGIN_M + base.tolerance_m + speed_m_s * (base.latency_s + REACTS_S) + braking_m


class IsComingTold(Condition):
    """`coming_told?`: was the person told that the robot comes, and has it not been far away since?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("coming_told?", meeting.person), meeting.reach_grounds)
        self._meeting = meeting.seen_by(self, reads=("announced",))
        self._text = ""

    @property
    def ports(self) -> Ports:
        """The person it is about."""
        return {"person": self._meeting.person}

    def check(self) -> bool:
        """It was so once the words were spoken; a person who went far away is told again."""
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
        """What is missing."""
        return Account(self._text or f"{self._meeting.person} was told", parameter=ANNOUNCED)


class ComeNear(NavigateToUser):
    """Set out to the person, and halt before the robot is nearer than `SPOKEN_TO_M`."""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(meeting, verb="Come_near")

    def begin(self) -> None:
        """Set out, unless the robot is near already: then it does not move until it has spoken."""
        if self._is_near():
            MotionAction.begin(self)
        else:
            super().begin()

    def step(self) -> Status:
        """SUCCESS where the robot has to halt, or is close to its pose; FAILURE as on any way."""
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
    """Words about what the robot does.

    Args:
        verb: Names the node.
        meeting: Whose branch it belongs to.
        reads: What it reads on the blackboard.
    """

    def __init__(self, verb: str, meeting: VisitContext, *, reads: tuple[str, ...] = ()) -> None:
        super().__init__(NodeId.of(verb, meeting.person), meeting, SAY_ACT, meeting.reach_grounds)
        self.verb = verb
        self._meeting = meeting.seen_by(self, reads=("values", *reads), writes=("announced", "stopped_s"))

    def goal(self) -> ActGoal:
        """In the manner that suits the person."""
        meeting = self._meeting
        return speech(SAY_ACT, meeting.person, self.words(), manner=meeting.manner)

    @abstractmethod
    def words(self) -> Utterance:
        """What is said."""

    def explain(self) -> Account | None:
        """What was said, and that the person does not see."""
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
        """In the person's language."""
        return self._meeting.speaker.coming(self._meeting.person, self._meeting.values)

    def remember(self) -> None:
        """From now on the person is to be told, too, when the robot leaves."""
        self._meeting.shared.announced = self._meeting.person


class SayStopped(Announcement):
    """Tell the person where the robot has stopped."""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__("Say_stopped", meeting, reads=("reach", "docked_at", "docked_s"))

    def words(self) -> Utterance:
        """As the person would see it: in front, to the left."""
        meeting = self._meeting
        docked_at = meeting.memory.docked_at
        bearing_deg = meeting.wanted.bearing_deg if docked_at is None else docked_at.bearing_deg
        return meeting.speaker.stopped(meeting.person, bearing_deg, meeting.values)

    def remember(self) -> None:
        """Of this docking; the next one is told again."""
        self._meeting.shared.stopped_s = self._meeting.memory.docked_s
        self._meeting.shared.announced = self._meeting.person


class IsStopTold(Condition):
    """`stop_told?`: was the person told that, and where, the robot has stopped?"""

    def __init__(self, meeting: VisitContext) -> None:
        super().__init__(NodeId.of("stop_told?", meeting.person), meeting.reach_grounds)
        self._meeting = meeting.seen_by(self, reads=("stopped_s", "docked_s"))

    @property
    def ports(self) -> Ports:
        """The person it is about."""
        return {"person": self._meeting.person}

    def check(self) -> bool:
        """Once for every docking."""
        return self._meeting.shared.stopped_s == self._meeting.memory.docked_s

    def explain(self) -> Account | None:
        """Whether the words are spoken."""
        told = "was told" if self.check() else "does not see, and was not told yet,"
        return Account(f"{self._meeting.person} {told} that the robot has stopped", parameter=ANNOUNCED)


class IsLeaveTold(Condition):
    """`leave_told?`: is there nobody who does not see and is still to be told that the robot leaves them?

    Args:
        meeting: Whose branch it belongs to.
        about: What the node's name has in brackets.
        provenance: The step for which the robot leaves.
        goes_to: The person whom it goes to, who is not left; None: it goes to a place.
    """

    def __init__(
        self, meeting: VisitContext, about: tuple[str, ...], provenance: Provenance, *, goes_to: str | None
    ) -> None:
        super().__init__(NodeId("leave_told?", about, meeting.person), provenance)
        self._meeting = meeting.seen_by(self, reads=("announced",))
        self._goes_to = goes_to

    @property
    def ports(self) -> Ports:
        """Who is not left."""
        return {"goes_to": self._goes_to or ""}

    def check(self) -> bool:
        """Ask who was told last that the robot comes."""
        return self._meeting.shared.announced in (None, self._goes_to)

    def explain(self) -> Account | None:
        """Who it is."""
        who = self._meeting.shared.announced
        if who in (None, self._goes_to):
            return None
        return Account(f"{who} does not see, and was not told yet that the robot leaves")


class SayLeaving(Action):
    """Tell the person beside whom the robot stands that it leaves.

    Args:
        meeting: Whose branch it belongs to.
        about: What the node's name has in brackets.
        provenance: The step for which the robot leaves.
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
        """Before whose visit."""
        return {"goes_to": self._meeting.person}

    def begin(self) -> None:
        """Speak in the manner that suits the person."""
        self._who = self._meeting.shared.announced or self._meeting.person
        values = self._values[self._who]
        words = self._meeting.speaker.leaving(self._who, values)
        self._text = words.latin
        self._performing.begin(speech(SAY_ACT, self._who, words, manner=manner_of(values)), values)

    def step(self) -> Status:
        """SUCCESS when it is said, FAILURE when it was broken off from elsewhere."""
        self._performing.look()
        if self._performing.is_lost:
            return Status.FAILURE
        if not self._performing.is_done:
            return Status.RUNNING
        self._meeting.shared.announced = None
        return Status.SUCCESS

    def end(self) -> None:
        """Fall silent, unless all is said."""
        self._performing.end()

    def explain(self) -> Account | None:
        """What was said."""
        said = "was told" if self._performing.is_done else "could not be told"
        fault = trouble_of(self._meeting.robot, VOICE) if self._performing.is_lost else None
        return Account(f"{self._who} does not see, and {said} “{self._text}”", fault=fault)


class LeaveUntold(Action):
    """SUCCESS at once: a robot that cannot speak does not stand beside the person for ever."""

    def __init__(self, meeting: VisitContext, about: tuple[str, ...], provenance: Provenance) -> None:
        super().__init__(NodeId("Leave_untold", about, meeting.person), provenance)
        self._meeting = meeting.seen_by(self, writes=("announced",))
        self._who: str | None = None

    @property
    def ports(self) -> Ports:
        """Before whose visit."""
        return {"goes_to": self._meeting.person}

    def step(self) -> Status:
        """Nobody is to be told any more."""
        self._who, self._meeting.shared.announced = self._meeting.shared.announced, None
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """Who was left without a word."""
        return Account(f"{self._who} does not see, and could not be told that the robot leaves")
