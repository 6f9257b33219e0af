"""The columns of a study's table: unit, definition, source, and why a cell of each may be empty."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from comity.study.statement import STATEMENT
from comity_sim2d import EPISODE, VISIT
from comity_sim2d.metrics.metric import OWN

FILE = "the study's file"
PEOPLE = "the population"


@dataclass(frozen=True, slots=True)
class ColumnDefinition:
    """What a column holds."""

    unit: str
    """Unit; `1` for a share or a count, empty for text."""
    means: str
    source: str
    missing: str = ""
    """Why a cell may be empty; empty if none can be, or if an empty cell needs no explanation."""

    @property
    def is_measured(self) -> bool:
        """Whether it is a result of the episode rather than an input."""
        return self.source not in (FILE, PEOPLE)


DESIGN: Mapping[str, ColumnDefinition] = MappingProxyType(
    {
        "row": ColumnDefinition("1", "Number of the row, from 1.", OWN),
        "scenario": ColumnDefinition("", "Scenario as the study names it.", FILE),
        "condition": ColumnDefinition("1", "Number of the combination of factors, from 1.", FILE),
        "rulebook_used": ColumnDefinition("", "Name of the rulebook that decided.", OWN),
        "group": ColumnDefinition("", f"Group of the individual. {STATEMENT}", PEOPLE, "no individual"),
        "individual": ColumnDefinition(
            "", f"Pseudonym, the same in every condition. {STATEMENT}", PEOPLE, "no individual"
        ),
        "seed": ColumnDefinition("1", "Of random places and the noise of sensors.", FILE),
        "person": ColumnDefinition("", "Person of the scenario that was visited.", FILE),
    }
)
"""Columns that identify the episode and the visit."""

COMFORT: Mapping[str, ColumnDefinition] = MappingProxyType(
    {
        "comfort_near_m": ColumnDefinition(
            "m", "Nearer is too close for the person, between surfaces.", PEOPLE, "no comfort stated"
        ),
        "comfort_far_m": ColumnDefinition(
            "m", "Farther is too far for the person, between surfaces.", PEOPLE, "no comfort stated"
        ),
        "comfort_gap_m": ColumnDefinition(
            "m",
            "How far distance_actual_m is outside the comfort interval: negative too near, positive too far.",
            OWN,
            "no comfort stated, or never docked",
        ),
    }
)

NEVER_DOCKED, NO_VISIT = "never docked", "no such approach"
REACHED: Mapping[str, ColumnDefinition] = MappingProxyType(
    {
        "outcome": ColumnDefinition(
            "",
            "Of the visit, as in run.json; no_plan where no plan was found, error where the episode raised.",
            OWN,
        ),
        "reason": ColumnDefinition("", "Why the visit did not succeed; empty where it did.", OWN),
        "distance_target_m": ColumnDefinition(
            "m", "Conversational distance aimed at, between surfaces.", OWN, "no plan"
        ),
        "distance_actual_m": ColumnDefinition(
            "m",
            "Distance before the person as the robot's sensor had it when it docked last, between surfaces.",
            OWN,
            NEVER_DOCKED,
        ),
        "centre_distance_actual_m": ColumnDefinition("m", "The same between centres.", OWN, NEVER_DOCKED),
        "bearing_target_deg": ColumnDefinition(
            "deg", "From where the person faces, positive to their left: aimed at.", OWN, "no plan"
        ),
        "bearing_actual_deg": ColumnDefinition(
            "deg", "The same as it docked last, by its sensor.", OWN, NEVER_DOCKED
        ),
        "approach_speed_target_m_s": ColumnDefinition(
            "m/s", "The most within 1.5 m of the person's body.", OWN, "no plan"
        ),
        "approach_speed_actual_m_s": ColumnDefinition(
            "m/s", "The fastest there on the way in.", OWN, "never within 1.5 m"
        ),
        "greeting": ColumnDefinition("", "Acts of the greeting that were performed.", OWN, "not greeted"),
        "deviation_reason": ColumnDefinition(
            "", "Why the robot stood elsewhere than aimed at; empty where it did not.", OWN
        ),
        "docked_s": ColumnDefinition("s", "When the robot docked, from the start.", OWN, NEVER_DOCKED),
        "greeted_s": ColumnDefinition(
            "s", "When the last act of the greeting was done, from the start.", OWN, "not greeted"
        ),
        "late_s": ColumnDefinition(
            "s", "How much later than the goal's by_s that was.", OWN, "no deadline, or not greeted"
        ),
        "noticed": ColumnDefinition(
            "", "How the person took it, as the robot saw it.", OWN, "the robot did not attend to it"
        ),
    }
)
"""Columns of targets and results."""

PROVENANCE: Mapping[str, ColumnDefinition] = MappingProxyType(
    {
        "episode_outcome": ColumnDefinition("", "Of the whole episode.", OWN, "no episode"),
        "error": ColumnDefinition("", "What the episode raised; empty where it raised nothing.", OWN),
        "trace_sha256": ColumnDefinition(
            "", "Digest of the episode's trace: equal for equal episodes.", OWN, "no episode"
        ),
        "key": ColumnDefinition(
            "", "Digest of all that the episode depends on: scenario, seed, rulebook, code, fingerprint.", OWN
        ),
        "version": ColumnDefinition("", "Of Comity.", OWN),
        "code": ColumnDefinition("", "Digest of the installed code, its first 12 digits.", OWN),
        "fingerprint": ColumnDefinition(
            "", "Interpreter, machine and libraries that the digits depend on.", OWN
        ),
        "why_missing": ColumnDefinition(
            "", "Why cells of this row are empty, as `reason: columns; ...`.", OWN
        ),
        "note": ColumnDefinition("", STATEMENT, OWN),
    }
)
"""Columns of the row's provenance and limits."""
FACT, WISH = "fact_", "wish_"


