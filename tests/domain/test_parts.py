"""Between whom there are ways, where each can be reached from the start."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import PlanningFailed, Survey, make_plan, parts
from comity_domain.problem.spot import START

COUNT = 5


def cut(request, sides: list[int]):
    """The request without the ways between people on different sides."""
    side = {visitee.name: sides[i] for i, visitee in enumerate(request.visitees)}
    kept = {
        (start, end): way
        for (start, end), way in request.travel.items()
        if start == START or side[start.place] == side[end.place]
    }
    return replace(request, travel=kept), side


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.integers(0, 2), min_size=COUNT, max_size=COUNT), st.booleans())
def test_no_way_leads_from_one_part_to_another_and_the_largest_and_first_named_comes_first(
    random_request, sides: list[int], surveyed: bool
) -> None:
    """Also where only bounds are known, which tell of ways that turn out not to be there."""
    whole = random_request(COUNT, seed=1)
    request, side = cut(whole, sides)
    if surveyed:
        survey = Survey(frozenset(whole.travel), frozenset(), request.travel.get, lambda way: None)
        request = replace(whole, survey=survey)
    found = parts(request)
    names = [visitee.name for visitee in whole.visitees]
    assert sorted(name for part in found for name in part) == names
    assert {frozenset(part) for part in found} == {
        frozenset(name for name in names if side[name] == each) for each in set(sides)
    }
    assert [(-len(part), names.index(part[0])) for part in found] == sorted(
        (-len(part), names.index(part[0])) for part in found
    )


@pytest.mark.parametrize("seed", range(4))
def test_nobody_has_a_plan_for_two_parts(random_request, seed: int) -> None:
    request, _ = cut(random_request(4, seed), [0, 1, 0, 1])
    assert len(parts(request)) > 1
    with pytest.raises(PlanningFailed):
        make_plan(request)
