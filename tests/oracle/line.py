"""One line of the oracle: what one episode planned and what came of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Line = dict[str, Any]

PLANNED = ("order", "sides", "cost", "parameters", "target_m")
"""Keys that the plan decides; all others, but for the digest, are the outcome's."""
DIGEST = "trace"
CONTACTS = ("person_contacts", "wall_contacts", "furniture_contacts")


def line_of(case: str, run: Mapping[str, Any], plan: Mapping[str, Any]) -> Line:
    """Read a line from a run folder's `run.json` and `plan.json`.

    Distances are in millimetres' precision and parameters in four digits: less than that is no change of
    behaviour, and the digest shows it.
    """
    docking = {step["people"][0]: step for step in plan["steps"] if step["action"] == "Reach_user"}
    visits = sorted(run["visits"], key=lambda visit: visit["docked_at_s"] or float("inf"))
    return {
        "case": case,
        "order": list(docking),
        "sides": {person: step["arguments"][-1] for person, step in docking.items()},
        "cost": plan["cost"],
        "parameters": {person: _parameters(run["values"][person]) for person in docking},
        "target_m": {visit["person"]: _rounded(visit["distance_wanted_m"], 3) for visit in visits},
        "outcome": run["outcome"],
        "visits": {visit["person"]: visit["outcome"] for visit in visits},
        "greetings": {visit["person"]: visit["greeting"] for visit in visits},
        "actual_m": {visit["person"]: _rounded(visit["distance_reached_m"], 3) for visit in visits},
        "contacts": {kind: run["metrics"].get(kind) for kind in CONTACTS},
        DIGEST: run["trace_sha256"][:16],
    }


def failed(case: str, error: Exception) -> Line:
    """Give the line of an episode that was refused or has no plan; only the kind of error is compared."""
    return {"case": case, "outcome": type(error).__name__}


def _parameters(person: Mapping[str, Any]) -> dict[str, Any]:
    return {name: _rounded(value["value"], 4) for name, value in person["parameters"].items()}


def _rounded(value: float | str | None, digits: int) -> float | str | None:
    return round(value, digits) if isinstance(value, float) else value
