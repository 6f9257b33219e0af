"""A custom domain, bound to people: valid, as cheap as another planner finds, true to them."""

from __future__ import annotations

import json
import math
import random
import re
from dataclasses import replace
from pathlib import Path

import pytest
import yaml
from uniform_cost import cheapest

import comity
from comity.custom_domain import bound_domain
from comity_domain import NoPlan, PlanningFailed
from comity_domain.custom import bind, custom_pddl, plan_custom, read_custom
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import works
from comity_fis import InputError
from tests.custom.conftest import PAGE

PROFILES = (
    "arab_woman",
    "german_woman",
    "arab_man",
    "japanese_woman",
    "indian_man",
    "british_elder",
    "unknown",
)


def waiter(binding: str | dict | None = "waiter.yaml", problem: str = "evening.pddl"):
    if isinstance(binding, dict):
        Path("other.yaml").write_text(json.dumps(binding))
        binding = "other.yaml"
    return bound_domain(Path("waiter.pddl"), Path(problem), Path(binding) if binding else None)


def binding(**changes) -> dict:
    return {**yaml.safe_load(PAGE["waiter.yaml"]), **changes}


def ground(step, bound) -> GroundAction:
    return GroundAction(step.action.lower(), tuple(map(str.lower, step.arguments)))


def is_valid(plan, bound) -> bool:
    """By unified-planning's validator, on what the planner got."""
    return works([ground(step, bound) for step in plan.steps], bound)


def steps(plan, action: str) -> list:
    return [step for step in plan.steps if step.action == action]


@pytest.mark.parametrize("seed", range(4))
def test_another_planner_finds_the_same_cost_on_the_exported_pddl(folder, seed):
    """Random people, ways, weights and permissions; the reference reads the text that is written."""
    draw = random.Random(seed)
    people = {name: draw.choice(PROFILES) for name in ("aiko", "emma")}
    content = binding(people=people, cost_scale=draw.choice((1, 10, 100, 1000)))
    content["actions"]["greet"]["options"]["how"]["weight"] = draw.uniform(0, 20)
    content["actions"]["approach"]["options"]["side"]["weight"] = draw.uniform(0, 5)
    ways = re.sub(r"\) [\d.]+\)", lambda _: f") {draw.uniform(0.1, 9):.2f})", PAGE["evening.pddl"])
    Path("random.pddl").write_text(ways)
    bound = waiter(content, "random.pddl")
    plan, texts = plan_custom(bound).plan, custom_pddl(bound)
    assert plan.optimal
    assert is_valid(plan, bound)
    assert plan.cost == sum(step.cost for step in plan.steps) == cheapest(texts.domain, texts.problem)


def test_what_is_exported_has_whole_numbers_and_the_files_own_names(folder):
    bound = waiter()
    texts = custom_pddl(bound)
    assert texts.renamed == {}
    numbers = [word for word in texts.problem.replace(")", " ").split() if word.replace(".", "").isdigit()]
    assert numbers
    assert all(word.isdigit() for word in numbers)
    assert "(= (keep-mm aiko) 732)" in texts.problem
    assert "(define (domain waiter)" in texts.domain
    assert "(define (problem evening)" in texts.problem


NEVER_DONE = "(:action never :parameters (?g - guest) :precondition (or) :effect (served ?g))"


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [("waiter.pddl", "(:action return", f"{NEVER_DONE} (:action return")],
    ids=["an action that can never be done"],
)
def test_what_has_no_name_in_what_is_exported_is_not_missed(folder, file, old, new):
    Path(file).write_text(PAGE[file].replace(old, new))
    bound = waiter()
    pddl = custom_pddl(bound)
    assert pddl.renamed == {}
    Path("out-d.pddl").write_text(pddl.domain)
    Path("out-p.pddl").write_text(pddl.problem)
    again = plan_custom(bind(read_custom(Path("out-d.pddl"), Path("out-p.pddl"))))
    assert again.plan.cost == plan_custom(bound).plan.cost


