"""Why something is as it is, from the trace, the plan and the rules: the last lines of every failure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING

from comity.report.values.inference import because as because_of_value
from comity.testing.amounts.amount import told
from comity.testing.amounts.holding import of_time
from comity.testing.amounts.planned import last_for
from comity.testing.amounts.shaping import told_of
from comity_executor import PROPER_OUTCOMES

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_executor import Cause, TraceEvent
    from comity_fis import Inference

MOST = 8
"""Links of a chain: the rest is in `comity trace --why`."""
TICK_S = 0.05
"""Nodes run from tick to tick: so much later one may notice what is over."""


def of_event(event: TraceEvent) -> Iterator[str]:
    """What a node did, and its chain of causes."""
    halt = f" ({event.halt.replace('_', ' ')})" if event.halt else ""
    yield f"t={event.t:.2f} s  {event.node} {event.status}{halt}"
    yield from chain(event.because)


def chain(causes: Iterable[Cause]) -> Iterator[str]:
    """The links of a chain, a line each."""
    for cause in list(causes)[:MOST]:
        yield f"{cause.kind:9} {cause.words}"


def of_node(
    trial: Trial, name: str, status: str | None = None, *, ended_s: float | None = None
) -> Iterator[str]:
    """What a node did last, and why; nothing where it did nothing.

    Args:
        trial: What happened.
        name: The node's.
        status: Of its results this alone.
        ended_s: Instead, how that ended which was over then.
    """
    history = trial.episode.history
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


def of_last(trial: Trial, name: str) -> Iterator[str]:
    """What each node of a name did last, and why; the name is given up to its bracket or with it."""
    for node in dict.fromkeys(node.name for node in trial.nodes_named(name)):
        yield from tuple(of_node(trial, node)) or (f"{node} never ran",)


def at_time(trial: Trial, t: float, actions: Collection[str] = ()) -> Iterator[str]:
    """Why the robot did what it did at a time [s]; what an earlier attempt failed for was over by then.

    Args:
        trial: What happened.
        t: The time.
        actions: Of these alone; without any of all.
    """
    nodes = trial.episode.nodes
    for why in trial.episode.history.why_at(t):
        if actions and why.event.action not in actions:
            continue
        yield f"t={t:.2f} s  {why.event.node} {why.event.status} since t={why.event.t:.2f} s"
        tried = why.switched_by
        if tried is not None and tried.status == "failure" and nodes[tried.path].kind == "action":
            yield f"again     {tried.node} failed at t={tried.t:.2f} s"
        else:
            yield from chain(why.because)


def of_value(values: Inference, parameter: str, whose: str) -> Iterator[str]:
    """Somebody's value, or a profile's, what it is made of, and the rules that fired."""
    value = values[parameter]
    yield f"parameter {parameter} of {whose} {told(value.value, value.unit)} ({value.origin})"
    for line in because_of_value(value, values.inputs).splitlines():
        yield f"made of   {line}"


def of_parameter(trial: Trial, parameter: str, person: str, judged_s: float | None = None) -> Iterator[str]:
    """Somebody's value in an episode, what it is made of, and which held when where it was another once.

    Args:
        trial: What happened.
        parameter: Which of theirs.
        person: Whose.
        judged_s: When it counts [s]; None: when their visit was carried out.
    """
    at_s = trial.judged_s(person, parameter) if judged_s is None else judged_s
    yield from of_value(trial.episode.values_at(person, at_s), parameter, person)
    yield from of_time(trial, parameter, person, at_s)


def of_step(trial: Trial, action: str, person: str) -> Iterator[str]:
    """A step of the last plan in which somebody is visited, and why; of a new plan, also why it was made."""
    found = last_for(trial, person, action)
    if found is None:
        return
    for step in found.plan.steps:
        if step.action.startswith(action) and person in step.people:
            told = ", of a new plan" if found.because else ""
            yield f"step      {step.action}({', '.join(step.arguments)}){told}"
            yield f"because   {step.why.text}"
            yield from (f"not open  {', '.join(out.arguments)}: {out.reason}" for out in step.why.ruled_out)
    yield from chain(found.because)


def of_events(trial: Trial, node: str, events: Iterable[TraceEvent]) -> Iterator[str]:
    """What nodes of a name did, and why; where the tree has none, why not."""
    if any(trial.nodes_named(node)):
        for event in events:
            yield from of_event(event)
    else:
        yield absent(node)
        yield from of_absence(trial, node)


def absent(node: str) -> str:
    """That the tree has no node of a name."""
    return f"the tree has no {node}"


def of_absence(trial: Trial, node: str) -> Iterator[str]:
    """Why the tree has no node of a name: who is not visited, how the others are greeted, and the rules."""
    reached = {person for step in trial.prepared.plan.steps for person in step.people}
    about = node.rpartition("(")[2] if "(" in node else ""
    for person in trial.wanted:
        if about and person not in about.strip(" )").split(", "):
            continue
        if person not in reached:
            yield from of_visit(trial, person)
            continue
        yield from of_step(trial, "Greet", person)
        yield from told_of(trial, ((person, name) for name in ("greeting_modality", "greeting_gesture")))


def of_unserved(trial: Trial) -> Iterator[str]:
    """Why those were not greeted who were not: nodes of their visits never ran."""
    for person in trial.wanted:
        if trial.outcome_of(person) not in PROPER_OUTCOMES:
            yield from of_visit(trial, person)


def of_visit(trial: Trial, person: str) -> Iterator[str]:
    """Why somebody's visit went as it did."""
    visit = trial.visit(person)
    if visit is None:
        reason = trial.prepared.asked.unreachable.get(person)
        yield f"plan      {reason or 'no step of it serves ' + person}"
        return
    if visit.failure or visit.deviation_reason:
        yield f"visit     {visit.failure or visit.deviation_reason}"
    if visit.together_with:
        yield f"visit     {person} is greeted with {visit.together_with}, before whom the robot stands"
    yield from of_step(trial, "Reach_user", visit.together_with or person)
