"""People who stand together, greeted at once."""

from __future__ import annotations

from dataclasses import replace

import pytest

from comity_domain import Company, Spot, greetings, make_plan
from comity_domain.companies import company_options
from comity_domain.cost import dislike_cost
from comity_domain.request import Weights

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
        return set(company_options(company, values, offers, Weights()).spots.values())

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
