"""What differs between a golden episode and the same case now, and what is behind it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, zip_longest
from typing import TYPE_CHECKING

from comity.testing.expectation import Finding
from comity_executor import Cause, Divergence, TraceEvent, first_divergence

if TYPE_CHECKING:
    from comity.testing.golden import Golden

MOST = 6
"""Lines about a rulebook: who writes it anew needs no list."""
_UNSEEN = "one that differs in digits or words which golden episodes do not keep"
_BY_HAND = "the trace is the same: somebody edited the golden episode; write it anew with --update"
_OTHER_CODE = "neither what the case reads nor the golden episode was edited: Comity is another"


def differing(before: Golden, now: Golden) -> Iterator[Finding]:
    """At most one finding: what is kept and differs; or, on the same platform, that the trace does."""
    same_machine = before.fingerprint == now.fingerprint
    same_trace = same_machine and before.trace_sha256 == now.trace_sha256
    other_trace = same_machine and not same_trace
    lines = [*_parameters(before, now), *_others(before, now), *_parting(before, now)]
    if same_trace and before.nodes != now.nodes:
        lines.append("the tree has other nodes")
    if lines or other_trace:
        lines = [*lines, *_read(before, now)] or [_UNSEEN]
    if lines:
        behind = [*_small(before, now), *_rules(before, now)]
        if same_trace and _as_read(before) == _as_read(now):
            behind.append(_OTHER_CODE if before.sha256 == before.digest() else _BY_HAND)
        yield Finding("the golden episode", lines[0], (*lines[1:], *behind))


def _as_read(golden: Golden) -> tuple[object, ...]:
    """All that a case reads."""
    return golden.read, golden.rules, golden.figures


def _parameters(before: Golden, now: Golden) -> Iterator[str]:
    for person in {**before.parameters, **now.parameters}:
        was, values = before.parameters.get(person, {}), now.parameters.get(person, {})
        for name in {**was, **values}:
            if was.get(name) != values.get(name):
                yield f"{name} of {person}: {was.get(name, '-')} -> {values.get(name, '-')}"


def _others(before: Golden, now: Golden) -> Iterator[str]:
    steps = tuple("; ".join(step.text for step in each.plan) for each in (before, now))
    if steps[0] != steps[1]:
        yield f"plan: {steps[0]} -> {steps[1]}"
    else:
        for was, step in zip(before.plan, now.plan, strict=True):
            if was.cost_m != step.cost_m:
                yield f"cost of {step.text}: {was.cost_m:.2f} m -> {step.cost_m:.2f} m of way"
    if (before.outcome, before.visits) != (now.outcome, now.visits):
        yield f"outcome: {before.outcome} {dict(before.visits)} -> {now.outcome} {dict(now.visits)}"
    if before.path_length_m != now.path_length_m:
        yield f"way that was driven: {before.path_length_m:.3f} m -> {now.path_length_m:.3f} m"


def _read(before: Golden, now: Golden) -> Iterator[str]:
    """What was edited, among what the case reads."""
    for name in {**before.read, **now.read}:
        if before.read.get(name) != now.read.get(name):
            yield f"edited    {name}"


def _small(before: Golden, now: Golden) -> Iterator[str]:
    """Parameters that moved by less than is kept."""
    for person, values in now.exact.items():
        for name, value in values.items():
            was = before.exact.get(person, {}).get(name, value)
            kept = before.parameters.get(person, {}).get(name)
            if was != value and kept == now.parameters[person][name]:
                yield f"moved     {name} of {person}: {was!r} -> {value!r}, less than is kept"


def _rules(before: Golden, now: Golden) -> Iterator[str]:
    """Which rules are others, and which figures of the rulebook, by their place in it."""
    gone, new = _without(before.rules, now.rules), _without(now.rules, before.rules)
    rules = (f"edited    {was or '-'} -> {rule or '-'}" for was, rule in zip_longest(gone, new))
    figures = (
        f"edited    {place}: {before.figures.get(place, '-')} -> {now.figures.get(place, '-')}"
        for place in {**before.figures, **now.figures}
        if before.figures.get(place) != now.figures.get(place)
    )
    lines = [*chain(rules, figures)]
    if before.rules != now.rules and not (gone or new):
        lines.append("edited    the order of the rules, or one that stands there twice")
    yield from lines[:MOST]
    if len(lines) > MOST:
        yield f"edited    {len(lines) - MOST} more places of the rulebook"


def _without(rules: tuple[str, ...], others: tuple[str, ...]) -> list[str]:
    """Those that the others do not have, with their numbers."""
    return [f"rule {number}: {rule}" for number, rule in enumerate(rules, 1) if rule not in others]


def _parting(before: Golden, now: Golden) -> Iterator[str]:
    """The first divergence, and the links in which its causes differ."""
    parting = first_divergence(before.history, now.history, in_behaviour=True)
    parting = parting or first_divergence(before.history, now.history)
    if parting:
        yield from _told(parting)


def _told(parting: Divergence) -> Iterator[str]:
    what = "they do different things" if parting.in_behaviour else "the reasons differ"
    yield f"{what} from t={parting.t:.2f} s on"
    yield f"golden    {_event(parting.one)}"
    yield f"now       {_event(parting.other)}"
    for mine, theirs in parting.causes:
        kind = (mine or theirs or Cause("reading", "")).kind
        if mine and theirs and mine.text == theirs.text:  # they differ in digits that the words leave out
            yield f"{kind:9} {mine.text}: {mine.value} -> {theirs.value}"
        else:
            yield f"{kind:9} {mine.text if mine else '-'} -> {theirs.text if theirs else '-'}"


def _event(event: TraceEvent | None) -> str:
    return f"t={event.t:.2f} s {event.node} {event.halt or event.status}" if event else "had ended"
