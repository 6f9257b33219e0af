"""Labels of the label search, stored in columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.labelling.table import LabelTable
from comity_domain.problem.spot import START
from comity_domain.tours.tour import PlannedVisit, served, times_s

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Labels:
    """Labels with equally many people served; all columns have the same length."""

    served_count: int
    served: Whole
    """People served, as bits."""
    spot: Whole
    """Index of the robot's position."""
    cost: Whole
    """Cost so far [cm]."""
    tie: Whole
    """Tie-break between labels of equal cost; less is better (`choices.ties`)."""
    turns: Whole
    """Order of greetings, as digits of one number: the scenario's order is the smallest."""
    time_ms: Whole
    level: Whole
    """Level of the previous label among the kept ones; -1: none."""
    row: Whole
    """Row of the previous label in that level."""
    arrival: Whole
    """Index of the last arrival; -1: none."""

    @property
    def columns(self) -> tuple[Whole, ...]:
        """All columns, in the order of the fields."""
        return (
            *(self.served, self.spot, self.cost, self.tie, self.turns),
            *(self.time_ms, self.level, self.row, self.arrival),
        )

    def rows(self, which: Whole | slice) -> Labels:
        """Some of the labels, in this order."""
        return Labels(self.served_count, *(column[which] for column in self.columns))


def joined(parts: Sequence[Labels]) -> Labels:
    """Concatenation of labels with the same number of people served."""
    import numpy as np

    columns = zip(*(part.columns for part in parts), strict=True)
    return Labels(parts[0].served_count, *(np.concatenate(column) for column in columns))


def first_label(table: LabelTable, begun: Sequence[PlannedVisit], options: Options) -> Labels:
    """The label of what was done before the search; its cost no longer counts."""
    import numpy as np

    people = [table.names.index(name) for visit in begun for name in served(visit, options)]
    spot = table.spots.index(begun[-1].last_spot if begun else START)
    now_s = times_s(begun, options)[-1][1] if begun and options.has_deadlines else 0.0
    row = (sum(1 << person for person in people), spot, 0, 0, 0, round(1000 * now_s), -1, -1, -1)
    return Labels(len(people), *(np.array([value], dtype=np.int64) for value in row))
