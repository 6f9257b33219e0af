"""What a plan would be like in another order: exactly what the best such plan costs, or who would be late."""

from __future__ import annotations

from dataclasses import replace
from itertools import count, islice, permutations

from comity_domain import in_order, kept_late, make_plan
from comity_domain.choices.options import options
from comity_domain.labelling.search import cheapest
from comity_domain.ordering.insertion import cost_of_order
from comity_domain.tours.tour import Stop


def test_another_order_along_a_corridor_costs_the_way_back(corridor):
    """Ada, bob and cem stand at 3, 6 and 9 m: cem, then ada, with bob between, is 6 m more."""
    request = corridor()
    other = in_order(request, make_plan(request), ("cem", "ada"))
    assert other is not None
    assert (other.extra_parts, other.extra_cost, other.too_late) == ({"travel": 600}, 600, None)
    assert other.people.index("cem") < other.people.index("ada")


def test_a_priority_is_a_part_of_what_another_order_costs(corridor):
    request = corridor(cem={"priority_m": 5.0})
    other = in_order(request, make_plan(request), ("ada", "bob", "cem"))
    assert other is not None
    assert other.extra_parts == {"waiting": 1000, "travel": -600}


def test_a_deadline_rules_another_order_out_though_it_would_be_cheaper(corridor):
    """Bob is 12 s away, ada half as far: with her greeting, who comes to him second is done at 20 s."""
    request = corridor(bob={"by_s": 16.0}, cem={"by_s": 500.0})
    other = in_order(request, make_plan(request), ("ada", "bob"))
    assert other is not None
    assert str(other.too_late) == "bob would be greeted at 20.0 s, later than 16 s"
    assert other.people == ("ada", "bob", "cem")
    assert other.extra_cost == -600


def test_lateness_is_told_with_the_digits_that_show_it(corridor):
    request = corridor(bob={"by_s": 19.99})
    other = in_order(request, make_plan(request), ("ada", "bob"))
    assert other is not None
    assert str(other.too_late) == "bob would be greeted at 20.0 s, later than 19.99 s"
    assert other.too_late is not None
    close = replace(other.too_late, greeted_s=20.004, by_s=20.0)
    assert str(close) == "bob would be greeted at 20.004 s, later than 20 s"


def six_with_a_plan(of_seed):
    """Of four people each, all of whom can be reached, and in time."""
    requests = (of_seed(4, seed) for seed in count())
    return islice((request for request in requests if cheapest(options(request)) is not None), 6)


def test_no_order_of_all_people_that_begins_otherwise_costs_less(random_request):
    """Held against all orders of four: the best that has the last two the other way round."""
    for request in six_with_a_plan(random_request):
        choices, plan = options(request), make_plan(request)
        names = [step.person for step in plan.steps if step.action == "Reach_user"]
        wanted = (names[-1], names[-2])
        costs = (
            cost_of_order(tuple(map(Stop, each)), choices)
            for each in permutations(names)
            if in_turn(each, wanted)
        )
        known = [cost for cost in costs if cost is not None]
        other = in_order(request, plan, wanted)
        assert (other.extra_cost + plan.cost if other else None) == min(known, default=None)


def in_turn(names, wanted) -> bool:
    return [name for name in names if name in wanted] == list(wanted)


def test_the_planned_order_costs_nothing_more_whatever_else_is_asked(rich_request):
    for request in six_with_a_plan(rich_request):
        plan = make_plan(request)
        names = tuple(step.person for step in plan.steps if step.action == "Reach_user")
        other = in_order(request, plan, names)
        assert other is not None
        assert (other.extra_cost, other.too_late) == (0, None)


def test_choices_that_were_in_time_are_late_once_a_deadline_is_sooner(corridor):
    before = corridor()
    plan = make_plan(before)
    assert kept_late(plan, before) is None
    sooner = corridor(cem={"by_s": 25.0})
    found = kept_late(plan, sooner)
    assert found is not None
    assert found.person == "cem"
    assert str(found.after(100.0)) == "cem would be greeted at 130.0 s, later than 125 s"
