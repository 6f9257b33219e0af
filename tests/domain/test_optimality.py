"""Plans cost what an independent Held-Karp over persons and sides says they must."""

from __future__ import annotations

import math

import pytest

from comity_domain import START, PlanningFailed, Spot, greetings, make_plan, sides


def least_cost(request) -> int | None:
    """Dynamic programming over (whom was visited, where the robot is); None where nobody can visit all."""
    people = {visitee.name: visitee.values for visitee in request.visitees}

    def price(desirability, weight_m):
        return round(-100 * weight_m * math.log(max(desirability, 0.01)))

    best = {(frozenset(), START): 0}
    for _ in people:
        longer = {}
        for (visited, here), cost in best.items():
            for name in people.keys() - visited:
                for side in sides(people[name]).values():
                    there = Spot(name, side.name)
                    if (here, there) in request.travel:
                        leg = round(100 * request.travel[here, there])
                        total = cost + leg + price(side.desirability, request.weights.side_m)
                        state = (visited | {name}, there)
                        longer[state] = min(total, longer.get(state, total))
        best = longer
    if not best:
        return None
    greets = [
        min(price(g.desirability, request.weights.greeting_m) for g in greetings(v)) for v in people.values()
    ]
    return min(best.values()) + sum(greets)


@pytest.mark.parametrize("seed", range(12))
def test_the_plan_is_as_cheap_as_dynamic_programming_finds(random_request, seed):
    request = random_request(1 + seed % 6, seed)
    plan = make_plan(request)
    assert plan.optimal
    assert plan.cost == least_cost(request) == sum(step.cost for step in plan.steps)
    people = [step.person for step in plan.steps if step.action == "Reach_user"]
    assert sorted(people) == sorted(visitee.name for visitee in request.visitees)


def test_where_dynamic_programming_finds_nothing_planning_fails(infer, request_for):
    """Both can be reached from the start, but neither from the other."""
    travel = {(START, Spot(name, "front")): 1.0 for name in ("ada", "bob")}
    request = request_for({"ada": infer(), "bob": infer()}, travel)
    assert least_cost(request) is None
    with pytest.raises(PlanningFailed, match="no plan reaches all goals"):
        make_plan(request)
