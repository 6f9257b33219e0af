"""A request of which more and more is measured, order by order."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import count
from time import monotonic

from comity_domain.choices.options import Options, options
from comity_domain.labelling.punctual import is_punctual
from comity_domain.ordering.insertion import Stops, cost_of_order, quick_order
from comity_domain.problem.measuring import Unmeasured, measured, unmeasured_legs, unmeasured_ways
from comity_domain.problem.request import VisitRequest
from comity_domain.tours.lateness import until_last_deadline
from comity_domain.tours.tour import best_tour, path

MOST_FIRST = 3
"""Orders that are measured for the first plan, whatever the clock says: late is better than none."""


def measured_options(choices: Options, request: VisitRequest) -> Options:
    """Of what may be chosen for a request, that by measured ways alone."""
    if request.survey is None:
        return choices
    bounds = request.survey.legs
    return replace(choices, legs={leg: cost for leg, cost in choices.legs.items() if leg not in bounds})


class Measuring:
    """The request as far as it is measured.

    Args:
        request: As it was asked.
    """

    def __init__(self, request: VisitRequest) -> None:
        self.request = request
        self._spelt_out: tuple[VisitRequest, Options] | None = None

    @property
    def choices(self) -> Options:
        """What may be chosen now: spelt out once, until more is measured."""
        if self._spelt_out is None or self._spelt_out[0] is not self.request:
            self._spelt_out = (self.request, options(self.request))
        return self._spelt_out[1]

    @property
    def measured_choices(self) -> Options:
        """Of these, those by measured ways alone."""
        return measured_options(self.choices, self.request)

    def first_order(self, *, ends_s: float) -> tuple[Stops | None, bool]:
        """An order that is found at once, measured; None where there is none. And whether no clock decided.

        Args:
            ends_s: When no further order is tried, once `MOST_FIRST` were, by the machine's clock.
        """
        for turn in count():
            if turn >= MOST_FIRST and monotonic() > ends_s:
                return None, False
            stops = quick_order(self.choices, ends_s=ends_s)
            if stops is None:
                return None, monotonic() <= ends_s
            whole = self.is_measured(stops)
            if whole or self.cost(stops, self.measured_choices) is not None:
                return stops, True
        raise AssertionError

    def is_measured(self, stops: Stops, *, ends_s: float = math.inf) -> bool:
        """Whether all that an order takes is measured; what is not is now, as far as there is time.

        First what deadlines depend on, and no more where that makes a person late.

        Args:
            stops: An order with a route through it.
            ends_s: When measuring ends, by the machine's clock.
        """
        missing = self.missing(stops, self.choices)
        if missing.ways:
            self.request = measured(self.request, Unmeasured(ways=missing.ways), ends_s=ends_s)
            if not is_punctual(stops, self.choices):
                return False
        self.request = measured(self.request, Unmeasured(missing.legs), ends_s=ends_s)
        return not missing

    def news(self, stops: Stops, *, ends_s: float) -> Options | None:
        """What may be chosen once an order is measured; None where it was measured before.

        Args:
            stops: As above.
            ends_s: As above.
        """
        return None if self.is_measured(stops, ends_s=ends_s) else self.choices

    def cost(self, stops: Stops, choices: Options) -> int | None:
        """What an order costs; None where it takes what is not measured, or a person waits too long."""
        cost = cost_of_order(stops, choices)
        return None if cost is None or self.missing(stops, choices) else cost

    def missing(self, stops: Stops, choices: Options) -> Unmeasured:
        """What is not measured of what an order takes, and what its deadlines depend on."""
        visits = best_tour(stops, choices)
        legs = unmeasured_legs(self.request, path(visits, choices))
        ways = unmeasured_ways(self.request, path(until_last_deadline(visits, choices), choices))
        return replace(legs, ways=ways.ways)
