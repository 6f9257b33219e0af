"""The acts of an agenda: speech, gestures, handovers, and pauses."""

from __future__ import annotations

from py_trees.common import Status

from comity_domain.plans.actions import LEAVE
from comity_domain.problem.agenda import Say
from comity_domain.problem.bound_parameters import ABOUT_GESTURES, ABOUT_SPEECH, ABOUT_WORDS
from comity_executor.leaves.body_act import BodyAct
from comity_executor.memory.task import Task
from comity_executor.memory.visit_context import SAY_ACT
from comity_executor.nodes.cause import Account
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Ports
from comity_executor.robots.carrier import HAND_OVER
from comity_executor.robots.goals import ActGoal, speech
from comity_executor.robots.noticed import noticed
from comity_executor.robots.robot import Reading
from comity_executor.speech.utterance import Utterance


class TaskAct(BodyAct):
    """Speak, gesture or hand something over once; the task's memory records a completed act."""

    def __init__(self, task: Task, act: str) -> None:
        super().__init__(NodeId.of(act, *task.about), task.meeting, act, task.provenance)
        self._task = task.seen_by(self, writes=("performed", "handing_over", "done_s"), of_visit=("values",))
        self._meeting = self._task.meeting
        self._tells = task.tells_leaving and act == SAY_ACT
        self._shared = task.meeting.shared.seen_by(self, writes=("announced",) if self._tells else ())

    @property
    def ports(self) -> Ports:
        """The act, and the object handed over."""
        return {**super().ports, **self._task.ports, "text": self.text}

    def words(self) -> Utterance | str | None:
        """The utterance; None for other acts."""
        return self._task.words if self._act == SAY_ACT else None

    def goal(self) -> ActGoal:
        """The goal for the robot; a handover names its object."""
        task, words, manner = self._task, self.words(), self._task.meeting.manner
        if words is not None:
            return speech(self._act, task.person, words, manner=manner)
        thing = task.step.parameters.get("thing")
        return ActGoal(
            self._act,
            task.person,
            thing=None if thing is None else str(thing),
            manner=manner,
            parameters=task.own_parameters,
        )

    def begin(self) -> None:
        """Start the act; an object being handed over counts as leaving the robot's hands."""
        super().begin()
        if self._act == HAND_OVER:
            self._task.memory.handing_over = self._performing.goal

    def remember(self) -> None:
        """Record the act in the task's memory; the last act completes the task."""
        if self._tells:
            self._shared.announced = None
        self._task.note_done(self._act)

    def explain(self) -> Account | None:
        """Whether the act is over or was aborted, and which parameters shaped it."""
        text = self.how_it_went()
        if self._act == HAND_OVER:
            return Account(text, parameter="conversational_distance")
        if self._task.step.action == LEAVE and self._act != SAY_ACT:
            return Account(text, parameter="greeting_gesture", others=self.told(ABOUT_GESTURES))
        if self._act != SAY_ACT:
            return Account(text)
        words = () if self._task.step.action == Say.action else ABOUT_WORDS
        return Account(text, others=self.told((*ABOUT_SPEECH, *words)), fault=self.trouble())


class WaitBefore(Action):
    """Wait until the time is over, or the person does what the pause waits for."""

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of("Wait_before", task.person), task.provenance)
        self._task = task.seen_by(self, writes=("began_s", "heard_before", "done_s"))
        self._cap_s = float(task.step.parameters["cap_s"])
        self._until = task.step.parameters.get("until")
        self._first: Reading | None = None
        self._text = ""

    @property
    def ports(self) -> Ports:
        """The events that end it."""
        return {"person": self._task.person, "cap_s": self._cap_s, "until": str(self._until or "time")}

    def begin(self) -> None:
        """Record the initial reading; an interrupted pause is continued, not restarted."""
        meeting, memory = self._task.meeting, self._task.memory
        if memory.began_s is None:
            memory.began_s = meeting.senses.now_s()
            memory.heard_before = len(meeting.robot.heard(meeting.person))
        self._first = None

    def step(self) -> Status:
        """SUCCESS when the pause is over."""
        meeting, began_s = self._task.meeting, self._task.memory.began_s
        assert began_s is not None  # set by begin
        waited_s = meeting.senses.now_s() - began_s
        seen = self._happened()
        if seen is None and waited_s < self._cap_s - 1e-9:
            return Status.RUNNING
        self._text = seen or f"{self._cap_s:g} s are over" + (", nothing happened" if self._until else "")
        self._task.memory.done_s = meeting.senses.now_s()
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """The event that ended it."""
        return Account(self._text) if self._text else None

    def _happened(self) -> str | None:
        """The person's action, if it ends the pause."""
        meeting = self._task.meeting
        if self._until == "speaks":
            words = meeting.robot.heard(meeting.person)[self._task.memory.heard_before :]
            return f"{meeting.person} said “{words[0].text}”" if words else None
        reading = meeting.senses.read(meeting.person)
        if self._until != "moves" or reading is None:
            return None
        self._first = self._first or reading
        moved = noticed(self._first, reading, (), meeting.senses.now_s())
        return f"{meeting.person} moved" if moved else None
