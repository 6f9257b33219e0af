"""All metrics by name: one per run (`EPISODE`), and one per visit or per person (`VISIT`)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics.episode import Metrics
from comity_sim2d.metrics.metric import Metric, by_name, definitions, values, values_of_person

EPISODE: Mapping[str, Metric] = by_name(*(each for each in definitions(Metrics) if each.per == "run"))
"""Per run. What has no value (nobody there, no path known) is left out."""
VISIT: Mapping[str, Metric] = by_name(*(each for each in definitions(Metrics) if each.per != "run"))
"""Per visit, and per person."""


def by_short_name(metrics: Mapping[str, Metric]) -> Mapping[str, Metric]:
    """The metrics by their names with the unit and without it."""
    return {each.short_name: each for each in metrics.values()} | dict(metrics)


def of_episode(metrics: Metrics) -> dict[str, float]:
    """The metrics of the run by the names of `EPISODE`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics))
    return _with_values(values(metrics))


def of_person(metrics: Metrics, person: str) -> dict[str, float]:
    """The metrics of one person by the names of `VISIT`, those that have a value."""
    require_kinds("figures", metrics=(metrics, Metrics), person=(person, str))
    return _with_values(values_of_person(metrics, person))


def _with_values(numbers: Iterable[tuple[str, float | None]]) -> dict[str, float]:
    return {name: value for name, value in numbers if value is not None and math.isfinite(value)}
