"""Where only bounds of the ways are known at first, the plan is as cheap as with everything measured."""

from __future__ import annotations

import random
import sys
from collections.abc import Callable
from dataclasses import replace

import pytest

from comity_domain import (
    START,
    PlanningFailed,
    Survey,
    flips,
    kept_cost,
    make_plan,
    next_instead,
    plan_pddl,
    rebind,
    visits_of,
)
from comity_domain.ordering import settling


class Surveyor:
    """Knows the true lengths of a request, and hands out bounds; it notes what it was asked."""

    def __init__(self, request, seed: int, shares: tuple[float, ...] = (0.4, 0.9, 1.0)) -> None:
        self.true = request
        self.shares = shares
        self.rng = random.Random(seed)
        self.asked = []

    def lazy(self):
        """The request with bounds: some legs have none but the bound, as no route turns out to be there."""
        bounds = {leg: length * self.rng.choice(self.shares) for leg, length in self.true.travel.items()}
        survey = Survey(frozenset(bounds), frozenset(self.true.durations_s), self.leg_m, self.way)
        durations = {way: s * self.rng.choice(self.shares) for way, s in self.true.durations_s.items()}
        return replace(self.true, travel=bounds, durations_s=durations, survey=survey)

    def leg_m(self, leg):
        self.asked.append(leg)
        return self.true.travel[leg]

    def way(self, way):
        self.asked.append(way)
        return self.true.ways_m.get(way, 1.0), self.true.durations_s[way]


def numbers(plan):
    return plan.cost, plan.optimal, plan.bound


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("rich", [False, True])
def test_a_plan_with_bounds_costs_what_the_measured_one_costs_and_is_proven(
    random_request, rich_request, seed: int, rich: bool
):
    """Every leg that the plan takes is measured: its steps cost what the true ways cost."""
    request = rich_request(5, seed) if rich else random_request(5, seed)
    lazy = Surveyor(request, seed).lazy()
    try:
        expected = make_plan(request)
    except PlanningFailed:
        with pytest.raises(PlanningFailed):
            make_plan(lazy)
        return
    plan = make_plan(lazy)
    assert numbers(plan) == numbers(expected)
    assert kept_cost(plan, request) == plan.cost


def test_only_some_of_many_ways_are_measured(random_request):
    surveyor = Surveyor(random_request(9, seed=3), seed=3)
    assert make_plan(surveyor.lazy()).optimal
    assert 0 < len(surveyor.asked) < len(surveyor.true.travel) / 2


@pytest.mark.parametrize("seed", range(6))
def test_where_time_is_over_before_any_plan_is_whole_one_is_made_whole(rich_request, monkeypatch, seed: int):
    """With measured ways, deadlines hold that held with bounds, or other orders keep them."""
    request = rich_request(5, seed)
    monkeypatch.setattr(settling._Settling, "_look_ahead", lambda _: False)
    plan = make_plan(Surveyor(request, seed).lazy(), time_limit_s=60.0)
    assert kept_cost(plan, request) == plan.cost
    assert not plan.reproducible


def test_what_other_sides_would_cost_is_measured_too(random_request):
    request = random_request(4, seed=5)
    plan, expected = make_plan(Surveyor(request, seed=5).lazy()), make_plan(request)
    assert [step.arguments for step in plan.steps] == [step.arguments for step in expected.steps]
    assert [step.why for step in plan.steps] == [step.why for step in expected.steps]


@pytest.mark.parametrize("seed", range(6))
def test_what_a_group_met_otherwise_would_cost_is_measured_too(rich_request, seed: int):
    request = rich_request(4, seed, deadlines=False)
    plan, expected = make_plan(Surveyor(request, seed).lazy()), make_plan(request)
    whys = [
        {step.arguments: step.why for step in each.steps if step.action == "Greet_company"}
        for each in (plan, expected)
    ]
    assert plan.cost == expected.cost
    if visits_of(plan) == visits_of(expected):
        assert whys[0] == whys[1]


@pytest.mark.parametrize("seed", range(4))
def test_questions_about_a_plan_are_answered_as_if_all_were_measured(random_request, seed: int):
    request = random_request(4, seed)
    lazy, plan = Surveyor(request, seed).lazy(), make_plan(request)
    assert next_instead(lazy, plan, 0) == next_instead(request, plan, 0)
    assert flips(lazy, plan) == flips(request, plan)
    assert plan_pddl(lazy) == plan_pddl(request)
    assert kept_cost(plan, lazy) == kept_cost(plan, request)


@pytest.mark.parametrize("seed", range(6))
def test_groups_priorities_and_deadlines_change_nothing_about_that(rich_request, seed: int):
    request = rich_request(5, seed)
    try:
        plan = make_plan(request)
    except PlanningFailed:
        return
    lazy, stops = Surveyor(request, seed).lazy(), len(visits_of(plan))
    for stop in range(stops):
        assert next_instead(lazy, plan, stop) == next_instead(request, plan, stop)
    assert [flip.factor for flip in flips(lazy, plan)] == [flip.factor for flip in flips(request, plan)]


