from __future__ import annotations

import subprocess
import sys
import tempfile
import warnings
from dataclasses import replace
from itertools import pairwise

import pytest

from comity_domain import START, Plan, Spot, Weights, make_plan
from comity_domain.plans.plan import Alternative
from comity_fis.errors import InputError
from comity_fis.inference.value import FiredRule, Inference
from comity_fis.rules.rule import Is, Rule

STRANGE_NAMES = (
    *("front", "robot", "user", "start", "here", "verbal", "none", "class", "and", "object", "define"),
    *("Zoë", "東京", "ANNA", "anna", "Anna-Lena", "a b", "", "3", "?x", "(", ";", "at", "reach_user", "\n"),
)


def steps(plan: Plan, action: str):
    return [step for step in plan.steps if step.action == action]


def test_a_visit_is_a_reach_and_a_greeting_with_full_precision(infer, request_for):
    reach, greet = make_plan(request_for({"johanna": infer()})).steps
    assert (reach.action, reach.arguments, reach.origin) == (
        *("Reach_user", ("robot", "johanna", "front")),
        ("start", "here"),
    )
    assert reach.parameters == {
        "conversational_distance": 0.640213579,
        "approach_direction": 0.0,
        "approach_bearing": 0.0,
        "approach_speed": 0.317716680,
    }
    assert (greet.action, greet.arguments, greet.origin) == (
        *("Greet_person", ("robot", "johanna", "verbal", "none")),
        None,
    )
    assert greet.parameters == {"greeting_modality": "verbal", "greeting_gesture": "none"}
    assert (reach.cost, greet.cost) == (500, 0)


def test_whoever_is_reached_is_greeted_before_the_robot_goes_on(random_request):
    plan = make_plan(random_request(5, seed=3))
    pairs = list(zip(plan.steps[::2], plan.steps[1::2], strict=True))
    assert all((a.action, b.action) == ("Reach_user", "Greet_person") for a, b in pairs)
    assert all(a.person == b.person for a, b in pairs)
    spots = [("start", "here"), *(a.arguments[1:] for a, _ in pairs)]
    assert [a.origin for a, _ in pairs] == spots[:-1]


def test_people_and_robots_may_have_any_name(infer, request_for):
    """Types, keywords, two that differ by case, the empty name: all come back unchanged."""
    few = {name: infer(settings=["approach_direction", "greeting_modality"]) for name in STRANGE_NAMES}
    chain = [START, *(Spot(name, "front") for name in few)]
    travel = dict.fromkeys(pairwise(chain), 1.0)
    plan = make_plan(request_for(few, travel, robot="Reach_user"))
    assert [step.person for step in steps(plan, "Greet_person")] == list(STRANGE_NAMES)
    assert {step.arguments[0] for step in plan.steps} == {"Reach_user"}
    assert plan.optimal


def test_nobody_to_visit_is_an_empty_plan_and_not_a_failure(request_for):
    plan = make_plan(request_for({}))
    assert (plan.steps, plan.cost, plan.optimal) == ((), 0, True)


def test_a_short_way_beats_a_small_dislike_and_not_a_large_one(infer, request_for, travel_everywhere):
    """The front is 1 m further here; the left has a tenth of its desirability: 230 cm per metre of weight."""
    travel = travel_everywhere(["ada"]) | {(START, Spot("ada", "left")): 4.0}

    def side(weight_m):
        request = request_for({"ada": infer()}, travel, weights=Weights(side_m=weight_m))
        return make_plan(request).steps[0].arguments[2]

    assert (side(0.1), side(1.0)) == ("left", "front")


def test_a_setting_is_kept_at_any_cost(infer, request_for, travel_everywhere):
    travel = travel_everywhere(["ada"]) | {
        (START, Spot("ada", "left")): 90.0,
        (START, Spot("ada", "right")): 95.0,
    }
    values = infer(direction=45.0, gesture="wave", settings=["approach_direction", "greeting_gesture"])
    reach, greet = make_plan(request_for({"ada": values}, travel)).steps
    assert reach.arguments[2] == "left"
    assert reach.parameters["approach_bearing"] == 45.0
    assert greet.arguments[2:] == ("both", "wave")


@pytest.mark.parametrize("direction", [0.0, 45.0])
def test_ties_go_to_what_was_inferred(infer, request_for, line, direction):
    even = line(((0.0, 1.0), (90.0, 1.0)))
    values = infer(
        direction=direction,
        curve=even,
        modality="both",
        modalities=dict.fromkeys(("verbal", "gestural", "both"), 0.7),
        gesture="wave",
        gestures=dict.fromkeys(("bow", "nod", "wave"), 0.7),
    )
    plan = make_plan(request_for({"ada": values, "bob": values}))
    assert {step.arguments[2] for step in steps(plan, "Reach_user")} == {"left" if direction else "front"}
    assert {step.arguments[2:] for step in steps(plan, "Greet_person")} == {("both", "wave")}


