"""Refusal of a `Timing` that does not fit its problem: unknown names, impossible times, missing durations."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from itertools import chain

from comity_domain.classical.initial_state import COMPANY, ENTRANCE, LOCATION, TASK, USER
from comity_domain.classical.timing import Timing
from comity_domain.problem.spot import Way
from comity_fis.errors import InputError, Where, closest, shown


def require_timing(timing: Timing, types: Mapping[str, str], ways: Iterable[tuple[str, str]]) -> None:
    """Check a timing against the problem that it belongs to.

    Args:
        timing: The timing.
        types: The type of each object of the problem, by name.
        ways: Start and end, by name, of every way that a plan may take.

    Raises:
        InputError: Naming the first entry that does not fit.
    """
    if not isinstance(timing, Timing):
        _refuse("a Timing, or none", shown(timing), "Take `timing_of(request)`.")
    users, tasks = _of(types, USER), _of(types, TASK)
    places: Collection[str | None] = {None, *users, *_of(types, LOCATION)}
    _require_known("by_s", timing.by_s, users, "a user")
    _require_known("announced", timing.announced, users, "a user")
    _require_known("details", timing.details, tasks, "a task")
    _require_known(
        "ties", (words[0] for words in timing.ties), users | _of(types, COMPANY), "a user or group"
    )
    _require_known("durations_s", chain.from_iterable(timing.durations_s), places, "a place")
    for user, by_s in timing.by_s.items():
        _require_time(f"by_s of {user}", by_s, above_zero=True)
    for way, duration_s in timing.durations_s.items():
        _require_time(f"durations_s of {way}", duration_s, above_zero=False)
    if timing.by_s:
        needed = ((None if start == ENTRANCE.name else start, end) for start, end in ways)
        _require_durations(timing, needed)


def _of(types: Mapping[str, str], kind: str) -> set[str]:
    return {name for name, type_ in types.items() if type_ == kind}


def _require_known(entry: str, names: Iterable[str | None], known: Collection[str | None], what: str) -> None:
    for name in names:
        if name not in known:
            texts = sorted(each for each in known if each is not None)
            _refuse(f"{what} of the problem in {entry}", shown(name), closest(str(name), texts))


def _require_time(entry: str, seconds: float, *, above_zero: bool) -> None:
    is_time = isinstance(seconds, int | float) and math.isfinite(seconds)
    if not is_time or seconds < 0.0 or (above_zero and seconds == 0.0):
        bound = "> 0" if above_zero else ">= 0"
        _refuse(f"{entry} in seconds, {bound}", shown(seconds), "Take `timing_of(request)`.")


def _require_durations(timing: Timing, needed: Iterable[Way]) -> None:
    for way in needed:
        if way not in timing.durations_s:
            _refuse(f"durations_s of {way}, as there is a deadline", "none", "State it, in seconds.")


def _refuse(expected: str, got: str, remedy: str) -> None:
    raise InputError(expected=expected, got=got, remedy=remedy, where=Where("comity"))
