"""Plans cost what an independent dynamic program over persons and sides says they must."""

from __future__ import annotations

import math
from itertools import permutations

import pytest
from downward import cost_by_fast_downward, needs_fast_downward
from pareto import pareto

from comity_domain import START, NoPlan, PlanningFailed, Spot, greetings, make_plan, sides
from comity_domain.choices.options import options
from comity_domain.labelling.search import cheapest
from tests.domain.conftest import price

GREETING_S = 4.0


class Reference:
    """Dynamic programming over (who was greeted, where the robot is), with all pairs of cost and time."""

    def __init__(self, request):
        self.request = request
        self.people = {visitee.name: visitee for visitee in request.visitees}

    def least_cost(self) -> int | None:
        """None where nobody can visit all of them in time."""
        front = {(frozenset(), START): {(0, 0.0)}}
        finished = []
        while front:
            longer = {}
            for (greeted, here), ways in front.items():
                if len(greeted) == len(self.people):
                    finished += ways
                    continue
                for people, there, cost in self.stops(greeted):
                    leg = self.leg(here, there)
                    if leg is None:
                        continue
                    seconds = (
                        self.request.durations_s.get(
                            (None if here == START else here.place, there.place), 0.0
                        )
                        + GREETING_S
                    )
                    state = (greeted | people, there)
                    for way_cost, way_s in ways:
                        if all(way_s + seconds <= self.by_s(name) for name in people):
                            longer.setdefault(state, set()).add((way_cost + leg + cost, way_s + seconds))
            front = {state: pareto(ways) for state, ways in longer.items()}
        return min((cost for cost, _ in finished), default=None)

    def stops(self, greeted):
        """Whom the next stop greets, where, and what their greeting costs."""
        for name, visitee in self.people.items():
            if name not in greeted:
                own = min(self.greets(name).values()) + self.waiting([name], greeted)
                for side in sides(visitee.values):
                    yield frozenset([name]), Spot(name, side), own
        for company in self.request.companies:
            if greeted & set(company.members):
                continue
            accepted = [self.greets(name) for name in company.members]
            common = [max(prices[way] for prices in accepted) for way in accepted[0] if in_all(way, accepted)]
            for spot, nearness in company.overlooks.items() if common else ():
                near = sum(self.too_near(name, distance) for name, distance in nearness.items())
                waiting = self.waiting(company.members, greeted)
                yield frozenset(company.members), spot, min(common) + near + waiting

    def greets(self, name):
        visitee, weight_m = self.people[name], self.request.weights.greeting_m
        return {
            (g.modality, g.gesture): price(g.desirability, weight_m)
            for g in greetings(visitee.values, visitee.now)
        }

    def too_near(self, name, distance_m):
        wanted = self.people[name].values["conversational_distance"]
        if distance_m >= wanted.number:
            return 0
        return price(wanted.desirability(distance_m), self.request.weights.side_m)

    def waiting(self, names, greeted):
        return len(greeted) * sum(round(100 * self.people[name].priority_m) for name in names)

    def leg(self, here, there):
        if (here, there) not in self.request.travel:
            return None
        side = sides(self.people[there.place].values)[there.side]
        return round(100 * self.request.travel[here, there]) + price(
            side.desirability, self.request.weights.side_m
        )

    def by_s(self, name):
        by_s = self.people[name].by_s
        return math.inf if by_s is None else by_s


def in_all(way, accepted):
    return all(way in prices for prices in accepted)


def least_cost(request) -> int | None:
    return Reference(request).least_cost()


@pytest.mark.parametrize("seed", range(12))
def test_the_plan_is_as_cheap_as_dynamic_programming_finds(random_request, seed):
    request = random_request(1 + seed % 6, seed)
    plan = make_plan(request)
    assert plan.optimal
    assert plan.engine == "comity"
    assert plan.cost == plan.bound == least_cost(request) == sum(step.cost for step in plan.steps)
    people = [step.person for step in plan.steps if step.action == "Reach_user"]
    assert sorted(people) == sorted(visitee.name for visitee in request.visitees)


@pytest.mark.parametrize("seed", range(40))
def test_the_label_search_is_as_cheap_with_companies_priorities_and_deadlines(rich_request, seed):
    """Or finds nothing, where the reference finds nothing."""
    request = rich_request(1 + seed % 6, seed)
    found, least = cheapest(options(request)), least_cost(request)
    assert (found and found.cost) == least
    if least is None:
        with pytest.raises(PlanningFailed, match="keeps every deadline"):
            make_plan(request)
    else:
        plan = make_plan(request)
        assert plan.optimal
        assert plan.cost == least
        assert sorted(name for step in plan.steps[1::2] for name in step.people) == sorted(
            visitee.name for visitee in request.visitees
        )


@needs_fast_downward
@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("groups", [False, True])
def test_fast_downward_finds_the_same_cost(random_request, rich_request, seed, groups):
    """Or none, where there is no plan."""
    people = 1 + seed % 5
    request = rich_request(people, seed, deadlines=False) if groups else random_request(people, seed)
    try:
        cost = make_plan(request).cost
    except NoPlan:
        cost = None
    assert cost_by_fast_downward(request) == cost


def replace_all(request, **changes):
    from dataclasses import replace

    return replace(request, visitees=tuple(replace(visitee, **changes) for visitee in request.visitees))


@pytest.mark.study
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("deadlines", [False, True])
def test_twelve_people_are_planned_optimally(rich_request, seed, deadlines):
    request = rich_request(12, seed, deadlines=deadlines)
    found = cheapest(options(request))
    assert found is None or found.exact
    assert (found and found.cost) == least_cost(request)


@pytest.mark.parametrize("seed", range(3))
def test_no_order_at_all_is_cheaper(rich_request, seed):
    """The reference itself, held against every permutation of few people."""
    request = replace_all(rich_request(4, seed, deadlines=False), priority_m=2.0)
    reference = Reference(request)
    costs = []
    for order in permutations(reference.people):
        ways = {START: 0}
        for index, name in enumerate(order):
            longer = {}
            for side in sides(reference.people[name].values):
                spot = Spot(name, side)
                arrivals = [c + leg for h, c in ways.items() if (leg := reference.leg(h, spot)) is not None]
                if arrivals:
                    longer[spot] = min(arrivals) + reference.waiting([name], order[:index])
            ways = longer
        costs += [cost + sum(min(reference.greets(n).values()) for n in order) for cost in ways.values()]
    from dataclasses import replace

    assert Reference(replace(request, companies=())).least_cost() == min(costs, default=None)


def test_where_dynamic_programming_finds_nothing_planning_fails(infer, request_for):
    """Both can be reached from the start, but neither from the other."""
    travel = {(START, Spot(name, "front")): 1.0 for name in ("ada", "bob")}
    request = request_for({"ada": infer(), "bob": infer()}, travel)
    assert least_cost(request) is None
    with pytest.raises(NoPlan, match="no plan reaches all goals"):
        make_plan(request)


def test_beyond_the_limit_a_plan_comes_with_a_bound(rich_request):
    """The search is given no time to prove anything for 16 people: the gap is stated and true."""
    request = replace_all(rich_request(16, 1, deadlines=False), priority_m=0.0)
    plan = make_plan(request, time_limit_s=0.1)
    assert not plan.optimal
    assert 0 < plan.bound <= plan.cost
    assert plan.gap == pytest.approx(1 - plan.bound / plan.cost)
