"""What was edited since a golden episode was written: the cause of whatever differs."""

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
"""Lines about a file: who writes it again needs no list."""
RULES = "rules"
"""What the edit of a rule is of."""
_SMALL = "moved"
"""What a parameter is of that moved by less than is kept."""
_SCENARIO, _MAP, _RULEBOOK = "scenario", "map", "rulebook"
_NO_PARAMETER = ("robot", "place", "passers_by", "goals", "limits")
"""What a scenario says there changes what the robot does, and nobody's parameters."""
_WHERE_THEY_ARE = ("at_m", "facing_deg", "walks", "reacts", "comfort")
"""What the scenario has of a person and no parameter comes from."""
_THEN = re.compile(r"\bthen\b([^;]*)")
_NAMED = re.compile(r"(\w+) is\b")
_IDLE = "in what nothing is computed with"
_STAYS_THERE = "which of its keys stays there, as golden episodes are shared"
_BY_HAND = "somebody edited the golden episode; write it anew with --update"
_OTHER_CODE = "neither what the case reads nor the golden episode was edited: Comity is another"
_ELSEWHERE = f"{_OTHER_CODE}, or the platform"
"""Where the golden episode was not written."""


@dataclass(frozen=True, slots=True)
class Edit:
    """Something that was edited, or that moved by less than is kept."""

    text: str
    """A line."""
    source: str = ""
    """What was edited, as golden episodes call it; empty where that is not known."""
    place: str = ""
    """Where in it; of rules, how they read before and now."""


def edits(
    before: Golden, now: Golden, sources: Mapping[str, SourceFile], kept: Mapping[str, str]
) -> tuple[Edit, ...]:
    """Every edit, and what moved by less than is kept.

    Args:
        before: The golden episode.
        now: The same case now.
        sources: The files that it reads now.
        kept: What it reads from the store, by what golden episodes call it, and what names it.
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
    """Whether a person's parameter may be another one for an edit; where that is not known, it may.

    Args:
        edit: One of those above.
        person: Whose parameter.
        parameter: Which.
        rules: All, before and now: some read what others give.
    """
    if edit.source == RULES:
        return bool(_given(edit.place) & _upstream(parameter, rules)) or not _given(edit.place)
    if edit.source.startswith(_MAP):
        return False
    first, second, third = (*edit.place.split(BETWEEN, 2), "", "")[:3]
    if edit.source == _RULEBOOK:  # a variable's terms, or a parameter's
        return first not in ("variables", "parameters") or second in _upstream(parameter, rules)
    if edit.source == _SMALL:
        return first == person and second in _upstream(parameter, rules)
    if edit.source == _SCENARIO:
        is_theirs = second == person and third.split(BETWEEN)[0] not in _WHERE_THEY_ARE
        return is_theirs if first == "people" else first not in _NO_PARAMETER
    return edit.source.rpartition(" ")[2] == person or " of " not in edit.source


def _upstream(parameter: str, rules: Iterable[str]) -> set[str]:
    """The parameter, and what the rules behind it read, and those behind that."""
    found, every = {parameter}, [*rules]
    while True:
        read = {name for rule in every if _given(rule) & found for name in _NAMED.findall(rule)}
        if read <= found:
            return found
        found |= read


def _given(rule: str) -> set[str]:
    """What a rule, or each of several, gives."""
    return {name for part in _THEN.findall(rule) for name in _NAMED.findall(part)[:1]}


def _files(
    before: Golden, now: Golden, sources: Mapping[str, SourceFile], kept: Mapping[str, str]
) -> Iterator[Edit]:
    """A file that only one of both reads is named by the scenario, whose edit says so."""
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
    """The places that are other ones, in the order of lines, each with what is said of it."""
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
    """The places that the others lack, each below the outermost part of it that they lack."""
    known = {part for place in others for part in _around(place)}
    found: dict[str, list[str]] = {}
    for place in mine:
        if place not in others:
            outermost = next((part for part in _around(place) if part not in known), place)
            found.setdefault(outermost, []).append(place)
    return found


def _around(place: str) -> Iterable[str]:
    """The place and all that it is in, from the outside in."""
    return accumulate(place.split(BETWEEN), lambda outer, inner: f"{outer}{BETWEEN}{inner}")


def _change(was: Any, now: Any) -> str:
    return f"{_value(was)} -> {_value(now)}"


def _value(value: Any) -> str:
    if value is None:
        return "-"
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _small(before: Golden, now: Golden) -> Iterator[Edit]:
    """Parameters that moved by less than is kept."""
    for person, values in now.exact.items():
        for name, value in values.items():
            was = before.exact.get(person, {}).get(name, value)
            kept = before.parameters.get(person, {}).get(name)
            if was != value and kept == now.parameters[person][name]:
                told = f"moved     {name} of {person}: {was!r} -> {value!r}, less than is kept"
                yield Edit(told, _SMALL, f"{person}{BETWEEN}{name}")


def _rules(before: Golden, now: Golden, file: str | None) -> Iterator[Edit]:
    """Which rules are others; of one that is gone, the file has no line."""
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
    """Those that the others do not have, with their numbers."""
    return [f"rule {number}: {rule}" for number, rule in enumerate(rules, 1) if rule not in others]
