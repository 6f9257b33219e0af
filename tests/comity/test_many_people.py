"""Of many people only the ways that a plan takes are measured, and it is the cheapest plan all the same."""

from __future__ import annotations

import pytest

from comity.planning import request
from comity.preparation import prepare
from comity.scenario import load_scenario

HALL = """\
schema_version: 1
name: hall
place:
  width_m: 10
  height_m: 9
  walls_m: [[[5, 0], [5, 6]]]
robot: {at_m: [1, 1]}
people:
"""
PROFILES = ("arab_woman", "german_woman", "arab_man", "german_man")
PLACES = ((3.2, 1.4), (2.0, 4.0), (6.4, 6.8), (8.6, 6.0), (6.6, 1.6))


@pytest.fixture
def hall(here):
    """The scenario with its people; with deadlines, where wanted."""

    def written(deadlines: bool):
        people = "".join(
            f"  p{i}: {{profile: {PROFILES[i % 4]}, at_m: [{x}, {y}], facing_deg: {70 * i - 180}}}\n"
            for i, (x, y) in enumerate(PLACES)
        )
        within = {0: ", by_s: 60", 4: ", by_s: 150, priority: 1"} if deadlines else {}
        goals = "".join(f"  - {{greet: p{i}{within.get(i, '')}}}\n" for i in range(len(PLACES)))
        (here / "hall.scenario.yaml").write_text(f"{HALL}{people}goals:\n{goals}")
        return load_scenario("hall.scenario.yaml")

    return written


@pytest.mark.parametrize("deadlines", [False, True])
def test_a_plan_among_many_costs_what_it_costs_with_all_ways_measured(hall, monkeypatch, deadlines: bool):
    file = hall(deadlines)
    some = prepare(file)
    monkeypatch.setattr(request, "MOST_MEASURED", len(PLACES))
    everything = prepare(file)
    assert some.asked.request.survey is not None
    assert everything.asked.request.survey is None
    assert some.plan.optimal
    assert everything.plan.optimal
    assert some.plan.cost == everything.plan.cost
    bounds, lengths = some.asked.request, everything.asked.request
    assert all(bounds.travel[leg] <= length for leg, length in lengths.travel.items())
    assert all(bounds.durations_s[way] <= seconds for way, seconds in lengths.durations_s.items())
