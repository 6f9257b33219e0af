"""Greetings that miss their deadline on a tour, and the last visit that a deadline depends on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from comity_domain.choices.options import Options
from comity_domain.tours.tour import PlannedVisit, end_times_s, served


@dataclass(frozen=True, slots=True)
class Late:
    """A greeting that ends after its deadline, by the estimated durations."""

    person: str
    greeted_s: float
    by_s: float

    def after(self, begun_s: float) -> Late:
        """The same with times on a clock that showed `begun_s` when the tour began."""
        return replace(self, greeted_s=self.greeted_s + begun_s, by_s=self.by_s + begun_s)

    def __str__(self) -> str:
        tenths = f"{self.greeted_s:.1f}"
        greeted = tenths if float(tenths) > self.by_s else f"{self.greeted_s:.3f}"
        return f"{self.person} would be greeted at {greeted} s, later than {self.by_s:g} s"


def late(visits: Sequence[PlannedVisit], options: Options) -> Late | None:
    """The first late greeting; None if every deadline is met."""
    if not options.has_deadlines:
        return None
    for visit, end_s in zip(visits, end_times_s(visits, options), strict=True):
        for name in served(visit, options):
            by_s = options.people[name].by_s
            if by_s is not None and end_s > by_s:
                return Late(name, end_s, by_s)
    return None


def until_last_deadline(visits: Sequence[PlannedVisit], options: Options) -> Sequence[PlannedVisit]:
    """The visits up to the last one with a deadline; empty if there is none."""
    hurried = (
        index
        for index, visit in enumerate(visits, 1)
        if any(options.people[name].by_s is not None for name in served(visit, options))
    )
    return visits[: max(hurried, default=0)]