def test_what_is_exported_can_be_planned_again_to_the_same_cost(folder):
    bound = waiter()
    texts = custom_pddl(bound)
    Path("d.pddl").write_text(texts.domain)
    Path("p.pddl").write_text(texts.problem)
    again = bind(read_custom(Path("d.pddl"), Path("p.pddl")))
    assert plan_custom(again).plan.cost == plan_custom(bound).plan.cost


def test_parameters_ride_beside_the_steps_in_full_precision(folder):
    plan = plan_custom(waiter()).plan
    for step in steps(plan, "approach"):
        profile = {"aiko": "japanese_woman", "emma": "british_elder"}[step.arguments[1]]
        values = comity.infer(profile, posture="seated")
        for name in ("conversational_distance", "approach_speed"):
            assert step.parameters[name] == values[name].value


def test_without_weights_the_binding_changes_no_cost(folder):
    """The plan costs what the domain alone says, times the scale."""
    content = binding()
    for action in content["actions"].values():
        for option in action["options"].values():
            option["weight"] = 0
    plain, bound = waiter(None), waiter(content)
    costs = [plan_custom(one).plan.cost / one.cost_scale for one in (plain, bound)]
    assert costs[0] == costs[1]


def test_a_weight_flips_a_choice(folder):
    """Aiko's bow needs empty hands: worth a detour at twelve metres, not at one."""
    chosen = {}
    for weight in (1, 12):
        content = binding()
        content["actions"]["greet"]["options"]["how"]["weight"] = weight
        greetings = steps(plan_custom(waiter(content)).plan, "greet")
        chosen[weight] = next(step.arguments[1] for step in greetings if step.arguments[0] == "aiko")
    assert chosen == {1: "nod", 12: "bow"}


@pytest.mark.parametrize("profile", PROFILES)
def test_an_option_costs_its_weight_times_the_logarithm_of_how_much_less_it_is_liked(folder, profile):
    bound = waiter(binding(people={"aiko": profile}))
    liked = comity.infer(profile)["greeting_gesture"].desirability.memberships
    best = max(liked[name] for name in ("bow", "nod", "wave"))
    for name in ("bow", "nod", "wave"):
        beyond = max(0.0, 1.0 - 100.0 * liked[name])  # below 0.01, along the tangent
        expected = 100 * (math.log(best / max(0.01, liked[name])) + beyond)
        assert bound.tables["greet"].rows["aiko", name].cost == round(expected)


def test_nobody_is_dearer_to_serve_for_what_they_like(folder):
    """Where everything is possible, the best way to greet or approach costs the same for all profiles."""
    for action, start in (("greet", 0), ("approach", 450)):
        bests = set()
        for profile in PROFILES[:4]:
            table = waiter(binding(people={"aiko": profile})).tables[action]
            prices = [
                row.cost for key, row in table.rows.items() if set(key) & {"aiko"} and "emma" not in key
            ]
            bests.add(min(prices))
        assert bests == {start}


@pytest.mark.parametrize("gesture", ["nod", "wave"])
def test_what_a_person_asked_for_leaves_no_other(folder, gesture):
    wish = {"profile": {"name": "Aiko", "settings": {"greeting_gesture": gesture}}}
    plan = plan_custom(waiter(binding(people={"aiko": wish}))).plan
    assert [s.arguments[1] for s in steps(plan, "greet") if s.arguments[0] == "aiko"] == [gesture]


def test_a_wish_that_no_object_stands_for_is_refused_with_its_line(folder):
    wish = {"profile": {"name": "Aiko", "settings": {"greeting_gesture": "palms_together"}}}
    with pytest.raises(
        InputError, match=r"other\.yaml:1: .*an object that stands for greeting_gesture .*, which aiko asked"
    ):
        waiter(binding(people={"aiko": wish}))


