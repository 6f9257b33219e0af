"""When time or memory runs out, the best plan so far stands, with what no plan can fall below."""

from __future__ import annotations

import os
import random
import signal
import tempfile
import threading
import time
from math import dist
from pathlib import Path

import pytest

from comity.report.custom_domain.plan import custom_plan_answer
from comity.report.plans.proof import quality
from comity_domain.custom import bind, plan_custom, read_custom
from comity_domain.custom.solving import engines
from comity_domain.custom.solving.choosing import FAST_DOWNWARD
from comity_domain.custom.solving.engines import solve
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import works

DOMAIN = """(define (domain rounds)
  (:types place)
  (:predicates (at ?p - place) (road ?a ?b - place) (seen ?p - place))
  (:functions (way ?a ?b - place) (total-cost))
  (:action go
    :parameters (?a ?b - place)
    :precondition (and (at ?a) (road ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (seen ?b) (increase (total-cost) (way ?a ?b)))))
"""


def roads(points: list[tuple[float, float]]) -> set[frozenset[int]]:
    """To the three nearest places, and as many more as connect all."""
    places = range(len(points))

    def nearest(place: int, others) -> list[int]:
        return sorted(others, key=lambda other: dist(points[place], points[other]))

    near = {frozenset((one, two)) for one in places for two in nearest(one, {*places} - {one})[:3]}
    return near | {frozenset((one, nearest(one, range(one))[0])) for one in places[1:]}


@pytest.fixture
def rounds(tmp_path):
    """Makes the problem to see so many places."""

    def make(count: int, domain: str = DOMAIN):
        draw = random.Random(2)
        points = [(draw.uniform(0, 100), draw.uniform(0, 100)) for _ in range(count)]
        ways = sorted((*sorted(road), dist(*(points[end] for end in road))) for road in roads(points))
        facts = [
            f"(road p{a} p{b}) (= (way p{a} p{b}) {way:.2f})"
            for one, two, way in ways
            for a, b in ((one, two), (two, one))
        ]
        names = " ".join(f"p{place}" for place in range(count))
        seen = " ".join(f"(seen p{place})" for place in range(1, count))
        (tmp_path / "d.pddl").write_text(domain)
        (tmp_path / "p.pddl").write_text(
            f"(define (problem all) (:domain rounds) (:objects {names} - place)"
            f" (:init (at p0) {' '.join(facts)}) (:goal (and {seen})) (:metric minimize (total-cost)))"
        )
        return bind(read_custom(tmp_path / "d.pddl", tmp_path / "p.pddl"))

    return make


def is_valid(bound, plan) -> bool:
    return works(
        [GroundAction(step.action.lower(), tuple(map(str.lower, step.arguments))) for step in plan.steps],
        bound,
    )


def test_a_large_round_trip_has_a_plan_and_a_bound_when_time_runs_out(rounds):
    """61 places: A* with the FF heuristic alone finds nothing in this time."""
    bound = rounds(61)
    plan = plan_custom(bound, time_limit_s=3).plan
    assert is_valid(bound, plan)
    assert 0 < plan.bound < plan.cost
    assert not plan.optimal
    assert not plan.reproducible
    assert not plan.killed, "its own limit ended it"


def kill_once_there_is_a_plan(folder: Path) -> None:
    """The search that works below a folder."""
    for _ in range(600):
        for entry in Path("/proc").glob("[0-9]*") if list(folder.glob("*/plan.*")) else ():
            try:
                at, runs = str((entry / "cwd").readlink()), (entry / "cmdline").read_text()
            except OSError:
                continue
            if str(folder) in at and "bin/downward" in runs:
                os.kill(int(entry.name), signal.SIGKILL)
                return
        time.sleep(0.05)


@pytest.mark.skipif(not Path("/proc/self/cwd").exists(), reason="looks processes up in /proc")
def test_a_plan_found_before_the_engine_was_killed_stands_and_says_so(rounds, tmp_path, monkeypatch):
    bound = rounds(61)
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    threading.Thread(target=kill_once_there_is_a_plan, args=(temporary,)).start()
    found = plan_custom(bound, time_limit_s=60)
    assert is_valid(bound, found.plan)
    assert found.plan.killed
    assert not found.plan.reproducible
    answer = custom_plan_answer(bound, found, renamed={}, files=())
    assert answer.killed
    assert quality(answer).endswith("fast-downward was killed from outside, so plan again")


def test_quick_searches_change_nothing_about_a_plan_that_is_proven(rounds, monkeypatch):
    """Nor does it matter where the clock cuts them off: of plans as cheap, the proof's own one counts."""
    bound, quick = rounds(7), engines.search_for
    found = []
    for search in (lambda *_: "iterated([astar(lmcut())])", lambda one, _: quick(one, 0.001), quick):
        monkeypatch.setattr(engines, "search_for", search)
        found.append(solve(bound.problem, engine=FAST_DOWNWARD, time_limit_s=60))
    assert all(one.finished for one in found)
    assert found[0].actions == found[1].actions == found[2].actions
