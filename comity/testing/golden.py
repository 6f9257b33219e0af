"""Golden episodes: what came of a case when somebody last looked at it, kept beside the scenario.

A file for each case holds the parameters, the plan, the outcome and the events, quantised, and the digest of
the trace, which counts only where the platform's fingerprint is the same.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.episode import fingerprint
from comity.testing.expectation import Finding
from comity_executor import Cause, Divergence, History, Node, TraceEvent, first_divergence
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.testing.case import Case
    from comity.testing.trial import Trial

FORMAT = "comity-golden-1"
_TIME, _NUMBER = 2, 3
"""Decimals that are kept: a tick is 0.05 s, and a millimetre is seen by nobody."""


@dataclass(frozen=True, slots=True)
class Golden:
    """One case as it was."""

    fingerprint: str
    trace_sha256: str
    outcome: str
    visits: Mapping[str, str]
    parameters: Mapping[str, Mapping[str, float | str]]
    plan: tuple[str, ...]
    history: History


def place_of(case: Case) -> Path:
    """`hall.golden/german_man-seed0.json`, beside `hall.scenario.yaml`."""
    stem = case.path.name.removesuffix(".scenario.yaml")
    return case.path.with_name(f"{stem}.golden") / f"{case.slug.removeprefix(f'{stem}-')}.json"


def golden_of(trial: Trial) -> Golden:
    """A trial, quantised."""
    episode, prepared = trial.episode, trial.prepared
    return Golden(
        fingerprint=fingerprint(),
        trace_sha256=episode.trace_sha256,
        outcome=episode.outcome,
        visits={visit.person: visit.outcome for visit in episode.visits},
        parameters={
            person: {name: _rounded(value.value) for name, value in values.parameters.items()}
            for person, values in prepared.values.items()
        },
        plan=tuple(f"{step.action}({', '.join(step.arguments)})" for step in prepared.plan.steps),
        history=History(episode.nodes, map(_quantised, episode.events)),
    )


def store(trial: Trial) -> Path:
    """Write a case down, whole or not at all."""
    golden, path = golden_of(trial), place_of(trial.case)
    record = {
        "format": FORMAT,
        **{name: getattr(golden, name) for name in Golden.__slots__ if name != "history"},
        "nodes": [asdict(node) for node in golden.history.nodes],
        "events": [asdict(event) for event in golden.history.events],
    }
    path.parent.mkdir(exist_ok=True)
    part = path.with_suffix(".part")
    part.write_text(_lines(record), encoding="utf-8")
    part.replace(path)
    return path


def differences(trial: Trial) -> Iterator[Finding]:
    """What differs from the golden episode; nothing where there is none.

    Raises:
        InputError: if the file is damaged.
    """
    path = place_of(trial.case)
    if path.is_file():
        before, now = _read(path), golden_of(trial)
        same_machine = before.fingerprint == now.fingerprint
        if not (same_machine and before.trace_sha256 == now.trace_sha256):
            yield from _differing(before, now, same_machine=same_machine)


def _differing(before: Golden, now: Golden, *, same_machine: bool) -> Iterator[Finding]:
    lines = [*_parameters(before, now), *_others(before, now)]
    parting = first_divergence(before.history, now.history, in_behaviour=True)
    parting = parting or first_divergence(before.history, now.history)
    if parting:
        lines += _parting(parting)
    if lines:
        yield Finding("the golden episode", lines[0], tuple(lines[1:]))
    elif same_machine:
        yield Finding(
            "the golden episode", "one that differs in digits or words which golden episodes do not keep"
        )


def _parameters(before: Golden, now: Golden) -> Iterator[str]:
    for person, values in now.parameters.items():
        for name, value in values.items():
            was = before.parameters.get(person, {}).get(name)
            if was != value:
                yield f"{name} of {person}: {was} -> {value}"


def _others(before: Golden, now: Golden) -> Iterator[str]:
    if before.plan != now.plan:
        yield f"plan: {'; '.join(before.plan)} -> {'; '.join(now.plan)}"
    if (before.outcome, before.visits) != (now.outcome, now.visits):
        yield f"outcome: {before.outcome} {dict(before.visits)} -> {now.outcome} {dict(now.visits)}"


def _parting(parting: Divergence) -> Iterator[str]:
    """The first divergence, and the links in which its causes differ."""
    what = "they do different things" if parting.in_behaviour else "the reasons differ"
    yield f"{what} from t={parting.t:.2f} s on"
    yield f"golden    {_told(parting.one)}"
    yield f"now       {_told(parting.other)}"
    for mine, theirs in parting.causes:
        kind = (mine or theirs or Cause("reading", "")).kind
        yield f"{kind:9} {mine.text if mine else '-'} -> {theirs.text if theirs else '-'}"


def _told(event: TraceEvent | None) -> str:
    return f"t={event.t:.2f} s {event.node} {event.halt or event.status}" if event else "had ended"


def _rounded(value: float | str) -> float | str:
    return value if isinstance(value, str) else round(value, _NUMBER) + 0.0


def _quantised(event: TraceEvent) -> TraceEvent:
    because = tuple(
        replace(cause, value=cause.value if cause.value is None else _rounded(cause.value))
        for cause in event.because
    )
    return replace(event, t=round(event.t, _TIME), because=because)


def _lines(record: Mapping[str, Any]) -> str:
    """JSON with a line for every node and event, so that a version control shows what changed."""
    parts = []
    for key, value in record.items():
        if key in ("nodes", "events"):
            inner = ",\n  ".join(json.dumps(item, ensure_ascii=False, sort_keys=True) for item in value)
            parts.append(f'"{key}": [\n  {inner}\n ]')
        else:
            parts.append(f'"{key}": {json.dumps(value, ensure_ascii=False)}')
    return "{" + ",\n ".join(parts) + "}\n"


def _read(path: Path) -> Golden:
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record.pop("format") != FORMAT:
            raise ValueError("another format")
        nodes = [Node(**node) for node in record.pop("nodes")]
        events = [_event(event) for event in record.pop("events")]
        return Golden(history=History(nodes, events), **{**record, "plan": tuple(record["plan"])})
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            expected="a golden episode",
            got=f"{type(error).__name__}: {error}",
            remedy="Remove the file, or write it anew with `comity test --update`.",
            where=Where(str(path)),
        ) from None


def _event(record: dict[str, Any]) -> TraceEvent:
    because = tuple(Cause(**cause) for cause in record.pop("because"))
    return TraceEvent(because=because, **record)
