"""What many orders of visits cost, computed at once: along each, a dynamic program over the sides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.labelling.table import NO_ROUTE, Arrival, LabelTable, label_table
from comity_domain.tours.tour import Stop, people_at

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

IMPOSSIBLE = 2**40
"""In cm or ms, more than any order takes: no route, a missed deadline, or a beginning with anybody but the
person for whom the robot already holds something."""


class OrderTable:
    """The visits to everyone by number, and what it costs at least to make one after another.

    A visit serves one person, or a company at once. An order of visits is a row of their numbers.

    Args:
        choices: What may be chosen.
    """

    def __init__(self, choices: Options) -> None:
        import numpy as np

        self._choices, self._table = choices, label_table(choices)
        together = [each.members for each in choices.companies.values()]
        served = [*((name,) for name in choices.people), *together]
        self._number = {self._bits(names): visit for visit, names in enumerate(served)}
        ways = [[way for way in self._table.arrivals if way.people == people] for people in self._number]
        self._costs, self._chosen = _costs_between(ways, self._table)
        self._times_ms = _times_between(ways, self._table)
        self._by_ms = np.array([each[0].by_ms if each else 0 for each in ways])
        self._greeted = np.array([(people & ~self._table.greeted).bit_count() for people in self._number])
        priorities = [each[0].priority if each else 0 for each in ways]
        self._priorities = np.where(self._greeted > 0, priorities, 0)
        bearer = choices.bearer_of
        self._first = None if bearer is None else self._number[self._bits([bearer])]

    @property
    def companies(self) -> tuple[str, ...]:
        """Those who can be greeted at once."""
        return tuple(name for name, each in self._choices.companies.items() if each.spots)

    def order(self, stops: Iterable[Stop]) -> Whole:
        """The numbers of some visits."""
        import numpy as np

        return np.array([self._number[self._bits(people_at(stop, self._choices))] for stop in stops])

    def costs(self, orders: Whole) -> Whole:
        """What orders cost with the best sides, in cm, shape (orders,); `IMPOSSIBLE` or more: it cannot be.

        Where something may be fetched before a greeting or after it, times are those of the quicker way.

        Args:
            orders: Shape (orders, visits).
        """
        legs = self._legs(orders)
        reached = self._costs[0, :, legs[0]].T
        for leg in legs[1:]:
            reached = (reached[:, None] + self._costs.take(leg, axis=2)).min(axis=0)
        greeted = self._greeted[orders]
        waiting = (greeted.cumsum(axis=1) - greeted) * self._priorities[orders]
        costs: Whole = reached.min(axis=0) + waiting.sum(axis=1)
        costs[self._are_late(orders)] = IMPOSSIBLE
        if self._first is not None:
            costs[orders[:, 0] != self._first] = IMPOSSIBLE
        return costs

    def stops(self, order: Whole) -> tuple[Stop, ...]:
        """The visits of one order, each made in the way that makes the whole cheapest."""
        legs = self._legs(order[None])[:, 0]
        reached = [self._costs[0, :, legs[0]]]
        for leg in legs[1:]:
            reached.append((reached[-1][:, None] + self._costs[..., leg]).min(axis=0))
        end, stops = int(reached[-1].argmin()), []
        for leg, before in zip(legs[:0:-1], reached[-2::-1], strict=True):
            start = int((before + self._costs[:, end, leg]).argmin())
            stops.append(self._stop(self._chosen[start, end, leg]))
            end = start
        return (self._stop(self._chosen[0, end, legs[0]]), *reversed(stops))

    def regrouped(self, order: Whole, company: str) -> Whole:
        """The order with a company greeted one by one instead of at once, or the other way round."""
        import numpy as np

        members = self._choices.companies[company].members
        at_once = [self._number[self._bits(members)]]
        one_by_one = [self._number[self._bits([name])] for name in members]
        visits = order.tolist()
        old, new = (at_once, one_by_one) if at_once[0] in visits else (one_by_one, at_once)
        place = min(map(visits.index, old))
        return np.array([*visits[:place], *new, *(each for each in visits[place:] if each not in old)])

    def _bits(self, names: Iterable[str]) -> int:
        return sum(1 << self._table.names.index(name) for name in names)

    def _legs(self, orders: Whole) -> Whole:
        """The numbers of the ways from visit to visit, first from the start, shape (visits, orders)."""
        import numpy as np

        count = len(self._number)
        origins = np.insert(orders[:, :-1], 0, count, axis=1)
        return np.ascontiguousarray((origins * count + orders).T)

    def _are_late(self, orders: Whole) -> NDArray[np.bool_]:
        """Whether each order greets a person after their deadline."""
        import numpy as np

        if not self._table.with_deadline:
            return np.zeros(len(orders), dtype=bool)
        greeted_ms = self._times_ms[self._legs(orders)].cumsum(axis=0)
        late: NDArray[np.bool_] = np.any(greeted_ms > self._by_ms[orders.T], axis=0)
        return late

    def _stop(self, arrival_number: int) -> Stop:
        arrival = self._table.arrivals[arrival_number]
        company = self._table.companies[arrival.company] if arrival.company >= 0 else None
        return Stop(self._table.names[arrival.person], company, arrival.bringing)


def _costs_between(ways: Sequence[Sequence[Arrival]], table: LabelTable) -> tuple[Whole, Whole]:
    """From every visit, last from the start, to every visit: the cost in cm, and the number of the arrival.

    Both have the shape (spots, spots, (visits + 1) * visits): from a spot at which the one may end to a spot
    at which the other may. A cost has everything of the visit in it but the waiting.
    """
    import numpy as np

    start, nowhere = len(table.spots) - 1, len(table.spots)
    ends = [*(sorted({way.spot for way in each}) for each in ways), [start]]
    most = max(map(len, ends))
    origins = np.array([[*each, *[nowhere] * (most - len(each))] for each in ends]).T
    costs = np.full((most, most, len(ends), len(ways)), IMPOSSIBLE, dtype=np.int64)
    chosen = np.full_like(costs, -1)
    numbers = {id(arrival): number for number, arrival in enumerate(table.arrivals)}
    for visit, each in enumerate(ways):
        for way in each:
            legs = np.append(way.legs, NO_ROUTE)[origins]
            found = np.where(legs == NO_ROUTE, IMPOSSIBLE, legs + way.cost)
            end = ends[visit].index(way.spot)
            cheaper = found < costs[:, end, :, visit]
            costs[:, end, :, visit][cheaper] = found[cheaper]
            chosen[:, end, :, visit][cheaper] = numbers[id(way)]
    return costs.reshape(most, most, -1), chosen.reshape(most, most, -1)


def _times_between(ways: Sequence[Sequence[Arrival]], table: LabelTable) -> Whole:
    """From the end of every visit's greeting, last from the start, to the end of every other's, at least.

    In ms, shape ((visits + 1) * visits,).
    """
    import numpy as np

    times_ms = np.full((len(ways) + 1, len(ways)), IMPOSSIBLE, dtype=np.int64)
    ends = [[way.spot for way in each] for each in ways]
    after_ms = [min((way.after_ms for way in each), default=0) for each in ways]
    for visit, each in enumerate(ways):
        for way in each:
            open_ms = np.where(way.legs == NO_ROUTE, IMPOSSIBLE, way.times_ms)
            earliest = [open_ms[spots].min(initial=IMPOSSIBLE) for spots in ends]
            found = [*np.add(earliest, after_ms), open_ms[-1]]
            times_ms[:, visit] = np.minimum(times_ms[:, visit], found)
    return times_ms.ravel()
