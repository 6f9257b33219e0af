"""From a request to a plan: the order by an engine, each step with full precision and its reasons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import monotonic

from comity_domain.choices.options import Options
from comity_domain.classical.engine import ENGINE, MEMORY_MB, ground_actions, search
from comity_domain.classical.initial_state import order_key, visit_names
from comity_domain.classical.pddl import domain_pddl, problem_pddl
from comity_domain.errors import PlanningFailed, out_of_time
from comity_domain.explanation.around import options_around
from comity_domain.labelling.search import LABELS, MOST_PROVEN, cheapest
from comity_domain.labelling.skipping import SKIP, leaving, skip_steps
from comity_domain.ordering.few_orders import only_cheapest
from comity_domain.ordering.insertion import improved, quick_order
from comity_domain.ordering.order import Order, Orders
from comity_domain.ordering.settling import LATE_S, measured_options, settled
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.request import VisitRequest
from comity_domain.steps import steps_of
from comity_domain.tours.bound import lower_bound
from comity_domain.tours.tour import Stop, best_tour, tour_cost


def make_plan(
    request: VisitRequest,
    *,
    time_limit_s: float = 30.0,
    memory_mb: int = MEMORY_MB,
    orders: Orders | None = None,
) -> Plan:
    """The cheapest way to visit and greet everybody, but those who are left out at their price.

    Args:
        request: People that cannot be reached on any side they accept have been left out of it.
        time_limit_s: Wall-clock seconds for the engines, and for measuring what is not measured, > 0. Where
            they do not suffice for the proof, the plan is the best found so far, neither `optimal` nor
            `reproducible`. Only where there is none it may be a second more. What else there was is measured
            when the reasons are read, which may take as long again.
        memory_mb: Megabytes for the engine, > 0; the same holds.
        orders: Where proven orders of the same request are looked up and kept; with it, few visits with one
            cheapest order are planned without an engine. The plan is the same. None: an engine searches.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found; `cut_off` where a limit is the reason.
        ValueError: The request holds a person whom no plan can serve.
    """
    if not time_limit_s > 0.0:
        raise ValueError(f"the time limit must be positive, got {time_limit_s!r} s")
    ends_s = monotonic() + time_limit_s
    left = leaving(request, ends_s=ends_s - time_limit_s / 2)
    served = request.without(left.names) if left.names else request
    engines = _Engines(memory_mb, orders)
    found = settled(served, engines.order, time_limit_s=time_limit_s, ends_s=ends_s)
    bounded, choices = found.choices, measured_options(found.choices, found.request)
    visits = best_tour(found.order.stops, choices)
    in_time = left.in_time and monotonic() <= ends_s
    around = options_around(found.request, visits) if in_time else lambda: bounded
    steps = (*steps_of(visits, choices, around), *skip_steps(request, left.names))
    return _plan(found.order, steps, bounded, reproducible=in_time)


def _plan(order: Order, steps: Sequence[PlanStep], bounded: Options, *, reproducible: bool) -> Plan:
    """The plan with what none can cost less than: by ways that are measured, or bounds where they are not."""
    cost = sum(step.cost for step in steps)
    bound = cost
    if not order.proven:
        skipped = sum(step.cost for step in steps if step.action == SKIP)
        bound = min(cost, max(order.bound, lower_bound(bounded)) + skipped)
    return Plan(
        order.engine,
        optimal=bound == cost,
        reproducible=order.reproducible and reproducible,
        cost=cost,
        bound=bound,
        steps=tuple(steps),
        killed=order.killed,
    )


@dataclass(frozen=True, slots=True)
class _Engines:
    """All engines, with what was found earlier."""

    memory_mb: int
    orders: Orders | None

    def order(self, choices: Options, time_limit_s: float) -> Order:
        """The stops of the best plan."""
        orders = None if choices.under_way else self.orders  # no such request comes twice
        found = _recalled(choices, orders) if orders else None
        if found is None:
            found = _order(choices, time_limit_s, self.memory_mb)
            if orders and found.proven and found.reproducible:
                orders.keep(order_key(choices), found)
        return found


def _recalled(choices: Options, orders: Orders) -> Order | None:
    return only_cheapest(choices) or orders.recall(order_key(choices))


def _order(choices: Options, time_limit_s: float, memory_mb: int) -> Order:
    """The stops of the best plan."""
    if not choices.people:
        return Order(ENGINE, (), True, True)  # nothing to do is a plan, not a failure
    if choices.has_deadlines or choices.has_priorities or choices.under_way:
        return _by_labels(choices, time_limit_s)
    if len(choices.people) <= MOST_PROVEN:
        return _by_engine(choices, time_limit_s, memory_mb)
    return _by_both(choices, time_limit_s, memory_mb)


def _by_engine(choices: Options, time_limit_s: float, memory_mb: int) -> Order:
    names = visit_names(choices)
    pddl = domain_pddl(), problem_pddl(choices, names)
    found = search(*pddl, time_limit_s=time_limit_s, memory_mb=memory_mb)
    stops: list[Stop] = []
    for name, _, *arguments in ground_actions(found.text):
        if name == "reach_user":
            stops.append(Stop(names.name(arguments[0])))
        elif name == "greet_company":
            stops[-1] = Stop(stops[-1].person, names.name(arguments[0]))
    return Order(ENGINE, tuple(stops), found.finished, found.finished, found.bound, found.killed)


def _by_labels(choices: Options, time_limit_s: float) -> Order:
    """By the label search; where it proves nothing, made better by moving single stops."""
    ends_s = monotonic() + time_limit_s
    found = cheapest(choices, ends_s=ends_s)
    if found is not None and found.exact:
        return Order(LABELS, found.stops, proven=True, reproducible=True, bound=found.cost)
    stops, in_time = (found.stops, found.in_time) if found else (None, monotonic() <= ends_s)
    if stops is None:
        _require_free_hands(choices)
        stops = quick_order(choices, ends_s=ends_s + LATE_S)
        in_time = in_time and (stops is not None or monotonic() <= ends_s)
    if stops is None:
        raise _none_found(time_limit_s, in_time=in_time)
    stops, ended = improved(stops, choices, ends_s=ends_s)
    return Order(LABELS, stops, proven=False, reproducible=in_time and ended)


def _none_found(time_limit_s: float, *, in_time: bool) -> PlanningFailed:
    if not in_time:
        return out_of_time(time_limit_s)
    return PlanningFailed(
        "no order of visits was found that keeps every deadline and has a route to each next person, which "
        "does not prove that there is none",
        remedy="Name later deadlines, or look at the map for a person who is cut off from the others.",
    )


def _require_free_hands(choices: Options) -> None:
    """Say so where somebody can only be greeted with the hands, and these are full."""
    bearer = choices.people.get(choices.bearer_of or "")
    if bearer is not None and not bearer.may_come_bringing:
        against = (bearer.ruled_out_bringing or {}).items()
        reasons = "; ".join(f"{greeting.words}: {reason}" for greeting, reason in against)
        raise PlanningFailed(
            f"no greeting of {bearer.name} is left with what they are offered in the hands ({reasons})",
            remedy="Let them be greeted in words, or with a nod, or hand over what the robot holds first.",
        )


def _by_both(choices: Options, time_limit_s: float, memory_mb: int) -> Order:
    """The cheaper one of the two, where the engine alone can hardly prove anything."""
    ends_s = monotonic() + time_limit_s
    labels = _by_labels(choices, time_limit_s)
    left_s = ends_s - monotonic()
    if labels.proven:
        return labels
    if left_s <= 0.0:
        return replace(labels, reproducible=False)
    try:
        engine = _by_engine(choices, left_s, memory_mb)
    except PlanningFailed:
        return replace(labels, reproducible=False)
    cost = {order: tour_cost(best_tour(order.stops, choices), choices) or 0 for order in (engine, labels)}
    best = min(cost, key=lambda order: cost[order])
    return replace(
        best,
        proven=engine.proven,
        reproducible=engine.proven,
        bound=engine.bound,
        killed=engine.killed,
    )
