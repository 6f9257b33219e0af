"""Whether all deadlines can be kept is known for certain, and there is a plan wherever they can."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import permutations

import pytest

from comity_domain import Deadlines, NoPlan, PlanningFailed, make_plan
from comity_domain.choices.options import Options, options
from comity_domain.labelling.punctual import is_punctual, punctual
from comity_domain.labelling.search import first_look
from comity_domain.ordering.insertion import cost_of_order, quick_order
from comity_domain.ordering.local_search import improved
from comity_domain.tours.tour import Stop


def orders(choices: Options) -> Iterator[tuple[Stop, ...]]:
    """All orders of visits to people one by one."""
    return (tuple(map(Stop, names)) for names in permutations(choices.people))


@pytest.mark.parametrize("seed", range(30))
def test_all_deadlines_can_be_kept_just_where_some_order_keeps_them(rich_request, seed: int):
    """Durations are any, also such that a visit on the way makes the robot earlier."""
    request = rich_request(5, seed)
    choices = options(replace(request, companies=()))
    found = punctual(choices)
    some = any(is_punctual(order, choices) for order in orders(choices))
    assert found.sure
    assert not some or found.stops is not None
    if found.stops is not None and is_punctual(found.stops, choices):
        assert {stop.person for stop in found.stops} >= {
            name for name, person in choices.people.items() if person.by_s is not None
        }


@pytest.mark.parametrize("seed", range(20))
def test_where_no_order_is_said_to_keep_the_deadlines_no_engine_finds_one(rich_request, seed: int):
    request = rich_request(5, seed)
    if punctual(options(request)).stops is None:
        with pytest.raises(PlanningFailed):
            make_plan(request)


@pytest.mark.parametrize("seed", range(6))
def test_the_least_deadline_that_does_is_kept_and_a_second_less_is_not(hall, seed: int):
    request = hall(7, seed, spare_s=5.0)
    deadlines = Deadlines(request)
    name = max(deadlines.by_s, key=lambda name: deadlines.by_s[name])
    too_soon = {**deadlines.by_s, name: 5.0}
    assert deadlines.kept(too_soon) is False
    enough = deadlines.enough_s(name, too_soon)
    assert enough is not None
    assert deadlines.kept({**too_soon, name: enough})
    assert deadlines.kept({**too_soon, name: enough - 1}) is False


def test_there_is_a_plan_where_the_label_search_has_lost_all_that_keep_the_deadlines(hall):
    request = hall(25, 0, spare_s=60.0)
    assert first_look(options(request)) is None
    plan = make_plan(request)
    assert len({step.person for step in plan.steps}) == 25
    assert not plan.optimal
    assert 0 < plan.bound < plan.cost
    assert plan.reproducible, "no clock ended it"


@pytest.mark.parametrize("seed", range(4))
def test_an_order_at_once_serves_everybody_in_time_and_moves_keep_that(hall, seed: int):
    choices = options(hall(12, seed, spare_s=40.0))
    order = quick_order(choices)
    assert order is not None
    better, ended = improved(order, choices)
    assert ended
    for each in (order, better):
        assert {stop.person for stop in each} == set(choices.people)
        assert is_punctual(each, choices)
    before, after = cost_of_order(order, choices), cost_of_order(better, choices)
    assert before is not None
    assert after is not None
    assert after <= before


def test_where_there_is_no_time_to_look_for_an_order_it_is_not_known_whether_there_is_one(hall):
    request = hall(20, 1, spare_s=30.0)
    assert not punctual(options(request), ends_s=0.0).sure
    assert Deadlines(request).may_be_kept(Deadlines(request).by_s, ends_s=0.0)


def test_deadlines_that_no_order_keeps_are_a_certain_end_also_among_many(hall):
    request = hall(20, 1, spare_s=30.0)
    soon = {each.name for each in request.visitees if each.by_s is not None}
    tight = replace(
        request,
        visitees=tuple(replace(each, by_s=40.0) if each.name in soon else each for each in request.visitees),
    )
    with pytest.raises(NoPlan, match="no order of visits keeps every deadline"):
        make_plan(tight)
