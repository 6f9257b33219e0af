"""One person's visit: its state on the blackboard during execution, and its outcome."""

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
    """One item of a visit's agenda, and its outcome."""

    action: str
    arguments: tuple[str, ...]
    """As in the plan's step."""
    done_s: float | None
    """Time when it was done [s]; None: not done."""


@dataclass(frozen=True, slots=True)
class Visit:
    """The outcome of one visit so far."""

    person: str
    outcome: Outcome
    """`unreached`: given up before the robot ever docked; `not_greeted`: given up later; `unfinished`:
    greeted, and given up before the whole agenda was done; `declined`: the person walked by, turned away or
    sped up in front of the robot, which does not approach them again; `skipped`: the plan leaves them out on
    purpose; `pending`: none of these, while the execution continues.
    """
    pose: RelativePose | None
    """The last chosen docking pose; None before."""
    docked_at: Reading | None
    """The reading at the moment of the last docking."""
    docked_s: float | None
    """Time of the last docking [s]."""
    greeting: tuple[str, ...]
    """The performed acts, `say` first."""
    failure: str | None
    """Why the visit was given up; None if it was not."""
    noticed: Noticed | None = None
    """The person's reaction; None if the robot did not attend to it."""
    wanted: PlannedPose | None = None
    """The planned docking pose, with its latest parameters."""
    agenda: tuple[Deed, ...] = ()
    """The further items, in order."""
    greeted_s: float | None = None
    """Time of the last act of the greeting [s]; None if it was not done in this execution."""
    together_with: str | None = None
    """The person in front of whom the robot stood, if it greeted a group and this is another member."""

    def shared_with(self, companion: str) -> Visit:
        """The visit of a companion greeted together with this person; the pose is not theirs."""
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
        """Why the robot did not take the target pose; None if it did."""
        return self.pose.deviation_reason if self.pose else None

    @property
    def unverified(self) -> str | None:
        """Why the person's presence at docking is unverified; None if the robot saw them."""
        return None if self.docked_at is None or is_seen(self.docked_at) else unverified(self.pose)


def skipped_visit(person: str) -> Visit:
    """The visit of a person whom the plan leaves out."""
    return Visit(person, "skipped", pose=None, docked_at=None, docked_s=None, greeting=(), failure=None)


@dataclass(frozen=True, slots=True)
class ShownWish:
    """The distance that a person chose by moving or asking; it holds when the robot returns."""

    distance_m: float
    setting_m: float | None
    """Their earlier explicit request [m]; None: none. A later explicit request takes precedence."""

    def __str__(self) -> str:
        return f"{self.distance_m:.2f} m"


class TaskMemory(Board):
    """The state shared by the nodes of one agenda item.

    Args:
        space: The execution's namespace.
        person: The visited person.
        number: Its position on the agenda, from 1.
        step: The plan's step.
    """

    performed = Entry[tuple[str, ...]](())
    """Acts that ended well: a second docking does not repeat them."""
    handing_over = Entry[GoalId | None](None)
    """The act of handing over, once it has begun."""
    began_s = Entry[float | None](None)
    """Start of a pause [s]; None: not yet."""
    heard_before = Entry(0)
    """Number of the person's utterances at that time."""
    done_s = Entry[float | None](None)
    """Time when all of it was done [s]."""
    without = Entry[str | None](None)
    """Why the robot went to greet without what it should have fetched first; None: it did not."""

    def __init__(self, space: Namespace, person: str, number: int, step: PlanStep) -> None:
        super().__init__(space, person, f"agenda-{number}")
        self.action, self.arguments = step.action, step.arguments

    def start_again(self) -> None:
        """Reset for a new plan: results stay, failed attempts are forgotten."""
        self.without = None

    def deed(self) -> Deed:
        """The outcome so far."""
        return Deed(self.action, self.arguments, self.done_s)


class VisitMemory(Board):
    """The state shared by the nodes of one visit."""

    reach = Entry[PlanStep]()
    """The plan step that leads to the person, with its current parameters."""
    greet = Entry[PlanStep | None](None)
    """The greeting as last planned."""
    values = Entry[Inference]()
    """The person's current parameters."""
    bindings = Entry(0)
    """Number of updates of the motion parameters: a running motion detects that its own are old."""
    pose = Entry[RelativePose | None](None)
    """The docking pose; None before it is chosen."""
    docked = Entry(False)
    """The last result of `docked?`: selects the band to check."""
    docked_at = Entry[Reading | None](None)
    """The reading at the moment of the last docking."""
    docked_s = Entry[float | None](None)
    """Time of the last docking [s]."""
    performed = Entry[tuple[str, ...]](())
    """Acts that ended well: a second docking does not repeat them."""
    performed_s = Entry[float | None](None)
    """Time when the last of them ended [s]."""
    done_before = Entry[tuple[str, ...]](())
    """Acts done by an earlier, halted execution."""
    attended = Entry(False)
    """Whether the robot has observed the person's reaction to its approach."""
    noticed = Entry[Noticed | None](None)
    """The first signal of the person."""
    shown = Entry[ShownWish | None](None)
    """The distance that the person last chose; it also holds when the robot returns."""
    given_up = Entry(False)
    declined = Entry[str | None](None)
    """How the person declined the visit, or the rest of it after the greeting; None if they did not. No other
    plan tries again."""
    failure = Entry[str | None](None)
    """Why the visit was given up."""

    agenda: tuple[TaskMemory, ...] = ()

    @property
    def is_over(self) -> bool:
        """Whether the robot will not approach the person again, with this plan or any."""
        return self.given_up or self.declined is not None

    def give_up(self, reason: str) -> None:
        """Give up the visit in this plan; a later plan may try again."""
        self.given_up, self.failure = True, reason

    def start_again(self) -> None:
        """Reset for a new plan: results stay, failed attempts are forgotten."""
        self.pose = self.failure = None
        self.docked = self.given_up = False
        for task in self.agenda:
            task.start_again()