def test_alternatives_say_what_the_whole_plan_would_cost_more(infer, request_for, travel_everywhere):
    """Ada from the left: 50 cm less to go there, 120 cm more to go on from there, and 230 cm of dislike."""
    travel = travel_everywhere(["ada", "bob"]) | {
        (START, Spot("bob", "front")): 50.0,
        (START, Spot("ada", "left")): 4.5,
        (Spot("ada", "left"), Spot("bob", "front")): 6.2,
    }
    first = make_plan(request_for({"ada": infer(), "bob": infer()}, travel)).steps[0]
    assert first.arguments == ("robot", "ada", "front")
    extra = {alternative.arguments[2]: alternative.extra_cost for alternative in first.why.alternatives}
    assert extra == {"left": -50 + 120 + 230, "right": 230}
    costs = [alternative.extra_cost for alternative in first.why.alternatives]
    assert costs == sorted(costs)


@pytest.mark.parametrize("seed", range(3))
def test_no_alternative_to_an_optimal_plan_is_cheaper(random_request, seed):
    plan = make_plan(random_request(4, seed))
    assert all(a.extra_cost >= 0 for step in plan.steps for a in step.why.alternatives)


def test_a_step_says_why_and_what_the_next_best_would_cost(infer, request_for):
    rule = Rule(
        number=7,
        text="if posture is standing then approach_direction is front",
        antecedent=Is("posture", "standing"),
        consequents=(Is("approach_direction", "front"),),
        sources=(),
        evidence="moderate",
    )
    values = with_rule(infer(), "approach_direction", rule)
    reach, greet = make_plan(request_for({"ada": values})).steps
    assert reach.why.text == (
        "front: desirability 1.00 for the approach direction (rule 7: if posture is standing then "
        "approach direction is front); left would cost 230 cm more with the rest as it is"
    )
    assert greet.why.text == (
        "verbal: desirability 1.00 as a greeting (modality: culture value); "
        "both with nod would cost 69 cm more with the rest as it is"
    )


def test_a_greeting_names_the_rule_that_concludes_it(infer, request_for):
    """Not the strongest one, where that concludes another gesture."""

    def rule(number, gesture):
        text = f"if age is adult then greeting_gesture is {gesture}"
        return Rule(
            number=number,
            text=text,
            antecedent=Is("age", "adult"),
            consequents=(Is("greeting_gesture", gesture),),
            sources=(),
            evidence="design",
        )

    values = infer(modality="both", modalities={"both": 1.0}, gesture="nod")
    values = with_rule(values, "greeting_gesture", rule(1, "wave"), rule(2, "nod"))
    greet = make_plan(request_for({"ada": values})).steps[1]
    assert "gesture: rule 2: if age is adult then greeting gesture is nod" in greet.why.text


def test_a_rule_that_only_ignorance_supports_is_quoted_last_and_as_possible(infer, request_for):
    """However strong it is: nobody disclosed what it reads."""

    def rule(number, variable):
        return Rule(
            number=number,
            text=f"if {variable} is high then approach_direction is front",
            antecedent=Is(variable, "high"),
            consequents=(Is("approach_direction", "front"),),
            sources=(),
            evidence="design",
        )

    values = replace(infer(), inputs={"robot_experience": None, "shyness": 0.3})
    both = with_rule(values, "approach_direction", rule(1, "robot_experience"), rule(2, "shyness"))
    reach = make_plan(request_for({"ada": both})).steps[0]
    assert "(rule 2: if shyness is high then approach direction is front)" in reach.why.text
    alone = with_rule(values, "approach_direction", rule(1, "robot_experience"))
    reach = make_plan(request_for({"ada": alone})).steps[0]
    assert "approach direction is front; robot experience not disclosed, only possible)" in reach.why.text


def with_rule(values: Inference, name: str, *rules: Rule) -> Inference:
    fired = tuple(FiredRule(rule, 1.0) for rule in rules)
    changed = replace(values[name], fired=fired)
    return replace(values, parameters={**values.parameters, name: changed})


def test_a_step_names_what_else_could_be_done_with_price_and_reason(infer, request_for):
    reach, greet = make_plan(request_for({"johanna": infer()})).steps
    assert reach.origin == ("start", "here")
    assert greet.origin is None
    assert reach.why.alternatives[0] == Alternative(
        ("robot", "johanna", "left"), 230, "desirability 0.10 for the approach direction (culture value)"
    )


def test_a_person_without_a_route_is_refused_by_name(infer, request_for):
    with pytest.raises(ValueError, match="'ada'"):
        make_plan(request_for({"ada": infer()}, {}))


def test_a_rulebook_without_the_parameters_of_a_visit_is_refused(infer, request_for):
    values = infer()
    poor = Inference("poor", "exact", {}, {"approach_speed": values["approach_speed"]})
    with pytest.raises(InputError, match="'poor', which has no conversational_distance"):
        request_for({"ada": poor})


def test_planning_prints_nothing_warns_of_nothing_and_writes_nothing_here(
    random_request, tmp_path, monkeypatch, capfd
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        make_plan(random_request(2, seed=2))
    assert capfd.readouterr() == ("", "")
    assert list(tmp_path.iterdir()) == []


def test_importing_the_package_loads_no_planning_library():
    heavy = ("unified_planning", "up_fast_downward", "scipy", "networkx")
    code = f"import sys, comity_domain; print([name for name in {heavy} if name in sys.modules])"
    assert (
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
        == "[]\n"
    )
