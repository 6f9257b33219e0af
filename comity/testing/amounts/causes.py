"""Causes from the trace, the plan and the rules: the last lines of every failure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING

from comity.report.values.inference import because as because_of_value
from comity.testing.amounts.amount import told
from comity.testing.amounts.holding import of_time
from comity.testing.amounts.planned import last_for, plans
from comity.testing.amounts.shaping import told_of
from comity.testing.trials.nodes import NodeWord
from comity.testing.trials.visits import judged_s, outcome_of, to_visit, visit_of
from comity_executor import PROPER_OUTCOMES

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import Cause, History, Node, TraceEvent
    from comity_fis import Inference

MOST = 8
"""Maximum number of links shown of a causal chain; `comity trace --why` shows the rest."""
TICK_S = 0.05
"""Duration of a tick [s]: a node may notice the end of something one tick later."""


def of_event(event: TraceEvent) -> Iterator[str]:
    """A node's event and its chain of causes."""
    halt = f" ({event.halt.replace('_', ' ')})" if event.halt else ""
    yield f"t={event.t:.2f} s  {event.node} {event.status}{halt}"
    yield from chain(event.because)


def chain(causes: Iterable[Cause]) -> Iterator[str]:
    """The links of a causal chain, one a line."""
    for cause in list(causes)[:MOST]:
        yield f"{cause.kind:9} {cause.words}"


def of_node(
    history: History, name: str, status: str | None = None, *, ended_s: float | None = None
) -> Iterator[str]:
    """The last event of a node and its causes; nothing if it never ran.

    Args:
        history: The recorded trace.
        name: Name of the node.
        status: Only events with this status; None for all.
        ended_s: If given, the node's first result or halt at or after this time [s], instead of its last
            event.
    """
    events = [
        event for event in history.events if event.node == name and (status is None or event.status == status)
    ]
    if ended_s is not None:
        over = (event for event in events if event.status != "running" and event.t > ended_s - TICK_S / 2)
        events = list(islice(over, 1))
    for event in events[-1:]:
        yield f"t={event.t:.2f} s  {event.node} {event.status}"
        why = history.why_node(event.path, event.t)
        yield from chain(event.because or (why.because if why else ()))


def of_last(history: History, nodes: Iterable[Node]) -> Iterator[str]:
    """The last event of each of these nodes, and its causes."""
    for name in dict.fromkeys(node.name for node in nodes):
        yield from tuple(of_node(history, name)) or (f"{name} never ran",)


def at_time(history: History, t: float, actions: Collection[str] = ()) -> Iterator[str]:
    """Causes of what the robot did at a time [s]; causes of an earlier failed attempt are left out.

    Args:
        history: The recorded trace.
        t: The time [s].
        actions: Only these actions; empty for all.
    """
    for why in history.why_at(t):
        if actions and why.event.action not in actions:
            continue
        yield f"t={t:.2f} s  {why.event.node} {why.event.status} since t={why.event.t:.2f} s"
        tried = why.switched_by
        if tried is not None and tried.status == "failure" and tried.of.kind == "action":
            yield f"again     {tried.node} failed at t={tried.t:.2f} s"
        else:
            yield from chain(why.because)


def of_value(values: Inference, parameter: str, whose: str) -> Iterator[str]:
    """A parameter's value for a person or profile, its contributions, and the rules that fired."""
    value = values[parameter]
    yield f"parameter {parameter} of {whose} {told(value.value, value.unit)} ({value.origin})"
    for line in because_of_value(value, values.inputs).splitlines():
        yield f"made of   {line}"


def of_parameter(
    episode: Episode, parameter: str, person: str, counts_s: float | None = None
) -> Iterator[str]:
    """A parameter's value for a person in an episode, its contributions, and its earlier values.

    Args:
        episode: What happened.
        parameter: Name of the parameter.
        person: Whose.
        counts_s: Time at which the value counts [s]; None for the time of their visit.
    """
    at_s = judged_s(episode, person, parameter) if counts_s is None else counts_s
    yield from of_value(episode.values_at(person, at_s), parameter, person)
    yield from of_time(episode, parameter, person, at_s)


def of_step(episode: Episode, action: str, person: str) -> Iterator[str]:
    """A step of the last plan that visits a person, and its reasons; after replanning, also why."""
    found = last_for(plans(episode), person, action)
    if found is None:
        return
    for step in found.plan.steps:
        if step.action.startswith(action) and person in step.people:
            told = ", of a new plan" if found.because else ""
            yield f"step      {step.action}({', '.join(step.arguments)}){told}"
            yield f"because   {step.why.text}"
            yield from (f"not open  {', '.join(out.arguments)}: {out.reason}" for out in step.why.ruled_out)
    yield from chain(found.because)


def absent(node: str) -> str:
    """A sentence that the tree has no node of this name."""
    return f"the tree has no {node}"


def of_absence(episode: Episode, node: str) -> Iterator[str]:
    """Why the tree has no node of a name: who is not visited, how the others are greeted, and the rules."""
    reached = {person for step in episode.prepared.plan.steps for person in step.people}
    named = NodeWord.of(node)
    for person in to_visit(episode):
        if not named.may_be_about(person):
            continue
        if person not in reached:
            yield from of_visit(episode, person)
            continue
        yield from of_step(episode, "Greet", person)
        asked_for = ((person, name) for name in ("greeting_modality", "greeting_gesture"))
        yield from told_of(episode.prepared.values, episode.told, asked_for)


def of_unserved(episode: Episode) -> Iterator[str]:
    """Why people were not greeted although planned: nodes of their visits never ran."""
    for person in to_visit(episode):
        if outcome_of(episode, person) not in PROPER_OUTCOMES:
            yield from of_visit(episode, person)


def of_visit(episode: Episode, person: str) -> Iterator[str]:
    """Why a person's visit went as it did."""
    visit = visit_of(episode.visits, person)
    if visit is None:
        reason = episode.prepared.asked.unreachable.get(person)
        yield f"plan      {reason or 'no step of it serves ' + person}"
        return
    if visit.failure or visit.deviation_reason:
        yield f"visit     {visit.failure or visit.deviation_reason}"
    if visit.together_with:
        yield f"visit     {person} is greeted with {visit.together_with}, before whom the robot stands"
    yield from of_step(episode, "Reach_user", visit.together_with or person)
