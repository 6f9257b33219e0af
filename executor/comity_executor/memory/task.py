"""One thing on the agenda of a visit: where the robot stands for it, and what it does."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf

from py_trees.behaviour import Behaviour

from comity_domain.plans.actions import ANNOUNCED, FETCH, LEAVE, OFFER, RETURN
from comity_domain.plans.plan import PlanStep
from comity_domain.problem.agenda import PLAIN
from comity_executor.memory.visit import TaskMemory, VisitMemory
from comity_executor.memory.visit_context import SAY_ACT, VisitContext, acts_of
from comity_executor.nodes.cause import Provenance
from comity_executor.nodes.leaf import Ports
from comity_executor.robots.carrier import HAND_OVER, Carrier
from comity_executor.robots.status import known_performance
from comity_executor.speech.utterance import Utterance

EFFECTS = {**{kind.action: kind.effect for kind in PLAIN}, OFFER: "given", LEAVE: "left"}
"""What is so once a step is done."""
PLAIN_ACTIONS = frozenset(kind.action for kind in PLAIN)


@dataclass(frozen=True, slots=True)
class Task:
    """One step of the agenda."""

    step: PlanStep
    meeting: VisitContext
    """How the robot stands before the person for it."""
    fetch: PlanStep | None
    """How it gets what it hands over; None where it hands over nothing, or holds it already."""
    memory: TaskMemory
    hands: Carrier | None
    """The robot, where it can carry things."""
    fetched_before: bool = False
    """Whether the robot fetches it before it comes."""
    tells_leaving: bool = False
    """Whether its words tell a person who does not see that the robot leaves."""

    def seen_by(
        self,
        leaf: Behaviour,
        *,
        reads: Collection[str] = (),
        writes: Collection[str] = (),
        of_visit: Collection[str] = (),
    ) -> Task:
        """The same as a leaf uses it, which declares the entries that it reads and writes.

        Args:
            leaf: Who.
            reads: Entries of the task that it only reads.
            writes: Entries of the task that it writes.
            of_visit: Entries of the visit that it reads.
        """
        memory = self.memory.seen_by(leaf, reads=reads, writes=writes)
        return replace(self, memory=memory, meeting=self.meeting.seen_by(leaf, reads=of_visit))

    @property
    def person(self) -> str:
        """Before whom."""
        return self.step.person

    @property
    def provenance(self) -> Provenance:
        """What its nodes stand on."""
        return Provenance(self.step, self.meeting.values)

    @property
    def fetch_provenance(self) -> Provenance:
        """What the nodes stand on that fetch something for it."""
        return Provenance(self.fetch or self.step, self.meeting.values)

    @property
    def about(self) -> tuple[str, ...]:
        """What the names of its nodes have in brackets: what is handed over, and the person."""
        return (self.thing, self.person) if self.step.action == OFFER else (self.person,)

    @property
    def effect(self) -> str:
        """What is so afterwards: `said`."""
        return EFFECTS[self.step.action]

    @property
    def thing(self) -> str:
        """What is handed over."""
        return str(self.step.parameters["thing"])

    @property
    def own_parameters(self) -> Mapping[str, float | str]:
        """Of a plain task, the parameters of its step besides the thing: its act is given them."""
        if self.step.action not in PLAIN_ACTIONS:
            return {}
        return {name: value for name, value in self.step.parameters.items() if name != "thing"}

    @property
    def carrier(self) -> Carrier:
        """The robot, as far as it brings things.

        Raises:
            ValueError: It does not.
        """
        if self.hands is None:
            raise ValueError(
                f"the plan brings {self.thing} to {self.person}, and the robot cannot carry things"
            )
        return self.hands

    @property
    def detour_m(self) -> float:
        """How much farther the robot goes for it rather than ask: any way, once it has asked in vain."""
        return inf if self.meeting.asking.may_go_round(self.about) else self.meeting.limits.detour_m

    @property
    def acts(self) -> tuple[str, ...]:
        """What it consists of, `say` first."""
        match self.step.action:
            case "Offer":
                return (SAY_ACT, HAND_OVER) if self.step.parameters["modality"] == "both" else (HAND_OVER,)
            case "Take_leave":
                return acts_of(self.step)
        return (self.step.action.lower(),)

    @property
    def words(self) -> Utterance | str:
        """What is said, by our wordings or in words of the scenario's own."""
        speaker, values = self.meeting.speaker, self.meeting.values
        match self.step.action:
            case "Offer":
                return speaker.handing_over(self.person, self.thing, values)
            case "Take_leave":
                return speaker.farewell(self.person, values, leaving=self.tells_leaving)
        return str(self.step.parameters["text"])

    @property
    def latin(self) -> str:
        """What is said in Latin letters, whose number says how long it takes."""
        words = self.words
        return words.latin if isinstance(words, Utterance) else words

    @property
    def ports(self) -> Ports:
        """What another engine knows the task by: two of a visit differ in it."""
        parameters = self.step.parameters
        named = {name: str(parameters.get(name, "")) for name in ("thing", "text")}
        return {"task": self.step.action, "person": self.person, **named}

    def note_done(self, act: str) -> None:
        """Remember an act that came to its end; the task is over with its last one."""
        self.memory.performed = (*self.memory.performed, act)
        if self.step.action != LEAVE and all(each in self.memory.performed for each in self.acts):
            self.memory.done_s = self.meeting.senses.now_s()  # a farewell ends with the step away

    def is_taken(self) -> bool:
        """Whether the robot holds what it is to hand over, or has just handed it over."""
        if HAND_OVER in self.memory.performed or self.carrier.carried() == self.thing:
            return True
        # In the tick in which the act ends the hands are empty before the act itself has noticed.
        act = self.memory.handing_over
        return act is not None and known_performance(self.meeting.robot, act).state == "succeeded"