def test_questions_about_one_step_and_about_the_weights_measure_some_ways_only(random_request):
    request = random_request(8, seed=3)
    plan = make_plan(request)
    for question in (lambda lazy: next_instead(lazy, plan, 4), lambda lazy: flips(lazy, plan)):
        surveyor = Surveyor(request, seed=3)
        question(surveyor.lazy())
        assert 0 < len(surveyor.asked) < len(request.travel) / 2


@pytest.mark.parametrize("seed", range(6))
def test_a_plan_is_rebound_where_it_would_be_with_all_measured(random_request, seed: int):
    before = random_request(4, seed)
    rng = random.Random(seed)
    travel = {leg: max(0.0, metres + rng.uniform(-0.5, 0.5)) for leg, metres in before.travel.items()}
    after, plan = replace(before, travel=travel), make_plan(before)
    lazy, expected = rebind(plan, Surveyor(after, seed).lazy()), rebind(plan, after)
    assert (lazy is None) == (expected is None)
    assert expected is None or lazy.steps == expected.steps


def go_by(monkeypatch, clock: Callable[[], float]) -> None:
    """Let all that keeps the time limit look at another clock."""
    for name, module in list(sys.modules.items()):
        if name.startswith("comity_domain.") and hasattr(module, "monotonic"):
            monkeypatch.setattr(module, "monotonic", clock)


@pytest.mark.parametrize("limit_s", [12.0, 40.0])
def test_when_time_is_up_there_is_a_measured_plan_with_a_bound_that_holds(
    random_request, monkeypatch, limit_s: float
):
    """By a clock that goes on by a second with every leg that is measured."""
    request = random_request(9, seed=1)
    surveyor = Surveyor(request, seed=1)
    go_by(monkeypatch, lambda: float(len(surveyor.asked)))
    plan, best = make_plan(surveyor.lazy(), time_limit_s=limit_s), make_plan(request)
    assert plan.bound <= best.cost <= plan.cost
    assert kept_cost(plan, request) == plan.cost, "what it takes is measured"
    assert not plan.reproducible
    assert len(surveyor.asked) <= limit_s + settling.LATE_S + 1, "no round of measuring goes on after that"


@pytest.mark.parametrize("limit_s", [1.0, 5.0])
def test_a_first_plan_is_measured_to_its_end_although_time_is_over(
    random_request, monkeypatch, limit_s: float
):
    """Its nine legs take nine of these seconds."""
    request = random_request(9, seed=1)
    surveyor = Surveyor(request, seed=1)
    go_by(monkeypatch, lambda: float(len(surveyor.asked)))
    plan = make_plan(surveyor.lazy(), time_limit_s=limit_s)
    assert kept_cost(plan, request) == plan.cost
    assert not plan.reproducible
    assert len(surveyor.asked) <= limit_s + len(request.visitees) + 1


def test_where_no_order_stands_and_time_is_over_that_is_said_with_a_remedy(random_request, monkeypatch):
    """No route leads from anybody to anybody, which is found out leg by leg."""
    surveyor = Surveyor(random_request(9, seed=1), seed=1)
    monkeypatch.setattr(surveyor, "leg_m", lambda leg: surveyor.asked.append(leg) if leg[0] != START else 1.0)
    go_by(monkeypatch, lambda: float(len(surveyor.asked)))
    with pytest.raises(PlanningFailed, match=r"within 5 s\. Allow more time") as failed:
        make_plan(surveyor.lazy(), time_limit_s=5.0)
    assert failed.value.cut_off


@pytest.mark.parametrize("seed", range(4))
def test_among_many_people_an_order_that_is_found_at_once_is_measured_first(hall, monkeypatch, seed: int):
    """Time for hardly more than one plan's ways is enough for a plan, with its gap."""
    request = hall(20, seed, spare_s=200.0)
    surveyor = Surveyor(request, seed, shares=(0.95, 1.0))
    go_by(monkeypatch, lambda: float(len(surveyor.asked)))
    plan = make_plan(surveyor.lazy(), time_limit_s=2.5 * len(request.visitees))
    assert kept_cost(plan, request) == plan.cost
    assert 0 < plan.bound < plan.cost


@pytest.mark.parametrize("seed", range(6))
def test_a_plan_whose_only_deadline_is_soon_is_the_cheapest_although_later_ways_stay_bounds(hall, seed: int):
    request = hall(8, seed, spare_s=300.0)
    first = request.visitees[0].name
    visitees = tuple(
        replace(each, by_s=request.durations_s[None, first] + 60.0 if each.name == first else None)
        for each in request.visitees
    )
    request = replace(request, visitees=visitees)
    surveyor = Surveyor(request, seed)
    plan = make_plan(surveyor.lazy())
    assert numbers(plan) == numbers(make_plan(request))
