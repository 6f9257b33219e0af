"""Definition of a metric (unit, meaning, source, bounds), stored next to the field that holds its value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from types import MappingProxyType
from typing import Any, Literal, get_args, get_type_hints

FRANCIS = "Francis et al. 2023, arXiv 2306.16740"
HUNAVSIM = "Pérez-Higueras et al. 2023, HuNavSim, arXiv 2305.01303"
ANDERSON = "Anderson et al. 2018, arXiv 1807.06757"
OWN = "Comity's own"
HALL = "Hall 1966, The Hidden Dimension"
_ENDS: Mapping[str, str] = {
    "m/s^3": "_m_s3",
    "m/s^2": "_m_s2",
    "m/s": "_m_s",
    "rad/m": "_rad_m",
    "m": "_m",
    "s": "_s",
    "deg": "_deg",
    "rad": "_rad",
}
"""Ending of a metric's name, by unit."""
_KEY = "metric"

Per = Literal["run", "visit", "person"]


@dataclass(frozen=True, slots=True)
class Metric:
    """One metric."""

    name: str
    """Name in JSON and tables, ending with the unit."""
    unit: str
    """Unit; `1` for a share or a count."""
    means: str
    source: str = OWN
    per: Per = "run"
    """`run`: one number; `visit`: one a person to visit; `person`: one a person of the scenario."""
    least: float | None = 0.0
    """Lower bound, in its unit; None: unbounded."""
    most: float | None = None
    """Upper bound, in its unit; None: unbounded."""

    @property
    def short_name(self) -> str:
        """Name without the unit, as in sentences."""
        return without_unit(self.name, self.unit)


def without_unit(name: str, unit: str) -> str:
    """The name of a value without the unit at its end: `path_length` of `path_length_m` and `m`."""
    return name.removesuffix(_ENDS.get(unit, ""))


def by_name(*metrics: Metric) -> Mapping[str, Metric]:
    """The metrics by their names, in their order."""
    return MappingProxyType({metric.name: metric for metric in metrics})


def defined(
    unit: str,
    means: str,
    source: str = OWN,
    *,
    per: Per = "run",
    name: str = "",
    least: float | None = 0.0,
    most: float | None = None,
) -> Mapping[str, Metric]:
    """The metadata of a dataclass field whose value is a metric, or one by person; see `Metric`.

    Args:
        unit: Unit, as in `Metric`.
        means: Definition.
        source: Source of the definition.
        per: Per run, visit or person.
        name: The metric's name; empty for that of the field.
        least: Lower bound.
        most: Upper bound.
    """
    return {_KEY: Metric(name, unit, means, source, per, least, most)}


def definitions(record: type[Any]) -> Iterator[Metric]:
    """The metrics that a dataclass and its nested records define, in field order."""
    hints = get_type_hints(record)
    for field in fields(record):
        if metric := field.metadata.get(_KEY):
            yield replace(metric, name=metric.name or field.name)
        for kind in (hints[field.name], *get_args(hints[field.name])):
            if isinstance(kind, type) and is_dataclass(kind):
                yield from definitions(kind)


def values(record: Any) -> Iterator[tuple[str, float | None]]:
    """The values of a dataclass by metric name, in field order; without those by person."""
    for field in fields(record):
        value = getattr(record, field.name)
        if is_dataclass(value):
            yield from values(value)
        elif _KEY in field.metadata and not isinstance(value, Mapping):
            yield field.name, value


def values_of_person(record: Any, person: str) -> Iterator[tuple[str, float | None]]:
    """The values of one person by metric name, from the mappings by person of a dataclass."""
    for field in fields(record):
        by_person = getattr(record, field.name)
        if not isinstance(by_person, Mapping) or person not in by_person:
            continue
        value = by_person[person]
        if is_dataclass(value):
            yield from values(value)
        else:
            yield field.metadata[_KEY].name or field.name, value
