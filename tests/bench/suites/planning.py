"""From people with parameters to a plan, and from an old plan to new numbers, against the bare engines.

All engines get the PDDL that Comity exports. Everything is wall clock: an engine is a process of its own.
"""

from __future__ import annotations

import random
import re
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from comity.custom_domain import bound_domain
from comity_domain import START, Plan, Spot, Visitee, VisitRequest, make_plan, plan_pddl, rebind
from comity_domain.custom import custom_pddl, plan_custom
from comity_domain.custom.solving.searching import search_for
from comity_fis import load_rulebook
from tests.bench.contest import Bench, in_turn
from tests.bench.engines import LIMIT_S, Engine, fast_downward, first_plan, symk
from tests.bench.environment import NotInstalledError
from tests.bench.rows import Row

SIDES = ("front", "left", "right")
PAGE = Path(__file__).parents[3] / "docs" / "how-to" / "use-a-custom-domain.md"
REBINDINGS = 10
"""For one turn: a single one is too short for the clock."""


def run(bench: Bench) -> list[Row]:
    """4, 8 and 12 people, then the waiter of the documentation; 2 people for a smoke run."""
    rows = [row for people in ((2,) if bench.quick else (4, 8, 12)) for row in _visits(bench, people)]
    return rows + _waiter(bench)


def _visits(bench: Bench, people: int) -> list[Row]:
    request = _request(people)
    plan, pddl = make_plan(request), plan_pddl(request)
    turns: dict[str, Callable[[], float]] = {
        "bare Fast Downward": partial(_run, fast_downward(), pddl),
        "comity": partial(_seconds, lambda: make_plan(request)),
        "comity, rebinding": lambda: _seconds(lambda: _rebound(plan, request)) / REBINDINGS,
    }
    task = f"{people} people"
    rows = in_turn(turns, rounds=_rounds(bench, people), suite="planning", task=task, per="plan")
    if bench.ours_only:
        return rows
    return rows + [_once(name, engine, pddl, plan.cost, rows[0]) for name, engine in _others().items()]


def _rebound(plan: Plan, request: VisitRequest) -> None:
    for _ in range(REBINDINGS):
        rebind(plan, request)


def _once(name: str, engine: Engine, pddl: tuple[str, str], optimum: int, first: Row) -> Row:
    """Another engine, timed once: it is here for what its plans cost and for how it grows."""
    run = engine(*pddl)
    return Row(
        suite="planning",
        task=first.task,
        contestant=name,
        seconds=(run.seconds,),
        per="plan",
        ratios=(run.seconds / median(first.seconds),),
        note=_quality(run.cost, optimum),
    )


def _rounds(bench: Bench, people: int) -> int:
    return min(bench.rounds, 5 if people < 12 else 3)


def _others() -> dict[str, Engine]:
    """Other engines and other ways to ask."""
    found = {
        "Fast Downward, blind A*": fast_downward("astar(blind())"),
        "Fast Downward, first plan of LAMA": first_plan(),
    }
    try:
        return {**found, "SymK": symk()}
    except NotInstalledError:
        return found


def _quality(cost: int | None, optimum: int) -> str:
    if cost is None:
        return "no plan in time"
    return "the optimum" if cost == optimum else f"{cost / optimum:.2f} times the optimal cost"


def _waiter(bench: Bench) -> list[Row]:
    """A custom domain: files read, bound and planned, against the bare engine on what is exported."""
    blocks = re.findall(r"^```\w+ (\S+)\n(.*?)^```$", PAGE.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    with TemporaryDirectory(prefix="comity-bench-") as name:
        folder = Path(name)
        for file, text in blocks:
            (folder / file).write_text(text, encoding="utf-8")
        files = folder / "waiter.pddl", folder / "evening.pddl", folder / "waiter.yaml"
        bound = bound_domain(*files)
        texts, search = custom_pddl(bound), search_for(bound.problem, LIMIT_S)
        turns = {
            "bare Fast Downward": partial(_run, fast_downward(search), (texts.domain, texts.problem)),
            "comity, bound already": partial(_seconds, lambda: plan_custom(bound)),
            "comity, from the files": partial(_seconds, lambda: plan_custom(bound_domain(*files))),
        }
        return in_turn(turns, rounds=_rounds(bench, 2), suite="planning", task="the waiter", per="plan")


def _run(engine: Engine, pddl: tuple[str, str]) -> float:
    return engine(*pddl).seconds


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
