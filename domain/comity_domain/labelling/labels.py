"""Labels of the label search, many at once in columns."""

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
    """Ways to have served equally many people; all columns are equally long."""

    served_count: int
    served: Whole
    """Who was served, as bits."""
    spot: Whole
    """Where the robot stands."""
    cost: Whole
    """In cm."""
    tie: Whole
    """What decides between labels of equal cost, less being better (`choices.ties`)."""
    turns: Whole
    """Who was greeted in which turn, as digits of one number: the scenario's order is the least one."""
    time_ms: Whole
    level: Whole
    """Among the labels that the search kept, where the one before is; -1: there is none."""
    row: Whole
    """Its row there."""
    arrival: Whole
    """The number of the last arrival; -1: there was none."""

    @property
    def columns(self) -> tuple[Whole, ...]:
        """All of them, in the order of the fields."""
        return (
            *(self.served, self.spot, self.cost, self.tie, self.turns),
            *(self.time_ms, self.level, self.row, self.arrival),
        )

    def rows(self, which: Whole | slice) -> Labels:
        """Some of the labels, in this order."""
        return Labels(self.served_count, *(column[which] for column in self.columns))


def joined(parts: Sequence[Labels]) -> Labels:
    """All labels of several parts with the same number of people."""
    import numpy as np

    columns = zip(*(part.columns for part in parts), strict=True)
    return Labels(parts[0].served_count, *(np.concatenate(column) for column in columns))


def first_label(table: LabelTable, begun: Sequence[PlannedVisit], options: Options) -> Labels:
    """What was done before the search; its cost counts no more."""
    import numpy as np

    people = [table.names.index(name) for visit in begun for name in served(visit, options)]
    spot = table.spots.index(begun[-1].last_spot if begun else START)
    now_s = times_s(begun, options)[-1][1] if begun and options.has_deadlines else 0.0
    row = (sum(1 << person for person in people), spot, 0, 0, 0, round(1000 * now_s), -1, -1, -1)
    return Labels(len(people), *(np.array([value], dtype=np.int64) for value in row))
