"""People who stand together, greeted at once."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from comity_domain import Company, PlanningFailed, Spot, greetings, make_plan
from comity_domain.choices.companies import company_options
from comity_domain.choices.cost import dislike_cost
from comity_domain.problem.request import Weights

NEAR, FAR = 0.5, 1.0
ALL_SPOTS = [Spot(name, side) for name in ("ada", "bob") for side in ("front", "left", "right")]


def together(request, distance_m=FAR):
    overlooks = {
        spot: {other: distance_m for other in ("ada", "bob") if other != spot.place} for spot in ALL_SPOTS
    }
    return replace(request, companies=(Company("window", ("ada", "bob"), overlooks),))


def greets(plan):
    return [(step.action, step.people) for step in plan.steps if step.action.startswith("Greet")]


def test_a_company_is_greeted_once_and_everybody_in_it_is_served(infer, request_for):
    """One way less, and one greeting for two."""
    request = request_for({"ada": infer(), "bob": infer()})
    alone, at_once = make_plan(request), make_plan(together(request))
    ((action, people),) = greets(at_once)
    assert action == "Greet_company"
    assert sorted(people) == ["ada", "bob"]
    assert alone.cost - at_once.cost == 500
    assert at_once.steps[1].arguments[2:] == ("window", "verbal", "none")


def test_where_no_greeting_suits_all_each_is_greeted_alone(infer, request_for):
    verbal = infer(modality="verbal", settings=["greeting_modality"])
    gestural = infer(modality="gestural", settings=["greeting_modality"])
    plan = make_plan(together(request_for({"ada": verbal, "bob": gestural})))
    assert [action for action, _ in greets(plan)] == ["Greet_person", "Greet_person"]


def test_a_greeting_that_suits_one_of_them_badly_is_weighed_against_the_way(infer, request_for):
    """At a small weight they are greeted at once, at a large one each in their own way."""
    words = infer(modalities={"verbal": 1.0, "gestural": 0.05, "both": 0.05})
    wave = infer(
        modality="gestural",
        modalities={"verbal": 0.05, "gestural": 1.0, "both": 0.05},
        gesture="wave",
        gestures={"wave": 1.0, "nod": 0.05},
    )

    def actions(weight_m):
        weights = Weights(greeting_m=weight_m)
        plan = make_plan(together(request_for({"ada": words, "bob": wave}, weights=weights)))
        return [action for action, _ in greets(plan)]

    assert actions(0.5) == ["Greet_company"]
    assert actions(4.0) == ["Greet_person", "Greet_person"]


def test_standing_nearer_than_suits_another_costs_and_farther_does_not(infer, request_for, line):
    likes_far = infer()
    curve = line(((0.45, 0.0), (0.64, 1.0), (1.2, 1.0)))
    distance = replace(likes_far["conversational_distance"], desirability=curve)
    likes_far = replace(likes_far, parameters={**likes_far.parameters, "conversational_distance": distance})
    request = request_for({"ada": likes_far, "bob": likes_far})
    values = {visitee.name: visitee.values for visitee in request.visitees}
    offers = {name: dict.fromkeys(greetings(likes_far), 0) for name in values}

    def prices(distance_m):
        (company,) = together(request, distance_m).companies
        return set(company_options(company, company.overlooks, values, offers, Weights()).spots.values())

    assert prices(FAR) == {0}
    assert prices(NEAR) == {dislike_cost(curve(NEAR), 1.0)}


def test_nobody_is_stood_nearer_to_than_they_asked_for(infer, request_for):
    asked = infer(settings=["conversational_distance"])
    request = request_for({"ada": asked, "bob": asked})
    assert [action for action, _ in greets(make_plan(together(request, NEAR)))] == ["Greet_person"] * 2
    assert [action for action, _ in greets(make_plan(together(request, FAR)))] == ["Greet_company"]


def test_a_company_of_one_or_of_strangers_is_refused(infer, request_for):
    with pytest.raises(ValueError, match="two different members"):
        Company("window", ("ada",), {})
    with pytest.raises(ValueError, match="expected a distance"):
        Company("window", ("ada", "bob"), {Spot("ada", "front"): {}})
    request = request_for({"ada": infer()})
    with pytest.raises(ValueError, match="belong to one company"):
        replace(request, companies=(Company("window", ("ada", "eve"), {}),))


def alternatives(plan):
    """Of the greeting of a group: the choice of each, with what it would cost more."""
    (step,) = (step for step in plan.steps if step.action == "Greet_company")
    return {each.arguments[1:]: each.extra_cost for each in step.why.alternatives}


def test_a_group_could_be_greeted_from_elsewhere_otherwise_or_one_by_one_each_at_its_price(
    infer, request_for, travel_everywhere
):
    """Bob is 1 m nearer to the robot."""
    names = ("ada", "bob")
    nearer = {
        leg: 4.0 if leg[1].place == "bob" else metres for leg, metres in travel_everywhere(names).items()
    }
    both = {"verbal": 1.0, "gestural": 0.2, "both": 0.5}
    request = together(request_for({name: infer(modalities=both) for name in names}, nearer))
    plan = make_plan(request)
    found = alternatives(plan)
    assert found["ada", "front"] == 100, "a metre further"
    alone = make_plan(replace(request, companies=()))
    reached = plan.steps[0].person
    assert found[reached, "one by one"] == alone.cost - plan.cost
    assert any("both" in choice for choice in found), "another greeting from where it stands"
    assert list(found.values()) == sorted(found.values()), "cheapest first"


def test_one_by_one_is_out_where_somebody_would_be_greeted_too_late(infer, request_for):
    request = together(request_for({"ada": infer(), "bob": infer()}))
    durations = {(start, end): 5.0 for start in (None, "ada", "bob") for end in ("ada", "bob")}
    hurried = tuple(replace(each, by_s=10.0) for each in request.visitees)
    plan = make_plan(replace(request, visitees=hurried, durations_s=durations))
    (step,) = (step for step in plan.steps if step.action == "Greet_company")
    (reason,) = (out.reason for out in step.why.ruled_out if out.arguments[-1] == "one by one")
    assert "greeted at 18.0 s, later than 10 s, in the cheapest order; no other one keeps all" in reason


@pytest.mark.parametrize("seed", range(40))
def test_one_by_one_has_the_price_of_the_best_order_in_time_and_is_out_only_where_there_is_none(
    infer, request_for, travel_everywhere, seed
):
    """Held against the plan for the same people with the same deadlines, who do not stand together."""
    draw, names = random.Random(seed), ("ada", "bob")
    ways = {leg: round(draw.uniform(1.0, 6.0), 2) for leg in travel_everywhere(names)}
    request = request_for({name: infer() for name in names}, ways)
    hurried = tuple(replace(each, by_s=draw.choice((None, 12.0, 30.0))) for each in request.visitees)
    durations = {(start, end): draw.uniform(2.0, 12.0) for start in (None, *names) for end in names}
    apart = replace(request, visitees=hurried, durations_s=durations)
    try:
        plan = make_plan(together(apart))
    except PlanningFailed:
        return
    if [action for action, _ in greets(plan)] != ["Greet_company"]:
        return
    found = [extra for choice, extra in alternatives(plan).items() if "one by one" in choice]
    try:
        assert found == [make_plan(apart).cost - plan.cost]
    except PlanningFailed:
        assert found == []


@pytest.mark.parametrize(("by_s", "possible"), [(70.0, True), (10.0, False)])
def test_of_many_members_the_one_in_a_hurry_is_tried_first(infer, request_for, by_s, possible):
    """Where not every order is looked at, the one by deadlines is."""
    names = [f"p{i}" for i in range(6)]
    request = request_for({name: infer() for name in names})
    spots = [Spot(name, side) for name in names for side in ("front", "left", "right")]
    overlooks = {spot: {other: FAR for other in names if other != spot.place} for spot in spots}
    deadlines = dict(zip(names, (None, None, 14.0, by_s, None, 28.0), strict=True))
    durations = {(start, end): 6.0 for start in (None, *names) for end in names}
    request = replace(
        request,
        visitees=tuple(replace(each, by_s=deadlines[each.name]) for each in request.visitees),
        companies=(Company("window", tuple(names), overlooks),),
        durations_s=durations,
    )
    plan = make_plan(request)
    assert any("one by one" in choice for choice in alternatives(plan)) == possible
    (step,) = (step for step in plan.steps if step.action == "Greet_company")
    out = [each.reason for each in step.why.ruled_out if each.arguments[-1] == "one by one"]
    assert [reason.split("; ")[1] for reason in out] == (
        [] if possible else ["no other one that was tried keeps all deadlines"]
    )
