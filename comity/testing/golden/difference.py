"""Differences between a golden episode and the same case now: the first, its cause, and the rest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from comity.testing.expectation import Finding
from comity.testing.golden.edit import Edit, bears_on, edits
from comity_executor import Cause, Divergence, TraceEvent, first_divergence

if TYPE_CHECKING:
    from comity.testing.golden.leaves import SourceFile
    from comity.testing.golden.record import Golden

MOST = 3
"""Maximum number of choices named when several share the same difference."""
_UNSEEN = "one that differs in digits or words which golden episodes do not keep"


def differing(
    before: Golden, now: Golden, sources: Mapping[str, SourceFile], kept: Mapping[str, str]
) -> Iterator[Finding]:
    """At most one finding: a difference in the stored values or, on the same platform, in the trace.

    Args:
        before: The golden episode.
        now: The same case now.
        sources: The files that the case reads now.
        kept: The stored profiles that it reads, by their names in golden episodes, with the keys that refer
            to them.
    """
    same_machine = before.fingerprint == now.fingerprint
    same_trace = same_machine and before.trace_sha256 == now.trace_sha256
    lines = [*_parameters(before, now), *_plan(before, now), *_others(before, now)]
    parting = list(_parting(before, now))
    if same_trace and before.nodes != now.nodes:
        parting.append("the tree has other nodes")
    found = edits(before, now, sources, kept)
    if lines:
        behind = _behind_the_first(before, now, found)
        others = [edit.text for edit in found if edit not in behind]
        because = [edit.text for edit in behind]
        yield Finding("the golden episode", lines[0], because, [*lines[1:], *parting, *others])
    elif parting or (same_machine and not same_trace):
        got, *links = parting or [_UNSEEN]
        yield Finding("the golden episode", got, [*links, *(edit.text for edit in found)])


def _behind_the_first(before: Golden, now: Golden, found: Sequence[Edit]) -> Sequence[Edit]:
    """Edits that may have caused the first difference; for a parameter, those that affect it."""
    first = next(_other_parameters(before, now), None)
    rules = (*before.rules, *now.rules)
    return [edit for edit in found if first and bears_on(edit, *first, rules)] or found


def _parameters(before: Golden, now: Golden) -> Iterator[str]:
    for person, name in _other_parameters(before, now):
        was, values = (each.parameters.get(person, {}) for each in (before, now))
        yield f"{name} of {person}: {was.get(name, '-')} -> {values.get(name, '-')}"


def _other_parameters(before: Golden, now: Golden) -> Iterator[tuple[str, str]]:
    """Pairs of person and parameter whose value changed."""
    for person in {**before.parameters, **now.parameters}:
        was, values = before.parameters.get(person, {}), now.parameters.get(person, {})
        for name in {**was, **values}:
            if was.get(name) != values.get(name):
                yield person, name


def _plan(before: Golden, now: Golden) -> Iterator[str]:
    steps = tuple("; ".join(step.text for step in each.plan) for each in (before, now))
    if steps[0] != steps[1]:
        yield f"plan: {steps[0]} -> {steps[1]}"
    else:
        for was, step in zip(before.plan, now.plan, strict=True):
            if was.cost_m != step.cost_m:
                yield f"cost of {step.text}: {was.cost_m:.2f} m -> {step.cost_m:.2f} m of way"
    for about, now_out in now.ruled_out.items():
        if about in before.ruled_out:
            yield from _choices(about, before.ruled_out[about], now_out)


def _choices(step: str, was: Mapping[str, str], now: Mapping[str, str]) -> Iterator[str]:
    """Choices for a step whose exclusion changed: excluded now, open now, or for another reason."""
    alike: dict[tuple[str | None, str | None], list[str]] = {}
    for choice in {**was, **now}:
        alike.setdefault((was.get(choice), now.get(choice)), []).append(choice)
    for (reason, other), choices in alike.items():
        if reason != other:
            yield f"{_listed(choices)} of {step}: {_openness(reason, other)}"


def _listed(choices: Sequence[str]) -> str:
    more = f" and {len(choices) - MOST} more" if len(choices) > MOST else ""
    return f"{'; '.join(choices[:MOST])}{more}"


def _openness(was: str | None, now: str | None) -> str:
    """How a choice's exclusion changed, in words; a choice no longer excluded may still not be chosen."""
    if now is None:
        return f"no longer excluded ({was})"
    return f"now excluded ({now})" if was is None else f"excluded, {was} -> {now}"


def _others(before: Golden, now: Golden) -> Iterator[str]:
    if before.outcome != now.outcome:
        yield f"outcome: {before.outcome} -> {now.outcome}"
    for person in {**before.visits, **now.visits}:
        was, came = (each.visits.get(person, "none").replace("_", " ") for each in (before, now))
        if was != came:
            yield f"visit of {person}: {was} -> {came}"
    if before.path_length_m != now.path_length_m:
        yield f"way that was driven: {before.path_length_m:.3f} m -> {now.path_length_m:.3f} m"


def _parting(before: Golden, now: Golden) -> Iterator[str]:
    """The first divergence of the traces, and the causal links that differ."""
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
        kind = (mine or theirs or Cause("reading", "", None)).kind
        if mine and theirs and mine.text == theirs.text:  # they differ only in digits that the text omits
            yield f"{kind:9} {mine.text}: {mine.value} -> {theirs.value}"
        else:
            yield f"{kind:9} {mine.text if mine else '-'} -> {theirs.text if theirs else '-'}"


def _event(event: TraceEvent | None) -> str:
    return f"t={event.t:.2f} s {event.node} {event.halt or event.status}" if event else "had ended"
