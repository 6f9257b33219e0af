"""What is asked about a plan of a custom domain: why, how firm, what another profile changes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from comity.custom_domain import Others, bound_domain
from comity.report.custom_domain.plan_diff import custom_diff
from comity_domain import NoPlan
from comity_domain.custom import bind, plan_custom, read_custom, weigh, without
from comity_domain.custom.weighing import CustomFlip
from comity_fis import InputError
from tests.custom.conftest import PAGE

FILES = Path("waiter.pddl"), Path("evening.pddl"), Path("waiter.yaml")


def test_the_parts_of_every_cost_add_up_to_it(folder):
    """For every combination of objects, and however coarse the planner's units are."""
    for scale in (1, 7, 100):
        Path("other.yaml").write_text(PAGE["waiter.yaml"] + f"cost_scale: {scale}\n")
        for table in bound_domain(*FILES[:2], Path("other.yaml")).tables.values():
            for row in table.rows.values():
                assert sum(row.parts().values()) == row.cost
                assert min(row.parts().values()) >= 0


@pytest.mark.parametrize(
    "profiles",
    [
        {"aiko": "arab_man", "emma": "german_man"},
        {"aiko": "own_wish"},
        {"emma": "indian_man"},
    ],
)
def test_every_unit_of_a_difference_is_accounted_for(folder, profiles):
    bounds = bound_domain(*FILES), bound_domain(*FILES, Others(profiles))
    plans = [plan_custom(bound) for bound in bounds]
    diff = custom_diff((bounds[0], plans[0]), (bounds[1], plans[1]))
    assert sum(step.cost[1] - step.cost[0] for step in diff.costs) == diff.cost[1] - diff.cost[0]
    assert diff.cost == (plans[0].plan.cost, plans[1].plan.cost)
    for step in diff.costs:
        assert sum(part.after - part.before for part in step.parts) == step.cost[1] - step.cost[0]
    assert {change.person for change in diff.parameters} <= set(profiles)
    changed = {step.arguments for step in plans[0].plan.steps} ^ {
        step.arguments for step in plans[1].plan.steps
    }
    assert bool(changed) <= bool(diff.choices)


def test_without_a_choice_the_plan_is_as_dear_as_when_nobody_could_make_it(folder):
    """What is found with a nod forbidden to Aiko is what is found where no nod is possible for her."""
    bound = bound_domain(*FILES)
    found = plan_custom(bound)
    index = next(i for i, step in enumerate(found.plan.steps) if step.arguments[:2] == ("aiko", "nod"))
    other = without(bound, found, index)
    assert other.forbidden == "greet(aiko, nod)"
    assert "greet(aiko, nod, full)" in other.no_longer
    assert any(step.startswith("greet(aiko, ") for step in other.instead)
    assert other.proven
    # Where only Aiko's nod is made impossible in the problem, the same cost comes out.
    Path("waiter.pddl").write_text(
        PAGE["waiter.pddl"]
        .replace("(possible ?how ?h))", "(possible ?how ?h) (open ?g ?how))")
        .replace("(carrying ?g - guest)", "(carrying ?g - guest) (open ?g - guest ?how - greeting)")
    )
    ways = (
        " ".join(f"(open emma {how})" for how in ("bow", "nod", "wave")) + "(open aiko bow) (open aiko wave)"
    )
    Path("evening.pddl").write_text(PAGE["evening.pddl"].replace("(at counter)", f"(at counter) {ways}"))
    assert plan_custom(bound_domain(*FILES)).plan.cost == found.plan.cost + other.extra_cost


def test_a_step_that_every_plan_needs_has_no_plan_without_it(folder):
    bound = bound_domain(*FILES)
    found = plan_custom(bound)
    index = next(i for i, step in enumerate(found.plan.steps) if step.action == "serve")
    other = without(bound, found, index)
    assert (other.extra_cost, other.proven, other.instead) == (None, True, ())


def at_factor(factor):
    """The cheapest plan with the weight of greetings so many times as large, by itself."""
    text = PAGE["waiter.yaml"].replace(
        "greeting_gesture, weight: 1}", f"greeting_gesture, weight: {factor}}}"
    )
    Path("weighed.yaml").write_text(text)
    plan = plan_custom(bound_domain(*FILES[:2], Path("weighed.yaml"))).plan
    return {(step.action, *step.arguments) for step in plan.steps if step.action == "greet"}


def test_where_a_weight_flips_the_plan_other_greetings_are_cheaper_beyond_and_not_before(folder):
    bound = bound_domain(*FILES)
    found = plan_custom(bound)
    stability = weigh(bound, found)
    assert stability.exact
    greets = {(step.action, *step.arguments) for step in found.plan.steps if step.action == "greet"}
    (flip,) = (one for one in stability.flips if one.weight == "greet ?how")
    assert isinstance(flip, CustomFlip)
    assert flip.factor < 1.0
    assert at_factor(flip.factor * 0.97) != greets
    assert at_factor(flip.factor * 1.03) == greets
    assert at_factor(4.0) == greets


