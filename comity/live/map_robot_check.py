"""Checks that a user's robot implements the map robot protocol, before planning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from math import isfinite
from numbers import Real

from comity_executor import Localisation, MapGoal, PersonTrack
from comity_executor.robots.check import CALLS, call_problem, capability_problems, form_problems

MAP_CALLS: Mapping[str, tuple[tuple[object, ...], Mapping[str, object]]] = {
    "localisation": ((), {}),
    "tracks": ((), {}),
    "go": ((MapGoal("dock", "anna", 1.0, 2.0, 0.0, 0.4),), {}),
    **{name: CALLS[name] for name in CALLS if name not in ("read", "heard", "choose_pose", "go")},
}
"""Required calls with their arguments."""


def problems_of(robot: object) -> list[str]:
    """Missing or malformed calls. Nothing is commanded; a call that raises now may work later."""
    found = [problem for name, call in MAP_CALLS.items() if (problem := call_problem(robot, name, *call))]
    if not found:
        found = [problem for problem in form_problems(robot) if problem] + _senses_problems(robot)
    return found + capability_problems(robot)


def _senses_problems(robot: object) -> list[str]:
    try:
        here, tracks = robot.localisation(), robot.tracks()  # type: ignore[attr-defined]  # looked at before
    except Exception:
        return []
    found = [] if here is None else _number_problems("localisation", here, Localisation, "None or ")
    for track in tracks or ():
        found += _number_problems("tracks", track, PersonTrack, "a sequence of ")
    return found


def _number_problems(call: str, said: object, form: type[Localisation | PersonTrack], also: str) -> list[str]:
    numbers = [field.name for field in fields(form) if field.name.endswith(("_m", "_m_s", "_rad", "_s"))]
    optional = ("heading_rad", "velocity_m_s", "identified_s") if form is PersonTrack else ()
    wrong = [
        name
        for name in numbers
        if not _is_number(value := getattr(said, name, "missing"))
        and not (name in optional and (value is None or isinstance(value, tuple)))
    ]
    if not wrong:
        return []
    return [
        f"{call}: expected {also}{form.__name__} with the finite numbers {', '.join(wrong)}, got {said!r}"
    ]


def _is_number(value: object) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool) and isfinite(float(value))
