"""Any engine of unified-planning plans visits: the same cost, with parameters and reasons."""

from __future__ import annotations

import shutil
from dataclasses import replace
from importlib.resources import files

import pytest
from downward import needs_fast_downward
from unified_planning.io import PDDLReader

from comity_domain import NoPlan, PlanningFailed, make_plan, plan_with
from comity_domain.choices.options import options
from comity_domain.classical.initial_state import goals, initial_state, visit_names
from comity_domain.classical.tour_of import tour_of
from comity_domain.custom.reading.reading import fresh_environment
from comity_domain.custom.solving.engines import solve
from comity_domain.tours.tour import tour_cost
from comity_fis import InputError

CORE = ("at", "free", "greeted", "reachable", "permitted", "route", "travel_cost", "greet_cost")
KINDS = ("robot", "place", "side", "modality", "gesture", "user")


def under_way(request):
    """The same with a greeting that is over wherever something else is to be done."""
    visitees = tuple(replace(each, greeted=bool(each.agenda)) for each in request.visitees)
    return replace(request, visitees=visitees, companies=())


def without_deadlines(request):
    return replace(request, visitees=tuple(replace(each, by_s=None) for each in request.visitees))


@needs_fast_downward
@pytest.mark.parametrize("kind", ["agendas", "agendas under way", "companies and priorities"])
@pytest.mark.parametrize("seed", [4, 5])
def test_an_optimal_engine_finds_the_same_cost_with_parameters_and_reasons(
    agenda_request, rich_request, kind, seed
):
    request = (rich_request if kind.startswith("companies") else agenda_request)(2 + seed % 2, seed)
    request = without_deadlines(under_way(request) if kind.endswith("way") else request)
    ours, theirs = make_plan(request), plan_with("fast-downward-opt", request)
    assert ours.optimal
    assert theirs.optimal
    assert theirs.cost == ours.cost
    assert theirs.engine == "fast-downward-opt"
    assert {step.person for step in theirs.steps} == {step.person for step in ours.steps}
    for step in theirs.steps:
        assert step.why.text
        same = [one for one in ours.steps if (one.action, one.arguments) == (step.action, step.arguments)]
        assert all(one.parameters == step.parameters for one in same)


@needs_fast_downward
def test_the_price_of_a_dropped_visit_is_part_of_every_engine_s_cost(corridor, with_skips):
    request = with_skips(corridor(), {"cem": 2.9})
    assert plan_with("fast-downward-opt", request).cost == make_plan(request).cost == 600 + 290


@pytest.mark.parametrize("seed", [1, 2])
def test_enhsp_reads_the_problem_too(agenda_request, random_request, seed):
    """It takes no object called `start`, and a fact that an action adds and takes back for taken back."""
    pytest.importorskip("up_enhsp")
    if shutil.which("java") is None:
        pytest.skip("needs Java")
    for make in (agenda_request, random_request):
        request = without_deadlines(make(2, seed))
        assert plan_with("enhsp-opt", request).cost == make_plan(request).cost


@needs_fast_downward
@pytest.mark.parametrize("seed", range(3))
def test_an_order_that_is_asked_for_is_part_of_the_problem(rich_request, agenda_request, seed):
    """Another engine keeps it, at the cost of ours, whoever has an agenda or belongs to a group."""
    for make in (rich_request, agenda_request):
        request = without_deadlines(make(3, seed))
        first, last = visited(make_plan(request))[:: len(request.visitees) - 1]
        asks = (replace(each, after=last if each.name == first else None) for each in request.visitees)
        turned = replace(request, visitees=tuple(asks))
        ours, theirs = make_plan(turned), plan_with("fast-downward-opt", turned)
        assert theirs.cost == ours.cost
        assert visited(theirs).index(last) < visited(theirs).index(first)


def visited(plan) -> list[str]:
    """Who is greeted, in order."""
    return list(dict.fromkeys(name for step in plan.steps for name in step.people))


def test_an_engine_that_is_not_installed_is_refused_with_those_that_are(rich_request):
    for none in ("fast-upward", "up_grounder"):  # which unified-planning finds, and which does not plan
        with pytest.raises(InputError) as refused:
            plan_with(none, rich_request(2, 0))
        assert "fast-downward" in str(refused.value)
        assert "sequential_simulator" not in str(refused.value)


def test_a_deadline_is_never_left_out_silently(infer, request_for):
    request = request_for({"johanna": infer()})
    by_s = tuple(replace(one, by_s=60.0) for one in request.visitees)
    hurried = replace(request, visitees=by_s, durations_s={(None, "johanna"): 5.0})
    with pytest.raises(InputError, match="deadline"):
        plan_with("fast-downward-opt", hurried)


@needs_fast_downward
def test_plans_of_the_core_are_plans_of_the_whole_at_equal_cost(infer, request_for):
    """Its facts are those of the whole, without hands and turns."""
    request = request_for(
        {"johanna": infer(), "omar": infer(direction=90.0), "ada": infer(modality="both", gesture="wave")}
    )
    choices = options(request)
    names = visit_names(choices)
    domain = files("comity_domain").joinpath("core.pddl").read_text(encoding="ascii")

    def atom(fact) -> str:
        words = [names.ids[word] for word in fact.arguments if word.kind in KINDS]
        text = f"({' '.join([fact.fluent, *words])})"
        return text if fact.value is True else f"(= {text} {fact.value})"

    problem = "\n".join(
        [
            "(define (problem core) (:domain core-domain) (:objects",
            *(f"{id_} - {word.kind}" for id_, word in names.words.items() if word.kind in KINDS),
            ") (:init (= (total-cost) 0)",
            *(atom(fact) for fact in initial_state(choices) if fact.fluent in CORE),
            ") (:goal (and",
            *map(atom, goals(choices)),
            ")) (:metric minimize (total-cost)))",
        ]
    )
    with fresh_environment(whole=True) as environment:
        read = PDDLReader(environment).parse_problem_string(domain, problem)
        found = solve(read, engine="fast-downward-opt", time_limit_s=60.0)
    visits = tour_of(((one.name, one.arguments) for one in found.actions), choices, names)
    assert tour_cost(visits, choices) == make_plan(request).cost


@needs_fast_downward
def test_an_engine_that_is_a_script_finds_its_modules_where_python_does_not_look_beside_scripts(
    rich_request, monkeypatch
):
    request = without_deadlines(rich_request(2, 4))
    monkeypatch.setenv("PYTHONSAFEPATH", "1")
    assert plan_with("fast-downward-opt", request).cost == make_plan(request).cost


def test_that_there_is_no_plan_is_not_believed_where_there_is_one(rich_request, monkeypatch):
    """As an engine says that does not read all of the domain."""

    def says_none(*_, **__):
        raise NoPlan("no plan reaches all goals, says fast-downward-opt", remedy="Look for a goal.")

    monkeypatch.setattr("comity_domain.custom.process.in_one_process", says_none)
    monkeypatch.setattr("comity_domain.custom.solving.choosing.require_installed", lambda _: None)
    with pytest.raises(PlanningFailed) as refused:
        plan_with("fast-downward-opt", without_deadlines(rich_request(2, 4)))
    assert not isinstance(refused.value, NoPlan)
