"""The law of ties: of plans that cost the same, which one is made.

Higher desirability, then the neutral value, then the scenario's order, then front, left, right, then the
name.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from itertools import permutations, product

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import (
    START,
    Circumstances,
    Company,
    Spot,
    Visitee,
    VisitRequest,
    Weights,
    greetings,
    make_plan,
    sides,
    visits_of,
)
from comity_domain.choices.options import options
from comity_domain.tours.tour import Stay, Stop, best_tour, served, tie_break, tour_cost
from tests.domain.conftest import price

SIDES = ("front", "left", "right")
LAW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=80, deadline=None)
degrees = st.sampled_from([0.0, 0.5, 0.999, 1.0])
metres = st.sampled_from([2.0, 2.0, 2.0, 2.5])


@st.composite
def requests(draw, infer, line):
    """Up to three people and few different numbers, so that many plans cost the same."""
    names = draw(st.permutations(["ann", "bob", "cem"]))[: draw(st.integers(1, 3))]
    visitees = []
    for name in names:
        ahead, beside = draw(degrees), draw(degrees)
        modalities = {word: draw(degrees) for word in ("both", "gestural", "verbal")}
        gestures = {word: draw(degrees) for word in draw(st.permutations(["bow", "nod", "wave"]))}
        values = infer(
            direction=draw(st.sampled_from([0.0, 45.0])),
            curve=line(((0.0, ahead), (22.4, ahead), (22.6, beside), (90.0, beside))),
            modality=max(modalities, key=lambda word: modalities[word]),
            modalities=modalities,
            gesture=max(gestures, key=lambda word: gestures[word]),
            gestures=gestures,
        )
        visitees.append(Visitee(name, values))
    spots = [Spot(name, side) for name in names for side in SIDES]
    travel = {
        (a, b): draw(metres) for a in (START, *spots) for b in spots if a == START or a.place != b.place
    }
    weights = Weights(side_m=draw(st.sampled_from([0.0, 1.0])), greeting_m=draw(st.sampled_from([0.0, 1.0])))
    return VisitRequest("robot", tuple(visitees), travel, weights)


def lacks(desirability):
    """In millionths: what differs by less is rounding."""
    return round(1e6 * (1.0 - desirability))


def greeting_of(visitee, weight_m):
    """The greeting of a person: its price, what it lacks, its departures, and its words."""
    return min(
        (price(each.desirability, weight_m), lacks(each.desirability), each.departures, each.way)
        for each in greetings(visitee.values, visitee.now)
    )


def first_of_all(request):
    """Every order with every side: the plan that the law puts first."""
    by_name = {visitee.name: visitee for visitee in request.visitees}
    names, found = list(by_name), []
    greets = {name: greeting_of(each, request.weights.greeting_m) for name, each in by_name.items()}
    for order, chosen in product(permutations(names), product(SIDES, repeat=len(names))):
        cost, lack, departures, here = 0, 0, 0, START
        for name, side in zip(order, chosen, strict=True):
            there = sides(by_name[name].values)[side]
            cost += round(100 * request.travel[here, Spot(name, side)])
            cost += price(there.desirability, request.weights.side_m) + greets[name][0]
            lack += lacks(there.desirability) + greets[name][1]
            departures += (not there.inferred) + greets[name][2]
            here = Spot(name, side)
        found.append((cost, lack, departures, [names.index(name) for name in order], chosen))
    _, _, _, turns, chosen = min(found)
    return [(names[turn], side, greets[names[turn]][3]) for turn, side in zip(turns, chosen, strict=True)]


def choices_of(plan):
    pairs = zip(plan.steps[::2], plan.steps[1::2], strict=True)
    return [(reach.person, reach.arguments[2], greet.arguments[2:]) for reach, greet in pairs]


@LAW
@given(st.data())
def test_of_all_plans_of_the_least_cost_the_law_picks_one(infer, line, data):
    request = data.draw(requests(infer, line))
    assert choices_of(make_plan(request)) == first_of_all(request)


@LAW
@given(st.data())
def test_priorities_and_deadlines_without_effect_leave_ties_as_they_are(infer, line, data):
    """With them labels are compared in time, too; nobody is late, and everybody is worth nothing."""
    request = data.draw(requests(infer, line))
    durations = {(None if a == START else a.place, b.place): 5.0 for a, b in request.travel}
    in_time = tuple(replace(each, by_s=1_000.0) for each in request.visitees)
    assert choices_of(make_plan(replace(request, visitees=in_time, durations_s=durations))) == first_of_all(
        request
    )


def with_group(request, distance_m):
    """The same where the first two stand together and overlook each other."""
    first, second = (visitee.name for visitee in request.visitees[:2])
    pairs = ((first, second), (second, first))
    spots = {Spot(here, side): {there: distance_m} for here, there in pairs for side in SIDES}
    return replace(request, companies=(Company("pair", (first, second), spots),))


def all_orders(choices):
    """Everybody alone or with their company, in any order."""
    (pair,) = choices.companies.values()
    alone = [Stop(name) for name in choices.people]
    others = [stop for stop in alone if stop.person not in pair.members]
    for stops in (alone, *([*others, Stop(member, pair.name)] for member in pair.members)):
        yield from permutations(stops)


def standing(visits, choices):
    """What the law compares of a plan before its sides: cost, desirability with departures, order."""
    names = list(choices.people)
    stays = [(Stay(v.spot, v.bringing, v.returns), Stop(v.spot.place, v.company)) for v in visits]
    turns = [names.index(name) for visit in visits for name in served(visit, choices)]
    return tour_cost(visits, choices), sum(tie_break(*each, choices) for each in stays), turns


@LAW
@given(st.data())
def test_the_law_holds_for_groups_too(infer, line, data):
    request = data.draw(requests(infer, line).filter(lambda request: len(request.visitees) > 1))
    request = with_group(request, data.draw(st.sampled_from([0.5, 2.0])))
    choices = options(request)
    plans = []
    for stops in all_orders(choices):
        with suppress(ValueError):
            plans.append(standing(best_tour(stops, choices), choices))
    assert standing(visits_of(make_plan(request)), choices) == min(plans)


@LAW
@given(order=st.permutations(["ann", "bob", "cem", "dan"]))
def test_people_who_are_all_alike_are_visited_in_the_scenarios_order(infer, request_for, order):
    plan = make_plan(request_for({name: infer() for name in order}))
    assert [step.person for step in plan.steps[::2]] == list(order)


def test_groups_that_cost_the_same_are_greeted_in_the_scenarios_order(infer, request_for):
    names = ["dan", "ann", "cem", "bob"]
    request = request_for({name: infer() for name in names})
    seen = {
        Spot(a, "front"): {b: 2.0} for pair in (("cem", "bob"), ("ann", "dan")) for a, b in (pair, pair[::-1])
    }
    tables = tuple(
        Company(name, members, {spot: near for spot, near in seen.items() if spot.place in members})
        for name, members in (("first", ("cem", "bob")), ("second", ("ann", "dan")))
    )
    plan = make_plan(replace(request, companies=tables))
    assert [step.people for step in plan.steps[1::2]] == [("dan", "ann"), ("cem", "bob")]


def test_of_two_sides_that_were_asked_for_the_left_is_taken(infer, request_for):
    plan = make_plan(request_for({"ann": infer(direction=60.0, settings=["approach_direction"])}))
    assert plan.steps[0].arguments[2] == "left"


def neutral(values, **words):
    """The same values with these neutral ones."""
    changed = {name: replace(values[name], neutral=word) for name, word in words.items()}
    return replace(values, parameters={**values.parameters, **changed})


@pytest.mark.parametrize(("usual", "expected"), [("wave", "wave"), ("nod", "nod"), ("handshake", "bow")])
@pytest.mark.parametrize("declared", list(permutations(["bow", "nod", "wave"])))
def test_where_the_inferred_gesture_is_out_the_neutral_one_is_next_and_then_the_name(
    infer, request_for, declared, usual, expected
):
    """A handshake was inferred, and the hands are full; the others are equally desirable."""
    gestures = {"handshake": 1.0} | dict.fromkeys(declared, 0.4)
    values = infer(modality="both", modalities={"both": 1.0}, gesture="handshake", gestures=gestures)
    values = neutral(values, greeting_gesture=usual, greeting_modality="both")
    request = request_for({"ann": values})
    (ann,) = request.visitees
    ann = replace(ann, now=Circumstances(person_carries="a bag"))
    assert make_plan(replace(request, visitees=(ann,))).steps[1].arguments[2:] == ("both", expected)