def test_what_needs_consent_is_out_without_it(folder):
    content = binding()
    content["actions"]["greet"]["options"]["how"]["objects"] = {"bow": "handshake"}
    assert ("aiko", "bow") not in waiter(content).tables["greet"].rows
    stored = {"profile": {"name": "Aiko", "touch_consent": "given"}}
    assert ("aiko", "bow") not in waiter({**content, "people": {"aiko": stored}}).tables["greet"].rows
    consenting = {"profile": "unknown", "situation": {"touch_consent": "given"}}
    assert ("aiko", "bow") in waiter({**content, "people": {"aiko": consenting}}).tables["greet"].rows


def test_of_somebody_who_is_not_named_nothing_is_known(folder):
    step = steps(plan_custom(waiter(binding(people={}))).plan, "approach")[0]
    nobody = comity.infer()["conversational_distance"].value
    assert step.parameters["conversational_distance"] == nobody


def test_whoever_is_of_a_named_persons_type_may_be_a_person_and_others_are_once_named(folder):
    """Of children none is named, so that the guests' and their common type are refused until one is."""

    def bound(argument: str, *named: str):
        Path("d.pddl").write_text(
            "(define (domain d) (:types guest child - person table)"
            "(:predicates (met ?p - person) (by ?t - table))"
            "(:action meet :parameters (?p - person ?t - table) :effect (and (met ?p) (by ?t))))"
        )
        Path("p.pddl").write_text(
            "(define (problem p) (:domain d) (:objects aiko emma - guest ben - child round - table)"
            "(:init) (:goal (and (met aiko) (met emma) (met ben))))"
        )
        people = dict.fromkeys(named, "arab_woman")
        content = {"schema_version": 1, "people": people, "actions": {"meet": {"person": argument}}}
        Path("b.yaml").write_text(json.dumps(content))
        return bound_domain(Path("d.pddl"), Path("p.pddl"), Path("b.yaml"))

    with pytest.raises(InputError, match=r"\?p, which may be ben.*under `people`"):
        bound("p", "aiko")
    with pytest.raises(InputError, match=r"\?t, which may be round.*Bind \?p"):
        bound("t", "aiko", "ben")
    assert bound("p", "aiko", "ben")
    assert bound("t"), "where nobody is named, anything may be somebody"


def test_alternatives_are_sorted_never_cheaper_and_leave_a_valid_plan(folder):
    bound = waiter()
    plan = plan_custom(bound).plan
    listed = [step for step in plan.steps if step.why.alternatives]
    assert listed
    for step in listed:
        extras = [other.extra_cost for other in step.why.alternatives]
        assert extras == sorted(extras)
        assert extras[0] >= 0  # the plan is optimal
        for other in step.why.alternatives:
            assert other.arguments != step.arguments
            assert {other.arguments[0], other.arguments[1]} & set(step.arguments)


def test_a_domain_without_costs_is_planned_for_the_fewest_steps(folder):
    text = PAGE["waiter.pddl"].replace("(total-cost))", ")", 1)
    text = text.replace("(increase (total-cost) (way ?from ?g))", "").replace(
        "(increase (total-cost) (way ?g counter))", ""
    )
    Path("waiter.pddl").write_text(text)
    Path("evening.pddl").write_text(PAGE["evening.pddl"].replace("(:metric minimize (total-cost))", ""))
    plan = plan_custom(waiter(None)).plan
    assert plan.cost == len(plan.steps) == 9


@pytest.mark.parametrize("goal", ["(at counter)", "(and)", "()"])
def test_a_goal_already_reached_is_an_empty_plan(folder, goal):
    Path("evening.pddl").write_text(PAGE["evening.pddl"].replace("(and (served aiko) (served emma))", goal))
    plan = plan_custom(waiter()).plan
    assert (plan.steps, plan.cost, plan.optimal) == ((), 0, True)