def test_where_nothing_is_weighed_differently_the_plan_is_stable(folder):
    """A greeting that costs nothing to like best, and empty hands: no factor changes anything."""
    Path("evening.pddl").write_text(
        PAGE["evening.pddl"].replace("(possible bow empty)", "(possible bow empty) (possible bow full)")
    )
    Path("waiter.yaml").write_text(PAGE["waiter.yaml"].replace("emma: {", "# emma: {"))
    bound = bound_domain(*FILES)
    assert weigh(bound, plan_custom(bound)).flips == ()


WITHOUT_A_WAY = re.sub(r"\(= \(way (counter aiko|emma aiko)\) [\d.]+\)", "", PAGE["evening.pddl"])


def test_a_cost_that_is_missing_is_named_with_the_places_that_read_and_state_it(folder):
    Path("evening.pddl").write_text(WITHOUT_A_WAY)
    for binding in (None, FILES[2]):
        with pytest.raises(NoPlan) as failed:
            plan_custom(bound_domain(*FILES[:2], binding))
        said = str(failed.value)
        assert "(way counter aiko) had a value" in said or "(way emma aiko) had a value" in said
        assert "The cost of approach reads it (waiter.pddl:22:43)" in said
        assert "NUMBER) under :init (evening.pddl:6:3)" in said
        assert "allowed" not in said


def test_only_what_the_cheapest_way_out_lacks_is_named(folder):
    """Emma's and the counter's ways to Aiko are missing: one of them is enough."""
    Path("evening.pddl").write_text(WITHOUT_A_WAY)
    with pytest.raises(NoPlan) as failed:
        plan_custom(bound_domain(*FILES[:2]))
    assert failed.value.remedy.count("had a value") == 1


def test_a_choice_that_nobody_consented_to_is_named_with_what_it_stands_for(folder):
    """Where only a handshake is possible, and Aiko did not consent to one."""
    Path("evening.pddl").write_text(
        PAGE["evening.pddl"].replace("(possible nod full) (possible nod empty)", "")
    )
    Path("waiter.yaml").write_text(
        PAGE["waiter.yaml"].replace(
            "weight: 1}\nfluents", "weight: 1, objects: {bow: handshake, wave: handshake}}\nfluents"
        )
    )
    with pytest.raises(NoPlan) as failed:
        plan_custom(bound_domain(*FILES))
    assert "were open" in str(failed.value)
    assert "stands for greeting_gesture handshake, and aiko did not consent to it" in str(failed.value)


def guests(count: int) -> str:
    return f"aiko emma {' '.join(f'g{i}' for i in range(count))} - guest"


@pytest.mark.parametrize(
    ("old", "new", "place", "words"),
    [
        ("aiko) 4.5)", "aiko) -4.5)", "evening.pddl:9:27", "-4.5 for approach with counter, aiko. Plan"),
        ("aiko) 4.5)", "aiko) 100000000000000)", "evening.pddl:9:27", "1e+14 for approach"),
        ("aiko) 4.5)", "aiko) 4.50000000001)", "evening.pddl:9:27", "of 0.000001, got 4.50000000001"),
        ("(at counter)", "(at counter) (= (way counter aiko) 9)", "evening.pddl:9:8", "one value of (way"),
        ("aiko emma - guest", guests(400), "waiter.pddl:22:43", "got 403 times 402"),
    ],
)
def test_what_the_planner_cannot_count_has_its_line(folder, old, new, place, words):
    assert old in PAGE["evening.pddl"]
    Path("evening.pddl").write_text(PAGE["evening.pddl"].replace(old, new, 1))
    with pytest.raises(InputError) as refusal:
        bind(read_custom(*FILES[:2]))
    assert str(refusal.value).startswith(place)
    assert words in str(refusal.value)


@pytest.mark.parametrize("metric", ["(* 2 (total-cost))", "(way counter aiko)"])
def test_a_metric_that_is_no_sum_of_costs_is_named_with_its_line(folder, metric):
    Path("evening.pddl").write_text(
        PAGE["evening.pddl"].replace("minimize (total-cost)", f"minimize {metric}")
    )
    with pytest.raises(InputError, match=r"beside a metric that is not the sum .*\(evening\.pddl:13:3\)"):
        bound_domain(*FILES)


def test_a_byte_that_is_no_text_has_its_line(folder):
    Path("evening.pddl").write_bytes(
        PAGE["evening.pddl"].replace("(:init", "; caf\u00e9\n(:init").encode("latin-1")
    )
    with pytest.raises(InputError, match=r"evening\.pddl:6:8: expected UTF-8 text, .*0xe9"):
        read_custom(*FILES[:2])
