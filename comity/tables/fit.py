"""Fit of a linguistic variable to a column of data: the paper's third case, generalised."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from textwrap import shorten
from typing import TYPE_CHECKING

from comity_fis import (
    Coercion,
    Level,
    NumericVariable,
    OneClusterError,
    Where,
    cluster_counts,
    from_data,
)
from comity_fis.errors import InputError
from comity_fis.rulebook.models import LONGEST_NAME
from comity_fis.variables.partitioning import RADII

if TYPE_CHECKING:
    from comity.tables.column import TableColumn


@dataclass(frozen=True, slots=True)
class Fit:
    """The result of a fit."""

    column: TableColumn
    radius: float
    counts: Mapping[float, int]
    """Number of clusters at each radius, ascending; includes the fit's own radius."""
    variable: NumericVariable | None
    """The fitted variable; None if the data form one cluster."""

    @property
    def radius_for_more(self) -> float | None:
        """The largest smaller radius at which the data form more than one cluster."""
        return max((r for r, count in self.counts.items() if r < self.radius and count > 1), default=None)


def fit_column(
    column: TableColumn,
    *,
    radius: float = 0.5,
    domain: tuple[float, float] | None = None,
    level: Level = Level.INTERVAL,
    coercion: str | None = None,
) -> Fit:
    """Cluster a column and fit a term to each cluster.

    Args:
        column: The data.
        radius: Radius of the subtractive clustering, as a fraction of the data's range.
        domain: Lower and upper end of the variable's domain; None for the data's own.
        level: Level of measurement.
        coercion: Why ordinal data are treated as interval data.

    Raises:
        InputError: if no variable can be fitted; a single cluster is no error.
    """
    reason = (
        f"Fitted to the column {column.name} ({len(column.values)} values). "
        "Say here what it measures, of whom, and where it comes from."
    )
    try:
        variable = from_data(
            _name(column.name),
            column.values,
            radius=radius,
            domain=domain,
            level=level,
            coercion=Coercion(Level.INTERVAL, coercion) if coercion else None,
            data=f"{column.name} ({len(column.values)} values)",
            reason=reason,
        )
    except OneClusterError:
        variable = None
    except InputError as error:
        raise error.at(Where(column.file)) from None
    radii = sorted({*RADII, radius})
    return Fit(column, radius, cluster_counts(column.values, radii), variable)


def _name(heading: str) -> str:
    """A valid name in a rulebook: no quotes, limited length, cut between words if possible."""
    clean = " ".join(re.sub(r"['\"]", " ", heading).split())
    return shorten(clean, LONGEST_NAME, placeholder="") or clean[:LONGEST_NAME] or "variable"