def test_no_plan_is_said_so(folder):
    Path("evening.pddl").write_text(PAGE["evening.pddl"].replace("(hands-are empty)", ""))
    with pytest.raises(NoPlan, match="no plan reaches the goal"):
        plan_custom(waiter())


NUMERIC = (
    """(define (domain mugs) (:requirements :strips :numeric-fluents)
  (:predicates (done)) (:functions (mugs))
  (:action wash :parameters () :effect (increase (mugs) 1))
  (:action stop :parameters () :precondition (>= (mugs) 3) :effect (done)))""",
    "(define (problem p) (:domain mugs) (:init (= (mugs) 0)) (:goal (done)))",
)
DURATIVE = (
    """(define (domain tour) (:requirements :durative-actions :typing :numeric-fluents)
  (:types visitor) (:predicates (met ?v - visitor) (idle)) (:functions (minutes ?v - visitor))
  (:durative-action meet :parameters (?v - visitor) :duration (= ?duration (minutes ?v))
    :condition (at start (idle)) :effect (and (at start (not (idle))) (at end (idle)) (at end (met ?v)))))""",
    """(define (problem p) (:domain tour) (:objects noor emma - visitor) (:init (idle))
  (:goal (and (met noor) (met emma))))""",
)
DURATIVE_BINDING = """schema_version: 1
people: {noor: arab_woman, emma: german_woman}
actions:
  meet: {person: v, parameters: [conversational_distance]}
fluents:
  minutes: {parameter: conversational_distance, scale: 10}
"""


def own_files(texts: tuple[str, str]):
    Path("d.pddl").write_text(texts[0])
    Path("p.pddl").write_text(texts[1])
    return Path("d.pddl"), Path("p.pddl")


@pytest.mark.parametrize("texts", [NUMERIC, DURATIVE], ids=["numeric", "durative"])
def test_where_no_engine_can_the_message_says_what_to_install(folder, texts, monkeypatch):
    from comity_domain.custom.solving import choosing

    monkeypatch.setattr(choosing, "_can", lambda *_: False)
    with pytest.raises(PlanningFailed, match=r"\(d\.pddl:3:\d+\)\. Install one: pip install up-aries"):
        plan_custom(bound_domain(*own_files(texts)))


SINKS = (
    NUMERIC[0].replace("(:predicates", "(:types sink) (:predicates").replace("()", "(?s - sink)", 1),
    NUMERIC[1].replace("(:init", "(:objects big - sink) (:init (= (holds big) 2)"),
)
"""The first action has a parameter, so that functions of it can be written."""


def test_what_an_engine_does_not_take_is_compiled_away(folder):
    """Neither quantifiers nor effects on a condition are for aries; the compilers take them out."""
    pytest.importorskip("up_aries")
    domain = SINKS[0].replace("(increase (mugs) 1)", "(when (not (done)) (increase (mugs) 1))")
    domain = domain.replace("(>= (mugs) 3)", "(and (>= (mugs) 3) (forall (?s - sink) (not (done))))")
    plan = plan_custom(bound_domain(*own_files((domain, SINKS[1].replace("(= (holds big) 2)", ""))))).plan
    assert [step.action for step in plan.steps] == ["wash", "wash", "wash", "stop"]
    assert plan.steps[0].arguments == ("big",)


@pytest.mark.parametrize(
    ("old", "new", "words", "remedy"),
    [
        ("(increase (mugs) 1)", "(increase (mugs) (holds ?s))", "changes of a n", "Write a number"),
        ("(>= (mugs) 3)", "(>= (mugs) 2.5)", "fractions", "Write it in whole numbers"),
    ],
    ids=["a change by a function", "a fraction"],
)
def test_what_the_engine_for_numbers_does_not_take_is_named_with_what_to_write(
    folder, old, new, words, remedy
):
    pytest.importorskip("up_aries")
    domain = SINKS[0].replace("(mugs))", "(mugs) (holds ?s - sink))", 1).replace(old, new)
    from comity_domain.custom.solving import choosing

    bound = bound_domain(*own_files((domain, SINKS[1])))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(choosing, "_can", lambda *_: False)  # Java's engines, where they are installed, can
        with pytest.raises(PlanningFailed) as failed:
            plan_custom(bound)
    assert f"aries is installed, and takes no {words}" in failed.value.reason
    assert failed.value.remedy.startswith(remedy)