def agenda_of(steps: Sequence[PlanStep], meeting: VisitContext) -> tuple[Task, ...]:
    """What is to be done after the greeting, each with where the robot stands for it.

    Args:
        steps: All steps of a visit.
        meeting: The visit's, with the first stop.

    Raises:
        ValueError: Something is to be handed over that is not fetched, or by a robot that cannot carry.
    """
    tasks: list[Task] = []
    here, fetch, reached, returns = meeting, None, False, 0
    first = None
    hands = meeting.robot if isinstance(meeting.robot, Carrier) else None
    memories = iter(_memories(steps, meeting))
    for step in steps:
        if step.action == FETCH:
            fetch = step
            first = step if not reached else first
        elif step.action == RETURN:
            returns += 1
            here = _return_stop(meeting, step, returns)
        elif step.action in EFFECTS:
            brings = fetch if step.action == OFFER else None
            fetched_before = brings is not None and brings is first
            tells_leaving = step.action == LEAVE and ANNOUNCED in here.reach.parameters
            task = Task(step, here, brings, next(memories), hands, fetched_before, tells_leaving)
            _check(task)
            tasks.append(task)
            fetch = None if brings else fetch
        else:
            reached = True
    return tuple(tasks)


def _return_stop(meeting: VisitContext, step: PlanStep, number: int) -> VisitContext:
    """Where the robot comes back to the person: what they showed of their distance holds there, too."""
    memory = VisitMemory(
        meeting.memory.space, meeting.person, f"return-{number}", elsewhere={"shown": meeting.memory}
    )
    memory.reach, memory.greet, memory.values = step, meeting.greet, meeting.values
    return replace(meeting, memory=memory)


def _memories(steps: Sequence[PlanStep], meeting: VisitContext) -> tuple[TaskMemory, ...]:
    """What is remembered of these tasks; a plan for the rest of a visit has the last ones of its agenda."""
    visit = meeting.memory
    left = [step for step in steps if step.action in EFFECTS]
    done, known = visit.agenda[: -len(left) or None], visit.agenda[len(visit.agenda) - len(left) :]
    if [task.action for task in known] != [step.action for step in left]:
        numbered = enumerate(left, start=1)
        done, known = (), tuple(TaskMemory(visit.space, meeting.person, *one) for one in numbered)
    for task, step in zip(known, left, strict=True):
        task.arguments = step.arguments
    visit.agenda = (*done, *known)
    return known


def _check(task: Task) -> None:
    if task.step.action != OFFER:
        return
    _ = task.carrier  # refuses a robot that cannot carry things
    if task.fetch is None and not task.is_taken():
        raise ValueError(f"{task.thing} is to be handed over to {task.person} and was not fetched")
