"""Rebinding gives what planning anew would give, or says that it cannot."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from comity_domain import PlanningFailed, Visitee, VisitRequest, make_plan, rebind

PEOPLE = 3


def changed(request: VisitRequest, draw: random.Random, infer, flat) -> VisitRequest:
    """Somebody moved a little or far, or their values changed a little or altogether."""
    amount = draw.choice((0.0, 0.01, 0.3, 3.0))
    travel = {leg: max(0.0, metres + draw.uniform(-amount, amount)) for leg, metres in request.travel.items()}
    visitees = list(request.visitees)
    if draw.random() < 0.7:
        at = draw.randrange(len(visitees))
        values = infer(curve=flat(draw.random(), draw.random()), modality=draw.choice(("verbal", "both")))
        visitees[at] = Visitee(visitees[at].name, values)
    return replace(request, travel=travel, visitees=tuple(visitees))


@pytest.fixture
def cases(random_request, infer, line):
    """Plans, each with the request as it is after a change."""

    def flat(front: float, beside: float):
        return line(((0.0, front), (22.4, front), (22.5, beside), (90.0, beside)))

    found = []
    for seed in range(8):
        before = random_request(PEOPLE, seed)
        try:
            plan = make_plan(before)
        except PlanningFailed:
            continue
        draw = random.Random(seed)
        found += [(plan, changed(before, draw, infer, flat)) for _ in range(4)]
    return found


def test_rebinding_gives_what_planning_anew_gives_or_says_that_it_cannot(cases):
    """Kept: the same cost, the same choices, the new numbers. Given up: planning anew chooses otherwise."""
    kept = 0
    for plan, request in cases:
        rebound = rebind(plan, request)
        try:
            anew = make_plan(request)
        except PlanningFailed:
            assert rebound is None
            continue
        choices = [step.arguments for step in plan.steps]
        if rebound is None:
            assert [step.arguments for step in anew.steps] != choices
            continue
        kept += 1
        assert (rebound.cost, rebound.optimal) == (anew.cost, True)
        assert [step.arguments for step in rebound.steps] == choices
        values = {visitee.name: visitee.values for visitee in request.visitees}
        for step in rebound.steps:
            for name in ("conversational_distance", "approach_speed"):
                assert step.parameters.get(name) in (None, values[step.person][name].value)
    assert 0 < kept < len(cases)


def test_nothing_changed_rebinds_to_the_same_plan(random_request):
    request = random_request(PEOPLE, 5)
    plan = make_plan(request)
    assert rebind(plan, request) == plan


def test_other_people_need_another_plan(random_request):
    request = random_request(PEOPLE, 5)
    plan = make_plan(request)
    fewer = replace(request, visitees=request.visitees[1:])
    assert rebind(plan, fewer) is None