def test_a_numeric_domain_is_solved_where_an_engine_can(folder):
    pytest.importorskip("up_aries")
    found = plan_custom(bound_domain(*own_files(NUMERIC)))
    assert [step.action for step in found.plan.steps] == ["wash", "wash", "wash", "stop"]
    assert found.plan.engine == "aries"


def test_a_numeric_domain_with_costs_is_solved_without_them_by_an_engine_that_takes_none(folder):
    pytest.importorskip("up_aries")
    domain = NUMERIC[0].replace("(mugs))", "(mugs) (soap) (total-cost))", 1)
    domain = domain.replace("(increase (mugs) 1)", "(and (increase (mugs) 1) (increase (total-cost) (soap)))")
    problem = NUMERIC[1].replace("(= (mugs) 0)", "(= (mugs) 0) (= (soap) 2)")
    bound = bound_domain(*own_files((domain, f"{problem[:-1]} (:metric minimize (total-cost)))")))
    found = plan_custom(replace(bound, engine="aries"))
    assert [step.action for step in found.plan.steps] == ["wash", "wash", "wash", "stop"]
    assert not found.tells_costs
    assert found.metric_ignored
    assert not found.plan.optimal


NEVER = (
    NUMERIC[0].replace("(:predicates (done))", "(:predicates (done) (empty))")[:-1]
    + "(:action drain :parameters () :precondition (<= (mugs) (- 0 1)) :effect (empty)))",
    NUMERIC[1].replace("(:goal (done))", "(:goal (and (done) (empty)))"),
)


def test_where_no_plan_is_found_in_time_nothing_is_claimed_of_the_goals(folder):
    """The mugs only become more: nothing shows that there is no plan, and the search never ends."""
    pytest.importorskip("up_aries")
    with pytest.raises(PlanningFailed, match="no plan was found within 1 s") as failed:
        plan_custom(bound_domain(*own_files(NEVER)), time_limit_s=1.0)
    assert failed.value.cut_off
    assert not isinstance(failed.value, NoPlan)


def test_a_durative_domain_takes_durations_and_parameters_from_people(folder):
    pytest.importorskip("up_aries")
    Path("b.yaml").write_text(DURATIVE_BINDING)
    found = plan_custom(bound_domain(*own_files(DURATIVE), Path("b.yaml")))
    ends = 0.0
    for step, action in sorted(
        zip(found.plan.steps, found.actions, strict=True), key=lambda pair: pair[1].start_s
    ):
        assert action.start_s >= ends
        assert action.duration_s == round(10 * step.parameters["conversational_distance"])
        ends = action.start_s + action.duration_s
    assert len(found.plan.steps) == 2


