"""The label search, exact over the people served and the robot's position; also for what-if questions.

A label is a partial plan: the people served, the robot's position, the cost and the time. Among labels with
the same people and position only those remain that no other dominates in cost and time (Held and Karp 1962
for the order; dominance among labels as in Desrochers and Soumis 1988 for the time). Once everyone with a
deadline is served, only cost counts. Ties in cost are broken as in `choices.ties`, as if the cost had further
digits. All labels with the same number of people served are extended together.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from time import monotonic
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.labelling.labels import Labels, first_label, joined
from comity_domain.labelling.table import LabelTable, label_table
from comity_domain.tours.tour import PlannedVisit, Stop

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_LABELS = 500_000
"""Maximum number of labels kept per number of people served: enough to be exact with 12 people.

If there are more, only the most promising are kept, and the answer is not proven; it is the same on every
machine.
"""
MOST_PROVEN = 12
"""Number of people for which this many labels are exact within seconds."""
MOST_BY_WAYS = 16
"""The same without deadlines and priorities: then few labels are promising."""
FEWER_LABELS = 4_000
"""Maximum number of labels for more people, for whom the search rarely proves optimality."""
QUICK_LABELS = 1_000
"""Number of labels of a first search, whose answer bounds the second one."""
NO_LIMIT = 2**60
"""Upper bound of all plan costs [cm]."""
NO_END = (NO_LIMIT, 0, 0)


@dataclass(frozen=True, slots=True)
class Cheapest:
    """The cheapest way to serve everyone who is left."""

    cost: int
    """Remaining cost [cm]."""
    stops: tuple[Stop, ...]
    skipped: tuple[str, ...]
    """People left out at their cost."""
    exact: bool
    """Whether it is proven that there is no cheaper one."""
    in_time: bool = True
    """False if the search was cut off, so that another run may give another result."""


def cheapest(
    options: Options,
    *,
    begun: Sequence[PlannedVisit] = (),
    next_person: str | None = None,
    order: Sequence[str] = (),
    at_most: int = NO_LIMIT,
    ends_s: float = math.inf,
) -> Cheapest | None:
    """The cheapest continuation that keeps all deadlines, or None, or none was found.

    Ties are broken as in `choices.ties`.

    Args:
        options: The options.
        begun: The visits already made.
        next_person: The person to reach next; None: any, or the person for whom the robot holds something.
        order: People to reach in this order, with any others in between.
        at_most: Upper bound of the cost [cm]; a low one makes the search fast.
        ends_s: Time limit by the machine's clock, after which the first answer counts [s].
    """
    next_person = next_person or options.bearer_of
    table = label_table(options, order)
    first = first_label(table, begun, options)
    labels = most_labels(options)
    return _cheapest(table, first, next_person, most_labels=labels, at_most=at_most, ends_s=ends_s)[0]


def cheapest_or_proof(options: Options, *, ends_s: float = math.inf) -> tuple[Cheapest | None, bool]:
    """The cheapest plan of a request, and whether it, or that there is none, is proven."""
    table = label_table(options)
    first = first_label(table, (), options)
    return _cheapest(table, first, options.bearer_of, most_labels=most_labels(options), ends_s=ends_s)


def most_labels(options: Options) -> int:
    """Number of labels to keep: enough for a proof if that takes seconds."""
    only_ways = not options.has_deadlines and not options.has_priorities
    return (
        MOST_LABELS if len(options.people) <= (MOST_BY_WAYS if only_ways else MOST_PROVEN) else FEWER_LABELS
    )


def _cheapest(
    table: LabelTable,
    first: Labels,
    next_person: str | None,
    *,
    most_labels: int,
    at_most: int = NO_LIMIT,
    ends_s: float,
) -> tuple[Cheapest | None, bool]:
    """A fast search, then a thorough one if it is not exact; and whether the result is proven."""
    try:
        quick, exact = searched(table, first, next_person, at_most=at_most, ends_s=ends_s)
    except TimeoutError:
        return None, False
    if exact:
        return quick, True
    # Labels that cost more than the fast answer cannot be part of a cheaper plan.
    at_most = quick.cost if quick else at_most
    try:
        thorough, exact = searched(
            table, first, next_person, most_labels=most_labels, at_most=at_most, ends_s=ends_s
        )
    except TimeoutError:
        return (replace(quick, in_time=False) if quick else None), False
    return (thorough if thorough is not None else quick), exact


def first_look(options: Options, *, ends_s: float = math.inf) -> Cheapest | None:
    """A fast search with few labels; mostly not exact.

    Raises:
        TimeoutError: Not soon enough, by the machine's clock.
    """
    table = label_table(options)
    return searched(table, first_label(table, (), options), options.bearer_of, ends_s=ends_s)[0]


def searched(
    table: LabelTable,
    first: Labels,
    next_person: str | None,
    *,
    most_labels: int = QUICK_LABELS,
    at_most: int = NO_LIMIT,
    ends_s: float = math.inf,
) -> tuple[Cheapest | None, bool]:
    """The cheapest way to go on from a label, and whether that is proven; also that there is none.

    Args:
        table: What may be chosen.
        first: One label.
        next_person: The person to reach next; None: anybody.
        most_labels: Kept for each number of people served; where there are more, nothing is proven.
        at_most: What the answer may cost, in cm.
        ends_s: When the search is given up, by the machine's clock.

    Raises:
        TimeoutError: It was given up.
    """
    # Dynamic programming over sets of people (Held and Karp 1962): what follows depends not on how a set was
    # served, but only on the robot's position, the cost and the time. Labels are processed by the number of
    # people served, since every extension serves more: when a number is reached, all its labels exist, so
    # dominance is tested once, on whole arrays. The answer is proven as long as only dominated labels, and
    # labels that cost more than `at_most`, were dropped.
    waiting: dict[int, list[Labels]] = {first.served_count: [first]}
    kept: list[Labels] = []
    exact = True
    while waiting:
        labels = _promising(_undominated(joined(waiting.pop(min(waiting))), table), table, at_most)
        exact &= len(labels.cost) <= most_labels
        if not len(labels.cost):
            continue
        kept.append(labels.rows(slice(most_labels)))
        only = next_person if len(kept) == 1 else None
        for longer in _extended(kept[-1], len(kept) - 1, table, only):
            if monotonic() > ends_s:
                raise TimeoutError
            waiting.setdefault(longer.served_count, []).append(_undominated(longer, table))
    cost, level, row = min(
        (_best_end(labels, level, table) for level, labels in enumerate(kept)), default=NO_END
    )
    if cost >= NO_LIMIT:
        return None, exact
    served = int(kept[level].served[row])
    skipped = tuple(name for person, name in enumerate(table.names) if not served >> person & 1)
    return Cheapest(cost, _stops(kept, level, row, table), skipped, exact), exact


def _best_end(labels: Labels, level: int, table: LabelTable) -> tuple[int, int, int]:
    """Cost of the cheapest end, with level and row of its label, after tie-breaking."""
    import numpy as np

    cost = _ends(labels, table)
    row = int(np.lexsort((labels.turns, labels.tie, cost))[0])
    return int(cost[row]), level, row


def _ends(labels: Labels, table: LabelTable) -> NDArray[np.int64]:
    """Cost of ending here and leaving out all others; `NO_LIMIT` where a person may not be left out."""
    import numpy as np

    cost = labels.cost.copy()
    for person, skip in enumerate(table.skips):
        missing = labels.served >> person & 1 == 0
        cost = np.where(missing, NO_LIMIT if skip is None else cost + skip, cost)
    return np.minimum(cost, NO_LIMIT)


def _undominated(labels: Labels, table: LabelTable) -> Labels:
    """The Pareto front in cost (with ties) and time among labels with the same people and position."""
    import numpy as np

    # Two criteria, cost and time, have a Pareto front and not one best label (Desrochers and Soumis 1988).
    # After sorting by people, spot and cost, a label is on the front where its time is less than all times
    # before it in its group: one running minimum finds the fronts of all groups, instead of a comparison of
    # all pairs. Time is set to 0 where no deadline is left, so that each front shrinks to its cheapest
    # label.
    in_a_hurry = labels.served & table.with_deadline != table.with_deadline
    time_ms = np.where(in_a_hurry, labels.time_ms, 0)
    order = np.lexsort((time_ms, labels.turns, labels.tie, labels.cost, labels.spot, labels.served))
    labels, time_ms = labels.rows(order), time_ms[order]
    keeps = np.ones(len(order), dtype=bool)
    keeps[1:] = (np.diff(labels.served) != 0) | (np.diff(labels.spot) != 0)
    # The running minimum restarts in each group: a later group's times are lowered below all earlier ones.
    lowered = time_ms - np.cumsum(keeps) * (int(time_ms.max()) + 1)
    keeps[1:] |= lowered[1:] < np.minimum.accumulate(lowered)[:-1]
    return labels.rows(np.flatnonzero(keeps))


def _promising(labels: Labels, table: LabelTable, at_most: int) -> Labels:
    """Labels that may end at this cost, cheapest first; leaving people out costs something, too."""
    import numpy as np

    promise, waits = labels.cost.copy(), _greeted_before(labels, table)
    for person in table.by_priority:
        missing = labels.served >> person & 1 == 0
        promise += np.where(missing, table.least[person] + table.priorities[person] * waits, 0)
        if not table.companies:  # whose members do not wait for each other
            waits += missing
    order = np.argsort(promise, kind="stable")
    return labels.rows(order[promise[order] <= at_most])


def _extended(labels: Labels, level: int, table: LabelTable, next_person: str | None) -> Iterator[Labels]:
    """One more stop after each label, wherever a route leads there and nobody will be too late."""
    import numpy as np

    before = _greeted_before(labels, table)
    for number, arrival in enumerate(table.arrivals):
        if next_person is not None and table.names[arrival.person] != next_person:
            continue
        leg = arrival.legs[labels.spot]
        greeted_ms = labels.time_ms + arrival.times_ms[labels.spot]
        end_ms = greeted_ms + arrival.after_ms
        served = labels.served | arrival.people
        possible = (labels.served & arrival.people == 0) & (leg >= 0) & (greeted_ms <= arrival.by_ms)
        possible &= labels.served & arrival.after == arrival.after
        rows = np.flatnonzero(possible & ~_too_late(served, end_ms, table))
        if len(rows):
            yield Labels(
                labels.served_count + arrival.people.bit_count(),
                served[rows],
                np.full(len(rows), arrival.spot),
                labels.cost[rows] + leg[rows] + arrival.cost + arrival.priority * before[rows],
                labels.tie[rows] + arrival.tie,
                labels.turns[rows] + table.turns(arrival.turn, labels.served_count),
                end_ms[rows],
                np.full(len(rows), level),
                rows,
                np.full(len(rows), number),
            )


def _greeted_before(labels: Labels, table: LabelTable) -> NDArray[np.int64]:
    """Number of people served in each label, without those greeted before the plan."""
    import numpy as np

    counts = np.full(len(labels.served), labels.served_count, dtype=np.int64)
    for person in range(len(table.names)):
        if table.greeted >> person & 1:
            counts -= labels.served >> person & 1
    return counts


def _too_late(served: NDArray[np.int64], end_ms: NDArray[np.int64], table: LabelTable) -> NDArray[np.bool_]:
    """Whether a remaining person can no longer be greeted in time, whatever the robot does."""
    import numpy as np

    late = np.zeros(len(served), dtype=bool)
    for person, latest_ms in table.latest_departures_ms.items():
        late |= (served >> person & 1 == 0) & (end_ms > latest_ms)
    return late


def _stops(kept: Sequence[Labels], level: int, row: int, table: LabelTable) -> tuple[Stop, ...]:
    """The stops from the first label to this one."""
    stops: list[Stop] = []
    labels = kept[level]
    while labels.level[row] >= 0:
        arrival = table.arrivals[int(labels.arrival[row])]
        company = table.companies[arrival.company] if arrival.company >= 0 else None
        stops.append(Stop(table.names[arrival.person], company, arrival.bringing))
        labels, row = kept[int(labels.level[row])], int(labels.row[row])
    return tuple(reversed(stops))