def column_of(path: str) -> str:
    """Column name of a factor: its path with `_` between the keys, valid in R and SQL."""
    return re.sub(r"\W+", "_", path).strip("_")


def columns_of(factors: Sequence[str], found: Iterable[str]) -> dict[str, ColumnDefinition]:
    """The columns of a table in their order.

    Args:
        factors: The paths of the study's factors.
        found: Columns with a value in some row.
    """
    measured = set(found)
    told = sorted(name for name in measured if name.startswith((FACT, WISH)))
    visit = {name: ColumnDefinition(one.unit, one.means, one.source, NO_VISIT) for name, one in VISIT.items()}
    whole = {
        f"episode_{name}": ColumnDefinition(
            one.unit, f"Of the whole episode: {one.means}", one.source, "undefined"
        )
        for name, one in EPISODE.items()
    }
    metrics = {name: one for name, one in {**visit, **whole}.items() if name in measured}
    comfort = COMFORT if measured & COMFORT.keys() else {}
    before = ("row", "scenario", "condition")
    return {
        **{name: DESIGN[name] for name in before},
        **{column_of(path): _factor(path) for path in factors},
        **{name: one for name, one in DESIGN.items() if name not in before},
        **{name: _told(name) for name in told},
        **comfort,
        **REACHED,
        **metrics,
        **PROVENANCE,
    }


def _factor(path: str) -> ColumnDefinition:
    unit = next((unit for end, unit in UNITS.items() if path.endswith(end)), "")
    return ColumnDefinition(unit, f"Factor: {path}.", FILE, "as the scenario has it")


UNITS = {"_m_s2": "m/s^2", "_m_s": "m/s", "_m": "m", "_s": "s", "_deg": "deg", "_db": "dB(A)"}
"""Units by the suffix of a factor's path; the first match counts."""


def _told(name: str) -> ColumnDefinition:
    if name.startswith(WISH):
        means = f"Wish that the person stated: {name.removeprefix(WISH)}. {STATEMENT}"
        return ColumnDefinition("", means, PEOPLE, "no wish stated")
    means = f"Fact that the rulebook used: {name.removeprefix(FACT)}. {STATEMENT}"
    unit = "years" if name == "fact_age" else ""
    return ColumnDefinition(unit, means, PEOPLE, "not disclosed, or not used by the rulebook")