def test_options_in_a_durative_domain_are_refused_and_not_dropped(folder):
    Path("b.yaml").write_text(
        DURATIVE_BINDING.replace("parameters: [conversational_distance]", "options: {}")
    )
    domain, problem = own_files(DURATIVE)
    assert bound_domain(domain, problem, Path("b.yaml"))
    Path("d.pddl").write_text(
        DURATIVE[0].replace("(?v - visitor) :duration", "(?v - visitor ?g - visitor) :duration")
    )
    Path("b.yaml").write_text(
        DURATIVE_BINDING.replace(
            "parameters: [conversational_distance]",
            "options: {g: {parameter: greeting_gesture, objects: {noor: bow, emma: nod}}}",
        )
    )
    with pytest.raises(InputError, match=r"b\.yaml:4: .*classical"):
        bound_domain(domain, problem, Path("b.yaml"))


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("aiko: {", "ako: {", 3, "Did you mean 'aiko'?"),
        ("japanese_woman", "japanese_women", 3, "Did you mean 'japanese_woman'?"),
        ("posture: seated}}\n  emma", "postur: seated}}\n  emma", 3, "Did you mean 'posture'?"),
        ("  approach:", "  aproach:", 6, "Did you mean 'approach'?"),
        ("person: g                 # the", "person: guest # the", 7, "an argument of the action approach"),
        ("conversational_distance, app", "conversation_distance, app", 8, "'conversational_distance'?"),
        ("      side: ", "      sid: ", 10, "Did you mean 'side'?"),
        ("parameter: approach_direction", "parameter: approach_dir", 11, "'approach_direction'?"),
        ("weight: 1\n", "weight: -1\n", 12, "from 0 up"),
        ("weight: 1\n", "weight: heavy\n", 12, "a number"),
        ("front: [0, 22.5]", "front: [22.5, 0]", 10, "got [22.5, 0]. Write the smaller number first"),
        ("front: [0, 22.5]", "front: ahead", 10, "[0, 22.5]"),
        ("front: [0, 22.5]", "front: [500, 600]", 13, "numbers from 0 to 90 deg"),
        ("front: [0, 22.5]", "front: [0, 90.5]", 13, "got 90.5"),
        ("front: [0, 22.5]", "front: -1", 13, "got -1"),
        ("person: g                 # the", "person: side # the", 7, "may be front, left, right. Bind ?g;"),
        ("person: g                 # the", "person: FROM # the", 7, "which may be counter. Bind ?g;"),
        ("people:   ", "people:\n  front: arab_man\n#", 3, "an object that a `person` of the binding may be"),
        ("people:   ", "people:\n  counter: arab_man\n#", 3, "got 'counter'"),
        ("keep-mm:", "noise:", 19, "?p of noise, which may be counter"),
        ("left: [", "lift: [", 13, "Did you mean 'left'?"),
        (
            "parameter: greeting_gesture",
            "parameter: greeting_modality",
            17,
            "a category of greeting_modality",
        ),
        ("      how:", "      g:", 17, "an argument beside the person"),
        ("\n  emma: {", "\n  AIKO: unknown\n  emma: {", 4, "one of aiko and AIKO"),
        ("  greet:", "  Approach: {person: g}\n  greet:", 14, "one of approach and Approach"),
        ("fluents:", "fluents:\n  KEEP-mm: {parameter: approach_speed}", 20, "one of KEEP-mm and keep-mm"),
        ("weight: 1\n", "weight: 999999\n", 12, "a smaller `cost_scale`"),
        ("keep-mm:", "keep:", 19, "Did you mean 'keep-mm'?"),
        ("keep-mm:", "way:", 19, "one argument"),
        (
            "keep-mm: {parameter: conversational_distance",
            "keep-mm: {parameter: greeting_gesture",
            19,
            "a word",
        ),
        ("scale: 1000", "scale: 0.5", 19, "whole number"),
        ("fluents:", "fluent:", 18, "Did you mean 'fluents'?"),
        ("schema_version: 1", "schema_version: 2", 1, "1"),
    ],
)
def test_a_slip_in_a_binding_is_placed_and_comes_with_a_remedy(folder, old, new, line, words):
    assert old in PAGE["waiter.yaml"]
    Path("waiter.yaml").write_text(PAGE["waiter.yaml"].replace(old, new, 1))
    Path("waiter.pddl").write_text(PAGE["waiter.pddl"].replace("(keep-mm", "(noise ?p - place) (keep-mm"))
    with pytest.raises(InputError) as refusal:
        waiter()
    assert f"waiter.yaml:{line}" in str(refusal.value), refusal.value
    assert words in str(refusal.value)
