"""The part of a visit's tree that comes after the greeting: a block for each thing on the agenda.

    given(tea, u) ?
    |- <> given?(tea, u)
    '- Achieve ->
       |- taken(tea, u) ?                   what is to be handed over is fetched, see `fetching`
       |- docked(u) ?                       as for the greeting
       '- Offer =>                          Keep_distance, Perform =>   per act: ?(done?, Timeout > act)

A farewell ends with Step_away, which no docking follows.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from py_trees.behaviour import Behaviour

from comity_domain.plans.actions import LEAVE
from comity_domain.problem.agenda import Wait
from comity_executor.leaves.custom_act import CustomAct
from comity_executor.leaves.keep_distance import KeepDistance
from comity_executor.leaves.task_act import TaskAct, WaitBefore
from comity_executor.leaves.task_conditions import AreActsDone, IsTaskActDone, IsTaskDone
from comity_executor.leaves.task_motion import StepAway
from comity_executor.memory.task import Task
from comity_executor.memory.visit_context import SAY_ACT, VisitContext
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.composites import fallback, parallel_until_all, parallel_until_one, sequence
from comity_executor.nodes.identity import NodeId

SUBTREES: Mapping[str, Callable[[Task], Behaviour]] = {Wait.action: WaitBefore}
"""By action, its subtree, where it is more than acts of the robot."""
SECONDS_PER_CHARACTER = 0.12
"""What is said may take so long at the normal rate, twice what calm speech does (our choice)."""

Docked = Callable[[VisitContext], Behaviour]
"""How the precondition of being docked is made."""
Taken = Callable[[Task], Behaviour]
"""How the precondition of holding what is to be handed over is made."""


def block(task: Task, docked: Docked, taken: Taken) -> Behaviour:
    """The postcondition-precondition-action block of a task."""
    achieve = _leave(task, docked, taken) if task.step.action == LEAVE else _achieve(task, docked, taken)
    return fallback(NodeId.of(task.effect, *task.about), [IsTaskDone(task), achieve])


def _achieve(task: Task, docked: Docked, taken: Taken) -> Behaviour:
    before = [taken(task)] if task.fetch else []
    doing = SUBTREES.get(task.step.action, _perform)(task)
    action = parallel_until_one(  # Keep_distance never ends by itself
        NodeId.of(task.step.action, *task.about), [KeepDistance(task.meeting), doing]
    )
    achieve = NodeId.of("Achieve", task.step.action, *task.about)
    return sequence(achieve, [*before, docked(task.meeting), action])


def _leave(task: Task, docked: Docked, taken: Taken) -> Behaviour:
    said = fallback(NodeId.of("taken_leave", *task.about), [AreActsDone(task), _achieve(task, docked, taken)])
    return sequence(NodeId.of("Leave", *task.about), [said, StepAway(task)])


def _perform(task: Task) -> Behaviour:
    return parallel_until_all(NodeId.of("Perform", *task.about), [_done(task, act) for act in task.acts])


def _act(task: Task, act: str) -> Behaviour:
    make = task.meeting.custom.get(act)
    return CustomAct(act, task.about, make, task) if make else TaskAct(task, act)


def _done(task: Task, act: str) -> Behaviour:
    limits, rate = task.meeting.limits, min(1.0, task.meeting.manner.rate)
    normal_s = SECONDS_PER_CHARACTER * len(task.latin) if act == SAY_ACT else 0.0
    patience_s = max(limits.act_timeout_s, normal_s) / rate  # slow speech takes its time
    timeout = ActTimeout(
        NodeId.of(f"Timeout {patience_s:g} s", act, *task.about),
        _act(task, act),
        duration_s=patience_s,
        pause_s=limits.act_pause_s,
        clock=task.meeting.senses.now_s,
        provenance=task.provenance,
    )
    return fallback(NodeId.of("done", act, *task.about), [IsTaskActDone(task, act), timeout])
