"""The part of a visit's tree that fetches what is to be handed over.

    taken(tea, u) ?
    |- <> taken?(tea, u)
    '- Retry > Timeout > Fetch ->(memory)
       |- Way(tea, u) =>        Mind_way > Pass ?, Go_to: a person in the way is asked to pass, see `passing`
       '- Pick_up(tea, u)

What is fetched before the robot goes to the person at all must not cost them the rest of their visit:

    brought(tea, u) ?
    |- <> goes_without?(tea, u)
    |- taken(tea, u)            as above
    '- Go_without(tea, u)       SUCCESS: they are greeted, and then the robot tries once more

A visit in which nothing can be handed over is given up there, with the reason.
"""

from __future__ import annotations

from collections.abc import Mapping

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.leaves.give_up import why_failed
from comity_executor.leaves.task_conditions import IsTaken
from comity_executor.leaves.task_motion import GoTo, PickUp
from comity_executor.memory.task import Task
from comity_executor.nodes.cause import Account
from comity_executor.nodes.composites import fallback, parallel_until_one, sequence
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Action, Condition, Ports
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.trees.announcing import leave_told
from comity_executor.trees.passing import Passage, passing
from comity_fis.inference.value import Inference

FETCH_TIMEOUT_S = 90.0
"""One attempt to fetch something: the way may lead through the whole place (our choice)."""


def taken(task: Task, values: Mapping[str, Inference]) -> Behaviour:
    """The precondition that the robot holds what it is to hand over.

    Args:
        task: To hand it over.
        values: The parameters of people who may be asked to make way, by name.
    """
    limits, clock = task.meeting.limits, task.meeting.senses.now_s
    # Mind_way never succeeds by itself: Go_to decides.
    way = parallel_until_one(NodeId.of("Way", *task.about), [passing(_way_there(task), values), GoTo(task)])
    leave = [leave_told(task.meeting, task.about, task.fetch_provenance, values, goes_to=None)]
    before = leave if task.meeting.tells_leaving else []
    fetch = sequence(NodeId.of("Fetch", *task.about), [*before, way, PickUp(task)], memory=True)
    timeout = SimulatedTimeout(
        NodeId.of(f"Timeout {FETCH_TIMEOUT_S:g} s", "Fetch", *task.about),
        fetch,
        duration_s=FETCH_TIMEOUT_S,
        clock=clock,
        provenance=task.fetch_provenance,
    )
    retry = Retry(
        NodeId.of(f"Retry {limits.reach_attempts}", *task.about),
        timeout,
        attempts=limits.reach_attempts,
        pause_s=limits.reach_pause_s,
        clock=task.meeting.senses.now_s,
        provenance=task.fetch_provenance,
    )
    return fallback(NodeId.of("taken", *task.about), [IsTaken(task), retry])


def brought(task: Task, values: Mapping[str, Inference]) -> Behaviour:
    """The same before a greeting, which goes ahead without it where it cannot be had."""
    fetched = taken(task, values)
    children = [DoesGoWithout(task), fetched, GoWithout(task, fetched)]
    return fallback(NodeId.of("brought", *task.about), children)


def _way_there(task: Task) -> Passage:
    return Passage(task.meeting, task.about, task.fetch_provenance)


class DoesGoWithout(Condition):
    """`goes_without?`: could the robot not fetch it, so that it goes to the person without?"""

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of("goes_without?", *task.about), task.fetch_provenance)
        self._task = task.seen_by(self, reads=("without",))

    @property
    def ports(self) -> Ports:
        """What, and to whom."""
        return {"thing": self._task.thing, "person": self._task.person}

    def check(self) -> bool:
        """It stays so; a new plan may try again."""
        return self._task.memory.without is not None

    def explain(self) -> Account | None:
        """Why it could not."""
        return Account(self._task.memory.without) if self._task.memory.without else None


class GoWithout(Action):
    """SUCCESS at once: why it could not be fetched is remembered.

    Args:
        task: To hand it over.
        failed: The branch that failed before this leaf is reached.
    """

    def __init__(self, task: Task, failed: Behaviour) -> None:
        super().__init__(NodeId.of("Go_without", *task.about), task.fetch_provenance)
        self._task = task.seen_by(self, writes=("without",))
        self._failed = failed

    @property
    def ports(self) -> Ports:
        """What, and to whom."""
        return {"thing": self._task.thing, "person": self._task.person}

    def step(self) -> Status:
        """Remember why."""
        self._task.memory.without = why_failed(self._failed) or f"{self._failed.name} failed"
        return Status.SUCCESS

    def explain(self) -> Account | None:
        """Why it goes without."""
        return Account(self._task.memory.without) if self._task.memory.without else None
