"""Causes of the tree's behaviour, and divergences of two runs, in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from comity.answers.trace import DifferenceAnswer, EventAnswer, ReadingAnswer, ReasonAnswer
from comity.report.episodes.reading_now import reading_for, reading_text
from comity.report.text import table, unbroken
from comity_executor import first_divergence

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.report.episodes.undisclosed import Undisclosed
    from comity_executor import Cause, Divergence, History, NodeExplanation, TraceEvent

OF_PLANS = {
    "rebound": "bound to new numbers",
    "replanned": "replanned",
    "not_replanned": "not replanned",
}
"""Plan updates, as verbs after `was`."""
_STATES = {"running": "is running", "success": "succeeded", "failure": "failed"}


def reason_answer(why: NodeExplanation, readings: Mapping[str, ReadingAnswer]) -> ReasonAnswer:
    """A cause as in `comity trace --json`, with the readings at the requested time."""
    return ReasonAnswer(
        event=event_answer(why.event),
        switched_by=event_answer(why.switched_by) if why.switched_by else None,
        standing_on=tuple(map(event_answer, why.standing_on)),
        because=why.because,
        now=reading_for(why, readings),
    )


def difference_answer(divergence: Divergence) -> DifferenceAnswer:
    """A divergence of two runs as in `comity trace --diff --json`."""
    return DifferenceAnswer(
        t=divergence.t,
        in_behaviour=divergence.in_behaviour,
        one=event_answer(divergence.one) if divergence.one else None,
        other=event_answer(divergence.other) if divergence.other else None,
        causes=divergence.causes,
    )


def why_text(
    reasons: Iterable[NodeExplanation], readings: Mapping[str, ReadingAnswer], undisclosed: Undisclosed
) -> Iterator[str]:
    """For every node, its state and the results that it depends on; each result down to the facts, once.

    Args:
        reasons: One for each node.
        readings: The robot's readings of people at the requested time.
        undisclosed: Undisclosed facts that outvoted disclosed ones.
    """
    told: set[tuple[float, int]] = set()
    for why in reasons:
        event = why.event
        since = "since" if event.status == "running" else "at"
        yield f"{event.node} {_state(event)} {since} t={event.t:.2f} s"
        if event.status == "running" and (now := reading_for(why, readings)) and now.t > event.t:
            yield f"  now {reading_text(now)}"
        if event.because:
            yield f"  because {links(event.because)}"
            yield from _chain(event, undisclosed)
        for word, result in _grounds(why):
            reading = f": {links(result.because)}" if result.because else ""
            yield f"  {word} {result.node} {_state(result)} at t={result.t:.2f} s{reading}"
            if (result.t, result.path) not in told:
                yield from _chain(result, undisclosed)
            told.add((result.t, result.path))


def differences(one: History, other: History) -> tuple[Divergence, ...]:
    """The first divergences of two runs: in parameter values, then in actions and their times."""
    first = first_divergence(one, other)
    if first is None or first.in_behaviour:
        return (first,) if first else ()
    acted = first_divergence(one, other, in_behaviour=True)
    return (first, acted) if acted else (first,)


def differences_text(found: Iterable[Divergence], names: tuple[str, str]) -> Iterator[RenderableType]:
    """Time of divergence, the action of each run, and the causal links that differ."""
    found = tuple(found)
    if not found:
        yield "The two runs did the same at the same times, for the same reasons."
    for divergence in found:
        what = "They do different things" if divergence.in_behaviour else "The reasons differ"
        yield f"{what} from t={divergence.t:.2f} s on"
        for name, event in zip(names, (divergence.one, divergence.other), strict=True):
            did = f"t={event.t:.2f} s  {event.node} {_state(event)}" if event else "had ended"
            yield unbroken(f"  {name}  {did}")
        if divergence.causes:
            rows = [_side_by_side(*pair) for pair in divergence.causes]
            yield "  because of"
            yield table(rows, head=("", *names))
    if found and not found[-1].in_behaviour:
        yield "They did the same things at the same times."


def _side_by_side(mine: Cause | None, theirs: Cause | None) -> tuple[str, str, str]:
    kind = next(cause.kind for cause in (mine, theirs) if cause)
    return (kind, mine.text if mine else "", theirs.text if theirs else "")


def _grounds(why: NodeExplanation) -> Iterator[tuple[str, TraceEvent]]:
    if why.switched_by:
        yield "because", why.switched_by
    for result in why.standing_on:
        yield "and", result


def _state(event: TraceEvent) -> str:
    if event.halt:
        return f"was halted ({event.halt.replace('_', ' ')})"
    if event.status in OF_PLANS:
        return f"was {OF_PLANS[event.status]}"
    if event.of.kind == "condition" and event.status != "running":
        return "came out true" if event.status == "success" else "came out false"
    return _STATES[event.status]


def links(because: Sequence[Cause]) -> str:
    """The condition, the reading that changed it, and the fault behind it."""
    near = [cause.text for cause in because if cause.kind in ("reading", "condition")]
    return (", as ".join(reversed(near)) if len(near) < 3 else "; ".join(near)) + fault_text(because)


def fault_text(because: Iterable[Cause]) -> str:
    """The fault behind a causal chain, in brackets; empty without one."""
    return "".join(f" ({cause.text})" for cause in because if cause.kind == "fault")


def _chain(event: TraceEvent, undisclosed: Undisclosed) -> Iterator[str]:
    """Links beyond the reading, down to the variables."""
    for cause in event.because:
        if cause.kind not in ("fault", "reading", "condition"):
            outvoted = undisclosed.said(event, cause)
            yield f"      {cause.kind:9} {cause.words}{f'; {outvoted}' if outvoted else ''}"


def event_answer(event: TraceEvent) -> EventAnswer:
    """An event as in `comity trace --json`."""
    return EventAnswer(
        t=event.t,
        node=event.node,
        path=event.path,
        status=event.status,
        halt=event.halt,
        because=event.because,
    )
