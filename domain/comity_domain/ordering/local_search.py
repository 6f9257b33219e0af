"""A cheaper order of visits by moves, over all sides at once, for more people than a search is exact for.

It goes from an order to cheaper neighbours until there is none, changes that order at random, begins again,
and keeps the cheapest: iterated local search (Lourenço, Martin, Stützle 2003, Handbook of Metaheuristics). It
draws the same changes each time and ends after so many orders: wherever its time suffices, a request has one
plan.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.ordering.insertion import Stops, cost_of_order
from comity_domain.ordering.moves import all_moves, double_bridge, moved
from comity_domain.ordering.order_table import OrderTable

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

Measure = Callable[[Stops], Options | None]
"""Measures all that an order takes, and gives what may be chosen then; None where it was measured before."""

MOST_ORDERS = 500_000
"""Orders that are compared: with 40 people some 50 changes at random, in 2 s."""
AT_ONCE = 1_000
"""Orders that are compared between two looks at the clock, in some 3 ms."""
MOST_CHECKED = 10
"""Of these, the cheapest that are looked at in full where there are deadlines."""
FEWEST = 4
"""Visits that a change at random takes."""


def improved(
    stops: Stops, choices: Options, measure: Measure = lambda _: None, *, ends_s: float = math.inf
) -> tuple[Stops, bool]:
    """The cheapest order that is found, never a more expensive one; and whether the search came to its end.

    Args:
        stops: An order that keeps all deadlines, all of which is measured.
        choices: What may be chosen.
        measure: An order that seems cheaper is measured before it is believed.
        ends_s: When the search is cut off, by the machine's clock.
    """
    cost = cost_of_order(stops, choices)
    if cost is None or monotonic() > ends_s:
        return stops, cost is None
    search = _LocalSearch(choices, measure, ends_s)
    start = search.numbers(stops)
    while True:
        found = search.cheaper(start, cost)
        if found is not None:
            stops, cost = found
        if len(stops) < FEWEST or search.is_over:
            return stops, not search.is_cut_off
        start = search.changed(stops)


class _LocalSearch:
    """Descents among the visits to the same people, with one budget.

    Args:
        choices: What may be chosen.
        measure: Measures an order.
        ends_s: When they are cut off, by the machine's clock.
    """

    def __init__(self, choices: Options, measure: Measure, ends_s: float) -> None:
        self._choices = choices
        self._measure = measure
        self._ends_s = ends_s
        self._table = OrderTable(choices)
        self._draw = random.Random(0)
        self._orders_left = MOST_ORDERS
        self.is_cut_off = False

    @property
    def is_over(self) -> bool:
        """Whether the budget or the time is used up."""
        self.is_cut_off |= self._orders_left > 0 and monotonic() > self._ends_s
        return self.is_cut_off or self._orders_left <= 0

    def numbers(self, stops: Stops) -> Whole:
        """An order as the table has it."""
        return self._table.order(stops)

    def changed(self, stops: Stops) -> Whole:
        """The order after a change at random: two parts exchanged, or a company greeted otherwise."""
        order, companies = self._table.order(stops), self._table.companies
        if companies and self._draw.random() < 0.5:
            return self._table.regrouped(order, self._draw.choice(companies))
        return double_bridge(order, self._draw)

    def cheaper(self, start: Whole, than: int) -> tuple[Stops, int] | None:
        """Where a descent ends, all measured, and its cost in cm; None where that is not less."""
        order, cost = self._descended(start)
        while cost < than:
            stops = self._table.stops(order)
            choices = self._measure(stops)
            if choices is None:
                return (stops, cost) if self._is_possible(order) else None
            if self.is_over:
                return None
            self._choices, self._table = choices, OrderTable(choices)
            order, cost = self._descended(order)
        return None

    def _descended(self, order: Whole) -> tuple[Whole, int]:
        """The order after moves that each make it cheaper, until there is none, and its cost in cm."""
        moves = all_moves(len(order))
        cost, first, in_vain = int(self._table.costs(order[None])[0]), 0, 0
        while in_vain < len(moves) and not self.is_over:
            orders = moved(order, moves[first : first + AT_ONCE])
            costs = self._table.costs(orders)
            cheapest = costs.argsort(kind="stable")[:MOST_CHECKED]
            better = (each for each in cheapest if costs[each] < cost and self._is_possible(orders[each]))
            best = next(better, None)
            if best is None:
                in_vain += len(orders)
            else:
                order, cost, in_vain = orders[best], int(costs[best]), 0
            self._orders_left -= len(orders)
            first = first + AT_ONCE if first + AT_ONCE < len(moves) else 0
        return order, cost

    def _is_possible(self, order: Whole) -> bool:
        """Whether deadlines hold in the cheapest way to make the visits, not just in the quickest."""
        if not self._choices.has_deadlines:
            return True
        return cost_of_order(self._table.stops(order), self._choices) is not None
