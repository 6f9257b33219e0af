"""Where deadlines are in the way, the answer says whose, and which would do; or that it ran out of time."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import count

import pytest
import yaml

from comity.live_episode import execute
from comity.planning.diagnosis import GoalsUnmet
from comity.planning.request import spots_of
from comity.planning.travel_distances import TravelDistances
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain import visits_of
from comity_domain.choices.options import options
from comity_domain.tours.tour import end_times_s

HALL = """\
schema_version: 1
name: hall
place: {width_m: 12, height_m: 9}
robot: {at_m: [1, 1]}
"""
PLACES = ((3.2, 1.4), (2.0, 4.0), (3.6, 6.6), (6.4, 6.8), (9.6, 6.0), (8.4, 3.4), (6.6, 1.6), (10.6, 1.6))


@pytest.fixture
def planned(comity, here):
    """The answer of `comity plan --json` for some people with these deadlines."""

    def answer(deadlines: dict[int, float], *, count: int = 4, planning_s: float = 30.0):
        people = {
            f"p{i}": {"profile": "german_man", "at_m": list(PLACES[i]), "facing_deg": 70 * i - 180}
            for i in range(count)
        }
        goals = [
            {"greet": f"p{i}", **({"by_s": deadlines[i]} if i in deadlines else {})} for i in range(count)
        ]
        more = {"people": people, "goals": goals, "limits": {"planning_s": planning_s}}
        (here / "hall.scenario.yaml").write_text(HALL + yaml.safe_dump(more))
        return comity("plan", "hall.scenario.yaml", "--json").json

    return answer


def granted(answer) -> dict[int, float]:
    """The deadlines that the conditions name."""
    texts = [condition["text"] for goal in answer["unmet"] for condition in goal["conditions"]]
    found = [re.fullmatch(r"p(\d+) could be greeted by (\d+) s instead of \d+ s", text) for text in texts]
    return {int(match[1]): float(match[2]) for match in found if match}


def test_who_is_too_far_off_for_their_deadline_is_named_with_one_that_would_do(planned):
    answer = planned({3: 12.0})
    (goal,) = answer["unmet"]
    assert goal["person"] == "p3"
    assert goal["complete"]
    assert "cannot be kept even if they are visited first" in goal["reason"]
    assert answer["reproducible"], "no clock had a part in it"
    assert [answer[key] for key in ("cost", "bound", "gap")] == [None, None, None], "there is no plan"
    assert planned({3: 12.0, **granted(answer)})["solved"]


def test_several_short_deadlines_are_all_named_and_those_that_would_do_can_be_kept_together(planned):
    asked = {0: 14.0, 1: 15.0, 2: 50.0, 3: 20.0}
    answer = planned(asked)
    assert {"p0", "p1", "p3"} <= {name for goal in answer["unmet"] for name in goal["person"].split(", ")}
    assert planned({**asked, **granted(answer)})["solved"]


def test_a_deadline_that_may_give_way_in_the_place_of_another_says_so(planned):
    """One of two excludes the other; who is too far off was granted what goes with the first."""
    answer = planned({0: 3.0, 3: 40.0, 4: 40.0}, count=5)
    reasons = {goal["person"]: goal["reason"] for goal in answer["unmet"]}
    first, second = (reasons[name] for name in ("p3", "p4"))
    assert first == "the deadline cannot be kept together with the others"
    assert second == "the deadline may give way in the place of p3's, with other ones for p0"


def test_there_is_a_plan_also_where_there_is_hardly_time_and_it_is_not_called_reproducible(planned):
    answer = planned({3: 200.0}, count=8, planning_s=0.001)
    assert answer["solved"]
    assert not answer["reproducible"]
    assert answer["bound"] <= answer["cost"]


def test_without_time_deadlines_that_exclude_each_other_are_named_and_the_setting_that_gives_more(planned):
    answer = planned({3: 40.0, 4: 40.0}, count=8, planning_s=0.001)
    (goal,) = answer["unmet"]
    assert goal["person"] == "p3, p4"
    assert not goal["complete"]
    assert not answer["reproducible"]
    assert "`limits: {planning_s: 0.004}`" in answer["failure"]["remedy"]
    assert "it is 0.001 now" in answer["failure"]["remedy"]


def test_when_time_is_up_who_is_out_of_reach_alone_is_named_without_the_others(here, monkeypatch):
    """By a clock that goes on with every look at it: p0 is known by then, and little else."""
    people = {f"p{i}": {"profile": "german_man", "at_m": list(PLACES[i])} for i in range(8)}
    goals = [{"greet": f"p{i}", "by_s": 3 if i == 0 else 60} for i in range(8)]
    (here / "hall.scenario.yaml").write_text(HALL + yaml.safe_dump({"people": people, "goals": goals}))
    with pytest.raises(GoalsUnmet) as failed:
        prepare(load_scenario("hall.scenario.yaml"))
    assert not failed.value.cut_off, "there is time enough by the machine's clock"
    ticks = count()
    for module in ("labelling.punctual", "problem.measuring", "labelling.search"):
        monkeypatch.setattr(f"comity_domain.{module}.monotonic", lambda: float(next(ticks)))
    monkeypatch.setattr("comity.preparation.monotonic", lambda: 30.0)
    with pytest.raises(GoalsUnmet) as failed:
        prepare(load_scenario("hall.scenario.yaml"))
    (goal,) = failed.value.unmet
    assert goal.person == "p0"
    assert failed.value.cut_off


@pytest.mark.parametrize("profile", ["arab_woman", "german_man"])
@pytest.mark.parametrize(
    "scenario", ["two-visits", "blocked-front", "comity-bench-1/row-of-three", "tea-visit"]
)
def test_nobody_is_greeted_later_than_deadlines_reckon_where_nothing_comes_between(scenario, profile):
    """Planned arrival against executed arrival, in shipped scenarios in which nobody moves."""
    file = load_scenario(scenario)
    prepared = prepare(file, profiles=dict.fromkeys(file.scenario.visited(), profile))
    request = prepared.asked.request
    scene, routes = prepared.scene, prepared.route_map
    own = {each.name: [*spots_of(scene, routes, each).values()] for each in request.visitees}
    ways = TravelDistances(scene, routes, own, prepared.asked.places)
    durations = {way: journey.seconds(prepared.attend_s) for way, journey in ways.all_measured().items()}
    visits = visits_of(prepared.plan)
    reckoned = end_times_s(visits, replace(options(request), durations_s=durations))
    events = execute(prepared, seed=0).events
    for visit, by_s in zip(visits, reckoned, strict=True):
        (greet,) = (
            step
            for step in prepared.plan.steps
            if step.action.startswith("Greet") and step.person == visit.spot.place
        )
        node = f"{greet.action}({visit.spot.place})"
        greeted_s = min(event.t for event in events if event.node == node and event.status == "success")
        assert greeted_s < by_s


def test_a_plan_that_the_clock_had_no_part_in_is_reproducible(here, planned):
    answer = planned({0: 100.0, 3: 200.0})
    assert answer["solved"]
    assert answer["reproducible"]
    again = prepare(load_scenario("hall.scenario.yaml")).plan
    assert again.cost == answer["cost"]
