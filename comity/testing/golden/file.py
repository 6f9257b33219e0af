"""Golden episodes: a case's reviewed result, stored next to the scenario.

Each case has a file with the quantised parameters, plan, outcome and events. The digest of the trace counts
only on a platform with the same fingerprint. The content of the case's input files (without prose), its rules
and the exact parameters help to find the cause of a difference. A digest of the whole file shows whether it
was edited by hand.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from comity.episode import fingerprint
from comity.output.digest import digest_of
from comity.system import own_files
from comity.system.scenario_sets import names_by_path
from comity.testing.golden.content import (
    content_of,
    is_written_out,
    kept_of,
    learnt_with,
    profile_of,
    rules_of,
    sources_of,
)
from comity.testing.golden.difference import differing
from comity.testing.golden.place import place_of
from comity.testing.golden.record import Golden, StoredEvent, StoredStep
from comity_executor import TraceEvent
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.expectation import Finding
    from comity.testing.golden.leaves import SourceFile
    from comity.testing.trials.case import Case
    from comity_domain import Plan

_TIME, _NUMBER = 2, 3
"""Stored decimals: a tick is 0.05 s, and a millimetre is invisible."""
_LEVELS = {"read": 1, "written": 2, "rules": 1, "plan": 1, "ruled_out": 1, "nodes": 1, "events": 1}
"""Nesting depth down to which each part of the file gets lines of its own, for readable diffs."""
_CHOICES = 2
"""Number of arguments of a step before its choices: the robot and the person."""
_FILES = ("scenario", "map")
"""Inputs of a case that are one file each; the rulebook also counts by its rules."""


def golden_of(case: Case, episode: Episode, sources: Mapping[str, SourceFile]) -> Golden:
    """The golden episode of a case, quantised."""
    prepared = episode.prepared
    return Golden(
        fingerprint=fingerprint(),
        trace_sha256=episode.trace_sha256,
        read=dict(_read_by(case)),
        written={name: source.leaves for name, source in sources.items()},
        outcome=episode.outcome,
        visits={visit.person: visit.outcome for visit in episode.visits},
        parameters={
            person: {name: _rounded(value.value) for name, value in values.parameters.items()}
            for person, values in prepared.values.items()
        },
        rules=rules_of(case),
        exact={
            person: {
                name: value.value
                for name, value in values.parameters.items()
                if not isinstance(value.value, str)
            }
            for person, values in prepared.values.items()
        },
        plan=tuple(
            StoredStep(text=f"{step.action}({', '.join(step.arguments)})", cost_m=step.cost / 100.0)
            for step in prepared.plan.steps
        ),
        ruled_out=_ruled_out(prepared.plan),
        path_length_m=round(episode.metrics.path_length_m, _NUMBER),
        nodes=tuple(episode.nodes),
        events=tuple(map(_quantised, episode.events)),
    )


def _read_by(case: Case) -> Iterator[tuple[str, str]]:
    """Digest of each input of a case."""
    for name, content in content_of(case):
        if name == "profiles":
            for person in content:
                if not is_written_out(case, person):
                    yield profile_of(person), digest_of(content[person])
        elif name == "learnt":
            for person, part in content.items():
                yield learnt_with(person), digest_of(part)
        elif name == "rulebook":
            yield name, digest_of(case.rulebook_file.data)
        elif name.split()[0] in _FILES and content is not None:
            yield name, digest_of(content)


def _ruled_out(plan: Plan) -> dict[str, dict[str, str]]:
    """Excluded choices by step, without the chosen one; includes steps without any exclusion."""
    found: dict[str, dict[str, str]] = {}
    for step in plan.steps:
        out = found.setdefault(f"{step.action}({', '.join(step.arguments[:_CHOICES])})", {})
        out.update({", ".join(way.arguments[_CHOICES:]): way.reason for way in step.why.ruled_out})
    return found


def store(case: Case, episode: Episode) -> Path:
    """Write a golden episode, atomically.

    Raises:
        InputError: if the scenario ships with Comity, or the system refuses.
    """
    refuse_shipped(case.path)
    golden, path = golden_of(case, episode, dict(sources_of(case))), place_of(case)
    record = {
        **golden.model_dump(exclude={"nodes", "events", "sha256"}),
        "nodes": [asdict(node) for node in golden.nodes],
        "events": [asdict(event) for event in golden.events],
        "sha256": golden.digest(),
    }
    own_files.make_folder(path.parent)
    own_files.write_whole(path, _lines(record).encode())
    return path


def refuse_shipped(path: Path) -> None:
    """Refuse to write into the installation.

    Raises:
        InputError: if the scenario ships with Comity.
    """
    if path in names_by_path():
        raise InputError(
            expected="a scenario of your own, beside which its golden episode is kept",
            got=f"{names_by_path()[path]}, which ships with Comity",
            remedy="Copy the scenario to a folder of yours and name the copy.",
            where=Where("--update"),
        )


def differences(case: Case, episode: Episode) -> Iterator[Finding]:
    """Differences from the golden episode; none without one.

    Raises:
        InputError: if the file is damaged, or may not be read.
    """
    path = place_of(case)
    if _is_there(path):
        sources = dict(sources_of(case))
        kept = dict(kept_of(case))
        yield from differing(_read(path), golden_of(case, episode, sources), sources, kept)


def _is_there(path: Path) -> bool:
    try:
        path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError as error:
        raise InputError(
            expected="a folder of golden episodes that may be looked into",
            got=_reason(error),
            remedy="Let yourself read it, or move it away.",
            where=Where(str(path.parent)),
        ) from None
    return True


def _rounded(value: float | str) -> float | str:
    return value if isinstance(value, str) else round(value, _NUMBER) + 0.0


def _quantised(event: TraceEvent) -> StoredEvent:
    because = tuple(
        replace(cause, value=cause.value if cause.value is None else _rounded(cause.value))
        for cause in event.because
    )
    t = round(event.t, _TIME)
    return StoredEvent(t, event.node, event.path, event.status, event.halt, because)


def _lines(record: Mapping[str, Any]) -> str:
    """JSON with a line for every node, event, rule and value."""
    parts = (f"{json.dumps(key)}: {_lined(value, _LEVELS.get(key, 0))}" for key, value in record.items())
    return "{" + ",\n ".join(parts) + "}\n"


def _lined(value: Any, levels: int, indent: int = 2) -> str:
    """JSON with a line for each part, down to a nesting level."""
    if not (levels and value):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        heads = [f"{json.dumps(key, ensure_ascii=False)}: " for key in value]
        inner, brackets = [*value.values()], "{}"
    else:
        heads, inner, brackets = [""] * len(value), value, "[]"
    parts = [head + _lined(part, levels - 1, indent + 1) for head, part in zip(heads, inner, strict=True)]
    start = "\n" + " " * indent
    return f"{brackets[0]}{start}{f',{start}'.join(parts)}\n{' ' * (indent - 1)}{brackets[1]}"


def _read(path: Path) -> Golden:
    """Read a golden episode; refuse incomplete files."""
    try:
        return Golden.model_validate_json(own_files.read_regular(path))
    except (OSError, ValidationError) as error:
        raise InputError(
            expected="a golden episode",
            got=_reason(error),
            remedy="Remove it, or write it anew with `comity test --update`.",
            where=Where(str(path)),
        ) from None


def _reason(error: OSError | ValidationError) -> str:
    if isinstance(error, OSError):
        return error.strerror or str(error)
    first = error.errors(include_url=False)[0]
    place = ".".join(map(str, first["loc"]))
    return f"{place}: {first['msg']}" if place else str(first["msg"])
