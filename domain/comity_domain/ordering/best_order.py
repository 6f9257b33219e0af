"""The best order of the visits: by the exact search, or improved by moves where that proves nothing."""

from __future__ import annotations

from time import monotonic

from comity_domain.choices.options import Options
from comity_domain.labelling.search import cheapest_or_proof
from comity_domain.ordering.insertion import quick_order
from comity_domain.ordering.local_search import improved
from comity_domain.ordering.none_found import none_found, require_free_hands
from comity_domain.ordering.order import Order
from comity_domain.ordering.settling import LATE_S


def best_order(choices: Options, time_limit_s: float) -> Order:
    """The stops of the best plan that is found.

    Args:
        choices: What may be chosen.
        time_limit_s: Wall-clock seconds, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found; `cut_off` where the limit is the reason.
    """
    ends_s = monotonic() + time_limit_s
    found, proven = cheapest_or_proof(choices, ends_s=ends_s)
    if found is not None and found.exact:
        return Order(found.stops, proven=True, reproducible=True, bound=found.cost)
    stops, in_time = (found.stops, found.in_time) if found else (None, monotonic() <= ends_s)
    if choices.has_order and stops is not None:  # moves know of no order
        return Order(stops, proven=False, reproducible=in_time)
    if stops is None and not choices.has_order:
        require_free_hands(choices)
        stops = quick_order(choices, ends_s=ends_s + LATE_S)
        in_time = in_time and (stops is not None or monotonic() <= ends_s)
    if stops is None:
        raise none_found(time_limit_s, in_time=in_time, proven=proven)
    stops, ended = improved(stops, choices, ends_s=ends_s)
    return Order(stops, proven=False, reproducible=in_time and ended)
