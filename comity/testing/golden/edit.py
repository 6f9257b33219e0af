"""Edits since a golden episode was written: the causes of its differences."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, zip_longest
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.testing.golden.leaves import BETWEEN
from comity.testing.trials.case import from_here

if TYPE_CHECKING:
    from comity.testing.golden.leaves import SourceFile
    from comity.testing.golden.record import Golden

MOST = 6
"""Maximum number of lines about one file: a rewritten file needs no list."""
RULES = "rules"
"""Source name of edits of rules."""
_SMALL = "moved"
"""Source name of parameters that moved by less than the stored precision."""
_SCENARIO, _MAP, _RULEBOOK = "scenario", "map", "rulebook"
_NO_PARAMETER = ("robot", "place", "passers_by", "goals", "limits")
"""Keys of a scenario that affect the robot but nobody's parameters."""
_WHERE_THEY_ARE = ("at_m", "facing_deg", "walks", "reacts", "comfort")
"""Keys of a person in the scenario that affect no parameter."""
_THEN = re.compile(r"\bthen\b([^;]*)")
_NAMED = re.compile(r"(\w+) is\b")
_IDLE = "in what nothing is computed with"
_STAYS_THERE = "which of its keys stays there, as golden episodes are shared"
_BY_HAND = "somebody edited the golden episode; write it anew with --update"
_OTHER_CODE = "neither what the case reads nor the golden episode was edited: Comity is another"
_ELSEWHERE = f"{_OTHER_CODE}, or the platform"
"""Wording if the golden episode was written by other code or on another platform."""


@dataclass(frozen=True, slots=True)
class Edit:
    """An edit, or a parameter that moved by less than the stored precision."""

    text: str
    """One line of text."""
    source: str = ""
    """The edited source, by its name in golden episodes; empty if unknown."""
    place: str = ""
    """Place in the source; for rules, their text before and now."""


def edits(
    before: Golden, now: Golden, sources: Mapping[str, SourceFile], kept: Mapping[str, str]
) -> tuple[Edit, ...]:
    """Every edit, and parameters that moved by less than the stored precision.

    Args:
        before: The golden episode.
        now: The same case now.
        sources: The files that the case reads now.
        kept: The stored profiles that it reads, by their names in golden episodes, with the keys that refer
            to them.
    """
    rulebook = sources["rulebook"].file if "rulebook" in sources else None
    found = [*_files(before, now, sources, kept), *_small(before, now), *_rules(before, now, rulebook)]
    if before.read == now.read:
        edited = before.sha256 != before.digest()
        found.append(
            Edit(_BY_HAND if edited else _OTHER_CODE if before.fingerprint == now.fingerprint else _ELSEWHERE)
        )
    return tuple(found)


def bears_on(edit: Edit, person: str, parameter: str, rules: Iterable[str]) -> bool:
    """Whether an edit may have changed a person's parameter; True if unknown.

    Args:
        edit: An edit from `edits`.
        person: The person.
        parameter: Name of their parameter.
        rules: All rules, before and now: some read the outputs of others.
    """
    if edit.source == RULES:
        return bool(_given(edit.place) & _upstream(parameter, rules)) or not _given(edit.place)
    if edit.source.startswith(_MAP):
        return False
    first, second, third = (*edit.place.split(BETWEEN, 2), "", "")[:3]
    if edit.source == _RULEBOOK:  # terms of a variable or parameter
        return first not in ("variables", "parameters") or second in _upstream(parameter, rules)
    if edit.source == _SMALL:
        return first == person and second in _upstream(parameter, rules)
    if edit.source == _SCENARIO:
        is_theirs = second == person and third.split(BETWEEN)[0] not in _WHERE_THEY_ARE
        return is_theirs if first == "people" else first not in _NO_PARAMETER
    return edit.source.rpartition(" ")[2] == person or " of " not in edit.source


def _upstream(parameter: str, rules: Iterable[str]) -> set[str]:
    """The parameter, and all inputs of the rules behind it, transitively."""
    found, every = {parameter}, [*rules]
    while True:
        read = {name for rule in every if _given(rule) & found for name in _NAMED.findall(rule)}
        if read <= found:
            return found
        found |= read


