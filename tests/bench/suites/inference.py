"""One inference and many, against other fuzzy libraries and against numpy by hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

from comity_fis import load_rulebook
from tests.bench.contest import Bench, Contestant, ContestantError, built, calls_for, in_turn
from tests.bench.description import Description, as_yaml, described, gaussians, grid
from tests.bench.rows import Row

SIZES = (1_000, 100_000, 1_000_000)
CURVED_SIZES = (1_000, 10_000)
CASE_2_BY_HAND = {"numpy by hand": "numpy_closed_form", "plain Python by hand": "plain_python_closed_form"}
GAUSSIANS_BY_HAND = {"numpy grid by hand": "numpy_grid"}
"""What a programmer writes who needs only this, with the module in `competitors/`."""
CAP_S = 10.0
"""A turn that would take longer is made with fewer inputs, and the note says so."""

RULES_FOR_CONTROL = 60
"""scikit-fuzzy's control system takes minutes to build more rules of the grid: everybody gets these, too."""


def run(bench: Bench) -> list[Row]:
    """All tasks."""
    case2 = described(load_rulebook("bruno2017-case2"), answer="conversational_distance")
    whole = described(load_rulebook("bruno2017"), answer="conversational_distance")
    curved = gaussians()
    curved["yaml"] = as_yaml(curved)
    return [
        *_task(bench, "case 2", case2, SIZES, by_hand=CASE_2_BY_HAND),
        *_task(bench, "bruno2017", whole, SIZES[:2]),
        *_task(bench, "Gaussians", curved, CURVED_SIZES, by_hand=GAUSSIANS_BY_HAND),
        *_grid(bench),
    ]


def _everybody(bench: Bench, by_hand: Mapping[str, str]) -> list[Contestant]:
    hand = [Contestant(name, module) for name, module in by_hand.items()]
    return bench.contestants(
        Contestant("comity", "ours"),
        *hand,
        Contestant("skfuzzy functions", "skfuzzy_functions", "skfuzzy"),
        Contestant("skfuzzy control", "skfuzzy_control", "skfuzzy"),
        Contestant("simpful", "simpful_system", "simpful"),
        Contestant("pyfuzzylite", "pyfuzzylite_engine", "pyfuzzylite"),
    )


def _task(
    bench: Bench,
    name: str,
    description: Description,
    sizes: tuple[int, ...],
    by_hand: Mapping[str, str] = MappingProxyType({}),
) -> list[Row]:
    """Building, one input at a time, and columns."""
    contestants = _everybody(bench, by_hand)
    try:
        ready, rows = built(contestants, description, suite="inference", task=f"{name}, load")
        rows += _one(bench, name, ready)
        for size in sizes[:1] if bench.quick else sizes:
            rows += _many(bench, name, ready, size)
    finally:
        for contestant in contestants:
            contestant.close()
    return rows


def _one(bench: Bench, name: str, ready: list[Contestant]) -> list[Row]:
    turns: dict[str, Callable[[], float]] = {}
    for contestant in ready:
        first = contestant.ask("one", calls=3)["seconds"]
        turns[contestant.name] = partial(_ask_one, contestant, calls_for(bench.round_s, first))
    return in_turn(turns, rounds=bench.rounds, suite="inference", task=f"{name}, one")


def _ask_one(contestant: Contestant, calls: int) -> float:
    seconds: float = contestant.ask("one", calls=calls)["seconds"]
    return seconds


def _many(bench: Bench, name: str, ready: list[Contestant], size: int) -> list[Row]:
    turns: dict[str, Callable[[], float]] = {}
    notes: dict[str, str] = {}
    peaks: dict[str, int] = {}
    failed: list[Row] = []
    task = f"{name}, {size} at once"
    for contestant in ready:
        try:
            per_input = _per_input(contestant, size)
            fitting = min(size, max(100, math.floor(CAP_S / bench.rounds / per_input)))
            if fitting < size:
                notes[contestant.name] = f"extrapolated from {fitting} inputs"
            elif not bench.quick:
                peaks[contestant.name] = contestant.ask("many", size=size, calls=1, memory=True)["peak_bytes"]
        except ContestantError as error:
            failed.append(Row(suite="inference", task=task, contestant=contestant.name, note=str(error)))
            continue
        calls = calls_for(bench.round_s, per_input * fitting)
        turns[contestant.name] = partial(_ask_many, contestant, fitting, calls)
    rows = in_turn(turns, rounds=min(bench.rounds, 5), suite="inference", task=task, per="input")
    return [_noted(row, peaks, notes) for row in rows] + failed


def _per_input(contestant: Contestant, size: int) -> float:
    """A first estimate, from columns long enough for the cost per call to vanish where that is affordable."""
    seconds: float = contestant.ask("many", size=100, calls=1)["seconds"]
    if size > 100 and seconds * 10_000 < 1:
        seconds = contestant.ask("many", size=10_000, calls=1)["seconds"]
    return seconds


def _ask_many(contestant: Contestant, size: int, calls: int) -> float:
    seconds: float = contestant.ask("many", size=size, calls=calls)["seconds"]
    return seconds


def _noted(row: Row, peaks: dict[str, int], notes: dict[str, str]) -> Row:
    return replace(row, peak_bytes=peaks.get(row.contestant), note=notes.get(row.contestant, ""))


def _grid(bench: Bench) -> list[Row]:
    """6 inputs and 540 rules: how long to compile, how long to infer."""
    return [*_grid_part(bench, 540, control=False), *_grid_part(bench, RULES_FOR_CONTROL, control=True)]


def _grid_part(bench: Bench, rules: int, *, control: bool) -> list[Row]:
    description: dict[str, Any] = grid(rules=None if rules == 540 else rules)
    description["yaml"] = as_yaml(description)
    contestants = [
        c for c in _everybody(bench, {}) if (c.module in {"ours", "skfuzzy_control"}) or not control
    ]
    contestants = [c for c in contestants if control or c.module != "skfuzzy_control"]
    name = f"6 inputs, {len(description['rules'])} rules"
    try:
        ready, rows = built(contestants, description, suite="inference", task=f"{name}, load")
        return [*rows, *_one(bench, name, ready)]
    finally:
        for contestant in contestants:
            contestant.close()
