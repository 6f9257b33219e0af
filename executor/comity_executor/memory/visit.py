"""One person's visit: what its nodes remember on the blackboard while it goes on, and what came of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from comity_domain.plans.plan import PlanStep
from comity_executor.memory.board import Board, Entry, Namespace
from comity_executor.robots.goals import GoalId, PlannedPose, RelativePose, unverified
from comity_executor.robots.noticed import Noticed
from comity_executor.robots.robot import Reading, is_seen
from comity_fis.inference.value import Inference
from comity_fis.record import Record

Outcome = Literal["pending", "greeted", "unfinished", "declined", "unreached", "not_greeted", "skipped"]
PROPER_OUTCOMES: tuple[Outcome, ...] = ("greeted", "declined", "skipped")
"""Outcomes of a visit that ended as it should: nothing is left to do for the person."""


@dataclass(frozen=True, slots=True)
class Deed(Record):
    """One thing on the agenda of a visit, and what came of it."""

    action: str
    arguments: tuple[str, ...]
    """As in the plan's step."""
    done_s: float | None
    """When it was done, in the world's time; None: it was not."""


@dataclass(frozen=True, slots=True)
class Visit:
    """What came of one visit, so far."""

    person: str
    outcome: Outcome
    """`unreached`: given up before the robot ever docked; `not_greeted`: given up later; `unfinished`:
    greeted, and given up before all of the agenda was done; `declined`: the person walked by, turned away or
    sped up before the robot, which goes to them no more; `skipped`: the plan leaves them out on purpose;
    `pending`: none of these, while the execution goes on.
    """
    pose: RelativePose | None
    """The last pose that was chosen; None before."""
    docked_at: Reading | None
    """The reading at the moment of the last docking."""
    docked_s: float | None
    """When that was, in the world's time."""
    greeting: tuple[str, ...]
    """The acts that were performed, `say` first."""
    failure: str | None
    """Why the visit was given up; None where it was not."""
    noticed: Noticed | None = None
    """How the person took it; None where the robot did not attend to that."""
    wanted: PlannedPose | None = None
    """Where the plan wants the robot to stand, with the numbers that it went by last."""
    agenda: tuple[Deed, ...] = ()
    """What else was to be done, in order."""
    greeted_s: float | None = None
    """When the last act of the greeting was done, in the world's time; None where it was not done here."""
    together_with: str | None = None
    """Before whom the robot stood, where it greeted a company at once and this person is another of it."""

    def shared_with(self, companion: str) -> Visit:
        """The same for a person who was greeted at once with this person: the pose is not theirs."""
        return replace(
            self,
            person=companion,
            pose=None,
            docked_at=None,
            docked_s=None,
            wanted=None,
            together_with=self.person,
        )

    @property
    def deviation_reason(self) -> str | None:
        """Why the robot did not take the wanted pose; None where it did."""
        return self.pose.deviation_reason if self.pose else None

    @property
    def unverified(self) -> str | None:
        """Why it is not known that the person was where the robot docked; None where it saw them there."""
        return None if self.docked_at is None or is_seen(self.docked_at) else unverified(self.pose)


def skipped_visit(person: str) -> Visit:
    """What came of a person whom the plan leaves out."""
    return Visit(person, "skipped", pose=None, docked_at=None, docked_s=None, greeting=(), failure=None)


@dataclass(frozen=True, slots=True)
class ShownWish:
    """How far away a person had the robot stand, by moving or asking; it holds when the robot comes back."""

    distance_m: float
    setting_m: float | None
    """What they had asked for outright by then; None: nothing. Who asks otherwise later means that."""

    def __str__(self) -> str:
        return f"{self.distance_m:.2f} m"


class TaskMemory(Board):
    """What the nodes of one thing on the agenda share.

    Args:
        space: The execution's namespace.
        person: Before whom.
        number: Its place on the agenda, from 1.
        step: The plan's step.
    """

    performed = Entry[tuple[str, ...]](())
    """Acts that ended well: a second docking does not repeat them."""
    handing_over = Entry[GoalId | None](None)
    """The act of handing over, once it has begun."""
    began_s = Entry[float | None](None)
    """Since when a pause has been waited for; None: not yet."""
    heard_before = Entry(0)
    """How much the person had said by then."""
    done_s = Entry[float | None](None)
    """When all of it was done."""
    without = Entry[str | None](None)
    """Why the robot went to greet without what it was to fetch before; None: it did not."""

    def __init__(self, space: Namespace, person: str, number: int, step: PlanStep) -> None:
        super().__init__(space, person, f"agenda-{number}")
        self.action, self.arguments = step.action, step.arguments

    def start_again(self) -> None:
        """Another plan is under way: what was done stays, what was tried is forgotten."""
        self.without = None

    def deed(self) -> Deed:
        """What came of it so far."""
        return Deed(self.action, self.arguments, self.done_s)


class VisitMemory(Board):
    """What the nodes of one visit share."""

    reach = Entry[PlanStep]()
    """The plan's step that leads to the person, with the numbers of now."""
    greet = Entry[PlanStep | None](None)
    """The greeting as it was planned last."""
    values = Entry[Inference]()
    """The person's parameters as they are now."""
    bindings = Entry(0)
    """How often it got other numbers to move by: a motion under way sees that its own are old."""
    pose = Entry[RelativePose | None](None)
    """Where the robot is to stand; None before it was chosen."""
    docked = Entry(False)
    """The last answer of `docked?`: which of the two bands holds."""
    docked_at = Entry[Reading | None](None)
    """The reading at the moment of the last docking."""
    docked_s = Entry[float | None](None)
    """When that was."""
    performed = Entry[tuple[str, ...]](())
    """Acts that ended well: a second docking does not repeat them."""
    performed_s = Entry[float | None](None)
    """When the last of them ended."""
    done_before = Entry[tuple[str, ...]](())
    """Acts that an execution before this one had done when it was halted."""
    attended = Entry(False)
    """Whether the robot has seen how the person took its coming."""
    noticed = Entry[Noticed | None](None)
    """The first signal of the person."""
    shown = Entry[ShownWish | None](None)
    """What the person showed of their distance last; it holds, too, where the robot comes back to them."""
    given_up = Entry(False)
    declined = Entry[str | None](None)
    """How the person declined the visit; None where they did not. No other plan tries again."""
    failure = Entry[str | None](None)
    """Why the visit was given up."""

    agenda: tuple[TaskMemory, ...] = ()

    @property
    def is_over(self) -> bool:
        """Whether the robot goes to the person no more, with this plan or with any."""
        return self.given_up or self.declined is not None

    @property
    def why(self) -> str | None:
        """Why the visit is over; None where it is not."""
        return self.declined or self.failure

    def give_up(self, reason: str) -> None:
        """No plan can serve them; another one may."""
        self.given_up, self.failure = True, reason

    def start_again(self) -> None:
        """Another plan is under way: what was done and noticed stays, what was tried is forgotten."""
        self.pose = self.failure = None
        self.docked = self.given_up = False
        for task in self.agenda:
            task.start_again()
