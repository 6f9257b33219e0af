"""All metrics by name: one per run (`EPISODE`), and one per visit or per person (`VISIT`)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics.episode import Metrics
from comity_sim2d.metrics.metric import Metric, by_name, definitions, values, values_of_person

EPISODE: Mapping[str, Metric] = by_name(*(each for each in definitions(Metrics) if each.per == "run"))
"""Metrics per run. Those without a value (no people, no known path) are left out."""
VISIT: Mapping[str, Metric] = by_name(*(each for each in definitions(Metrics) if each.per != "run"))
"""Metrics per visit and per person."""


def by_short_name(metrics: Mapping[str, Metric]) -> Mapping[str, Metric]:
    """The metrics by name, both with and without the unit."""
    return {each.short_name: each for each in metrics.values()} | dict(metrics)


def of_episode(metrics: Metrics) -> dict[str, float]:
    """The values of the run's metrics by name, without missing ones."""
    require_kinds("figures", metrics=(metrics, Metrics))
    return _with_values(values(metrics))


def of_person(metrics: Metrics, person: str) -> dict[str, float]:
    """The values of one person's metrics by name, without missing ones."""
    require_kinds("figures", metrics=(metrics, Metrics), person=(person, str))
    return _with_values(values_of_person(metrics, person))


def _with_values(numbers: Iterable[tuple[str, float | None]]) -> dict[str, float]:
    return {name: value for name, value in numbers if value is not None and math.isfinite(value)}
