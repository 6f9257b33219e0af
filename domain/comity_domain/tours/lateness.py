"""Who would be greeted too late on a tour, and up to which visit that matters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from comity_domain.choices.options import Options
from comity_domain.tours.tour import PlannedVisit, end_times_s, served


@dataclass(frozen=True, slots=True)
class Late:
    """A greeting that is over after its deadline, as deadlines are computed."""

    person: str
    greeted_s: float
    by_s: float

    def after(self, begun_s: float) -> Late:
        """The same on a clock that showed so much when the tour was begun."""
        return replace(self, greeted_s=self.greeted_s + begun_s, by_s=self.by_s + begun_s)

    def __str__(self) -> str:
        tenths = f"{self.greeted_s:.1f}"
        greeted = tenths if float(tenths) > self.by_s else f"{self.greeted_s:.3f}"
        return f"{self.person} would be greeted at {greeted} s, later than {self.by_s:g} s"


def late(visits: Sequence[PlannedVisit], options: Options) -> Late | None:
    """The first who would be greeted too late; None where every deadline is kept."""
    if not options.has_deadlines:
        return None
    for visit, end_s in zip(visits, end_times_s(visits, options), strict=True):
        for name in served(visit, options):
            by_s = options.people[name].by_s
            if by_s is not None and end_s > by_s:
                return Late(name, end_s, by_s)
    return None


def until_last_deadline(visits: Sequence[PlannedVisit], options: Options) -> Sequence[PlannedVisit]:
    """The visits on which some deadline hangs; none where nobody has one."""
    hurried = (
        index
        for index, visit in enumerate(visits, 1)
        if any(options.people[name].by_s is not None for name in served(visit, options))
    )
    return visits[: max(hurried, default=0)]
