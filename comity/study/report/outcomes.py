"""Outcomes of a study: numbers measured at a visit, with unit and meaning."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from comity_fis import Where, unknown_word
from comity_sim2d.metrics import without_unit

if TYPE_CHECKING:
    from comity.study.report.episodes import StudyVisits
    from comity.study.report.resampling import Floats

SERVED, OUTSIDE, EXCESS = "served_share", "outside_comfort_share", "outside_comfort_m"


@dataclass(frozen=True, slots=True)
class StudyOutcome:
    """One number per visit."""

    name: str
    unit: str
    """Unit; `1` for a share or a count."""
    means: str
    values: Floats = field(repr=False)
    """One value per visit; NaN if missing."""

    @property
    def varies(self) -> bool:
        """Whether its values differ between visits."""
        return not np.isnan(self.values).all() and bool(np.nanmax(self.values) > np.nanmin(self.values))

    @property
    def label(self) -> str:
        """Axis label: `distance actual [m]`."""
        return label_of(self.name, self.unit)


def label_of(name: str, unit: str) -> str:
    """Axis label of a column: `distance actual [m]` of `distance_actual_m`."""
    plain = re.sub(r"(?<=\d) (?=\d)", ".", without_unit(name, unit).replace("_", " "))  # `1_5` is 1.5
    return plain if unit in ("1", "") else f"{plain} [{unit}]"


def served(visits: StudyVisits) -> Floats:
    """1 if the person was greeted, 0 if not; NaN if they declined, or the episode raised an exception."""
    said = {"greeted": 1.0, "declined": np.nan, "error": np.nan}
    return np.array([said.get(one, 0.0) for one in visits.words("outcome")])


def excess_m(visits: StudyVisits) -> Floats:
    """Distance of the robot's stop from the person's comfort interval [m], at least 0."""
    return np.abs(visits.numbers("comfort_gap_m"))


def _outside(visits: StudyVisits) -> Floats:
    gap = excess_m(visits)
    return np.where(np.isnan(gap), np.nan, (gap > 0).astype(float))


_Derive = Callable[["StudyVisits"], "Floats"]
DERIVED: Mapping[str, tuple[str, str, _Derive]] = MappingProxyType(
    {
        SERVED: (
            "1",
            "Share of the visits in which the person was greeted; declined ones do not count.",
            served,
        ),
        OUTSIDE: ("1", "Share of the stops outside the person's comfort interval.", _outside),
        EXCESS: ("m", "How far outside the comfort interval the robot stopped, either way.", excess_m),
    }
)
CHOSEN = ("chosen_distance_m", "chosen_bearing_deg")
"""Columns that, if the person moves, show where the robot ended up rather than a choice."""
MOVED = ("step_back", "lean_in", "turn_away")
"""Reactions that show that a person moved."""
MAIN = (
    *DERIVED,
    "comfort_gap_m",
    "distance_actual_m",
    "stop_distance_error_m",
    "bearing_error_deg",
    "approach_speed_actual_m_s",
    "greeted_s",
    "late_s",
    "episode_path_length_m",
)
"""Outcomes with a figure by default."""


def outcomes_of(visits: StudyVisits) -> dict[str, StudyOutcome]:
    """By name, all outcomes that vary between visits, and whether people were served: main ones first."""
    found = {}
    names = (*MAIN, *(name for name in visits.measured if name not in MAIN and name != "row"))
    for name in names:
        if name in DERIVED:
            unit, means, derive = DERIVED[name]
            outcome = StudyOutcome(name, unit, means, derive(visits))
        elif name in visits.study.columns:
            outcome = _of_column(visits, name)
        else:
            continue
        if outcome.varies or (name == SERVED and not np.isnan(outcome.values).all()):
            found[name] = outcome
    return found


def _of_column(visits: StudyVisits, name: str) -> StudyOutcome:
    told, values = visits.study.columns[name], visits.numbers(name)
    if name not in CHOSEN:
        return StudyOutcome(name, told["unit"], told["definition"], values)
    means = f"{told['definition']} Such visits do not count."
    chose = ~np.isin(visits.words("noticed"), MOVED)
    return StudyOutcome(name, told["unit"], means, np.where(chose, values, np.nan))


def pictured(outcomes: Mapping[str, StudyOutcome], asked: Sequence[str]) -> tuple[StudyOutcome, ...]:
    """The outcomes to draw.

    Args:
        outcomes: All of the study.
        asked: Names; the main ones if empty.

    Raises:
        InputError: for a name that is no outcome of the study, or that does not vary.
    """
    for name in asked:
        if name not in outcomes:
            raise unknown_word(
                "an outcome in which visits of the study differ", name, outcomes, where=Where("--outcome")
            )
    names = asked or [name for name in MAIN if name in outcomes and outcomes[name].varies]
    return tuple(outcomes[name] for name in dict.fromkeys(names))
