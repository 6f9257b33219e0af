"""The contrast plan of a side is the best plan with that side: never dearer than with the rest as it is."""

from __future__ import annotations

from dataclasses import replace

import pytest

from comity_domain import NoPlan, from_other_sides, make_plan


@pytest.mark.parametrize("seed", range(8))
def test_planned_anew_a_side_costs_no_more_than_with_the_rest_as_it_is(rich_request, seed):
    request = rich_request(2 + seed % 3, seed)
    try:
        plan = make_plan(request)
    except NoPlan:
        pytest.skip("its deadlines allow no plan")
    for step in (step for step in plan.steps if step.action == "Reach_user"):
        fixed = {other.arguments[-1]: other.extra_cost for other in step.why.alternatives}
        contrasts = from_other_sides(request, plan, step.person, fixed)
        assert {one.side for one in contrasts} == set(fixed)
        for one in contrasts:
            assert one.plan is not None
            assert 0 <= one.extra_cost <= fixed[one.side]
            assert one.plan.cost - plan.cost == one.extra_cost
            reached = {
                each.arguments[2]
                for each in one.plan.steps
                if each.action == "Reach_user" and each.person == step.person
            }
            assert reached <= {one.side}


def test_those_whose_visit_is_dropped_cost_a_contrast_nothing(rich_request):
    """They are in neither plan that is compared."""
    request = rich_request(2, 1, deadlines=False)
    dropping = replace(request, dropped_m={"dora": 3.0})
    one, other = (
        from_other_sides(each, make_plan(each), request.visitees[0].name, ["left", "right"])
        for each in (request, dropping)
    )
    assert [each.extra_cost for each in one] == [each.extra_cost for each in other]


def test_where_nothing_leads_to_a_side_there_is_no_contrast_plan(infer, request_for):
    request = request_for({"johanna": infer()})
    (nowhere,) = from_other_sides(request, make_plan(request), "johanna", ["behind"])
    assert (nowhere.plan, nowhere.extra_cost) == (None, None)