def _given(rule: str) -> set[str]:
    """The outputs of a rule."""
    return {name for part in _THEN.findall(rule) for name in _NAMED.findall(part)[:1]}


def _files(
    before: Golden, now: Golden, sources: Mapping[str, SourceFile], kept: Mapping[str, str]
) -> Iterator[Edit]:
    """Edits of files read both times; for a file read only once, the edit of the scenario tells."""
    for name in {**before.read, **now.read}:
        if before.read.get(name) == now.read.get(name):
            continue
        if name in before.written and name in sources:
            found = list(_in_file(before.written[name], sources[name]))
            yield from (Edit(f"edited    {name}: {line}", name, place) for place, line in found[:MOST])
            if len(found) > MOST:
                yield Edit(f"edited    {name}: and {len(found) - MOST} more")
            elif not found and (name != "rulebook" or before.rules == now.rules):
                yield Edit(f"edited    {name}, {_IDLE}", name)
        elif name not in before.written and name not in sources:
            more = f": {kept[name]}; {_STAYS_THERE}" if name in kept else ""
            yield Edit(f"edited    {name}{more}", name)


def _in_file(was: Mapping[str, Any], source: SourceFile) -> Iterator[tuple[str, str]]:
    """Changed places in the order of lines, each with a text."""
    now = source.leaves
    both = (place for place in now if place in was and was[place] != now[place])
    told = {place: _change(was[place], now[place]) for place in both}
    for word, mine, others in (("new", now, was), ("gone", was, now)):
        for outermost, inside in _only_in(mine, others).items():
            if len(inside) > 1:
                told[outermost] = f"is {word}"
            else:
                told[inside[0]] = _change(was.get(inside[0]), now.get(inside[0]))
    for place in sorted(told, key=lambda place: source.where(place).line or 0):
        where = source.where(place)
        here = replace(where, file=str(from_here(Path(where.file)) or where.file))
        yield place, f"{place.replace(BETWEEN, ' ')} {told[place]} ({here})"


def _only_in(mine: Iterable[str], others: Collection[str]) -> dict[str, list[str]]:
    """Places that the others lack, grouped by the outermost missing part."""
    known = {part for place in others for part in _around(place)}
    found: dict[str, list[str]] = {}
    for place in mine:
        if place not in others:
            outermost = next((part for part in _around(place) if part not in known), place)
            found.setdefault(outermost, []).append(place)
    return found


def _around(place: str) -> Iterable[str]:
    """The place and all its parents, outermost first."""
    return accumulate(place.split(BETWEEN), lambda outer, inner: f"{outer}{BETWEEN}{inner}")


def _change(was: Any, now: Any) -> str:
    return f"{_value(was)} -> {_value(now)}"


def _value(value: Any) -> str:
    if value is None:
        return "-"
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _small(before: Golden, now: Golden) -> Iterator[Edit]:
    """Parameters that moved by less than the stored precision."""
    for person, values in now.exact.items():
        for name, value in values.items():
            was = before.exact.get(person, {}).get(name, value)
            kept = before.parameters.get(person, {}).get(name)
            if was != value and kept == now.parameters[person][name]:
                told = f"moved     {name} of {person}: {was!r} -> {value!r}, less than is kept"
                yield Edit(told, _SMALL, f"{person}{BETWEEN}{name}")


def _rules(before: Golden, now: Golden, file: str | None) -> Iterator[Edit]:
    """Changed rules; a removed rule has no line in the file."""
    gone, new = _without(before.rules, now.rules), _without(now.rules, before.rules)
    here = f" ({from_here(Path(file)) or file})" if file else ""
    lines = [
        Edit(f"edited    {was or '-'} -> {rule or f'-{here}'}", RULES, f"{was}; {rule}")
        for was, rule in zip_longest(gone, new)
    ]
    if before.rules != now.rules and not lines:
        lines.append(Edit("edited    the order of the rules, or one that stands there twice"))
    yield from lines[:MOST]
    if len(lines) > MOST:
        yield Edit(f"edited    {len(lines) - MOST} more rules")


def _without(rules: Sequence[str], others: Sequence[str]) -> list[str]:
    """Rules that the others lack, with their numbers."""
    return [f"rule {number}: {rule}" for number, rule in enumerate(rules, 1) if rule not in others]
