"""From people with parameters to a plan, against the bare engine on the same PDDL."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from functools import partial

from comity_domain import START, Spot, Visitee, VisitRequest, make_plan
from comity_domain.engine import search
from comity_domain.options import options
from comity_domain.visit_problem import visit_names, visit_problem
from comity_fis import load_rulebook
from tests.bench.contest import Bench, in_turn
from tests.bench.rows import Row

SIDES = ("front", "left", "right")


def run(bench: Bench) -> list[Row]:
    """4 and 8 people; 2 for a smoke run."""
    rows: list[Row] = []
    for people in (2,) if bench.quick else (4, 8):
        request = _request(people)
        turns = {
            "bare Fast Downward": _bare(request),
            "comity": partial(_seconds, lambda r=request: make_plan(r)),
        }
        rows += in_turn(
            turns, rounds=min(bench.rounds, 5), suite="planning", task=f"{people} people", per="plan"
        )
    return rows


def _bare(request: VisitRequest) -> Callable[[], float]:
    from unified_planning.io import PDDLWriter

    choices = options(request)
    writer = PDDLWriter(visit_problem(choices, visit_names(choices)))
    domain, problem = writer.get_domain(), writer.get_problem()
    return partial(_seconds, lambda: search(domain, problem, time_limit_s=60.0))


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _request(people: int) -> VisitRequest:
    """People of various cultures, all sides open, routes of any length."""
    draw = random.Random(people)
    rulebook = load_rulebook("bruno2017")
    visitees = tuple(
        Visitee(
            f"person {i}",
            rulebook.infer(
                {"individualism": draw.uniform(10, 90), "gender": draw.choice(["female", "male"])}
            ),
        )
        for i in range(people)
    )
    spots = [Spot(visitee.name, side) for visitee in visitees for side in SIDES]
    travel = {
        (start, end): draw.uniform(1.0, 20.0)
        for start in (START, *spots)
        for end in spots
        if start == START or start.place != end.place
    }
    return VisitRequest("robot", visitees, travel)
