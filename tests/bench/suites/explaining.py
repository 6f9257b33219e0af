"""What an explanation costs beside the inference that it explains.

Leaving out each rule, derivatives, what other inputs would give and the nearest flip infer again, so that the
cost grows with the rules. Inputs differ from call to call, as in the suite `inference`.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import cycle, product

from comity_fis import Rulebook, explain, load_rulebook
from comity_fis.membership.function import Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.rules.rule import And, Is, Rule
from comity_fis.variables.measurement import Level
from comity_fis.variables.variable import NumericVariable
from tests.bench.contest import Bench, calls_for, in_turn
from tests.bench.rows import Row

Inputs = dict[str, float | str | None]

ROWS = 512
"""Different inputs that calls walk through."""


def run(bench: Bench) -> list[Row]:
    """One inference, and everything there is to say of one value."""
    rows: list[Row] = []
    for task, (rulebook, inputs, parameter) in _cases().items():
        contestants = _contestants(rulebook, parameter)
        turns = {name: _timed(do, inputs, bench.round_s) for name, do in contestants.items()}
        rows += in_turn(turns, rounds=bench.rounds, suite="explaining", task=task, per="call")
    return rows


def _contestants(rulebook: Rulebook, parameter: str) -> dict[str, Callable[[Inputs], object]]:
    return {
        "infer": rulebook.infer,
        "explain": lambda inputs: explain(rulebook, inputs, parameter),
    }


def _timed(do: Callable[[Inputs], object], inputs: Sequence[Inputs], turn_s: float) -> Callable[[], float]:
    """Seconds of processor time per call, for as many calls as fill a turn."""
    first = _per_call(do, inputs[:3])
    calls = calls_for(turn_s, first)
    return partial(_per_call, do, [row for row, _ in zip(cycle(inputs), range(calls), strict=False)])


def _per_call(do: Callable[[Inputs], object], inputs: Sequence[Inputs]) -> float:
    start = time.process_time()
    for row in inputs:
        do(row)
    return (time.process_time() - start) / len(inputs)


def _cases() -> dict[str, tuple[Rulebook, Sequence[Inputs], str]]:
    draw = random.Random(0)
    people: list[Inputs] = [
        {"individualism": draw.uniform(0, 100), "gender": draw.choice(["female", "male"])}
        for _ in range(ROWS)
    ]
    distance = "conversational_distance"
    return {
        "case 2, 4 rules": (load_rulebook("bruno2017-case2"), people, distance),
        "bruno2017, all parameters inferred": (load_rulebook("bruno2017"), people, distance),
        **{f"6 inputs, {rules} rules": (*grid(rules), distance) for rules in (135, 540)},
    }


def grid(rules: int) -> tuple[Rulebook, Sequence[Inputs]]:
    """A rulebook of six inputs with three overlapping terms each, and inputs that make 64 rules fire."""
    names = [f"x{i}" for i in range(1, 7)]
    terms = {
        "low": Trapezoid(0, 0, 2, 5),
        "middle": Trapezoid(2, 5, 5, 8),
        "high": Trapezoid(5, 8, 10, 10),
    }
    paper = load_rulebook("bruno2017-case2")
    distance = paper.parameters["conversational_distance"]
    outputs, made = list(distance.terms), []
    # `middle` and `high` first: the inputs below lie between them.
    for number, chosen in enumerate(product(("middle", "high", "low"), repeat=6), 1):
        if number > rules:
            break
        parts = tuple(Is(name, term) for name, term in zip(names, chosen, strict=True))
        consequent = Is("conversational_distance", outputs[chosen.count("high") % 3])
        antecedent = And(parts)
        made.append(
            Rule(
                number=number,
                text=f"if {antecedent} then {consequent}",
                antecedent=antecedent,
                consequents=(consequent,),
                sources=(),
                evidence="design",
            )
        )
    variables = {
        name: NumericVariable(
            name=name, kind="culture", level=Level.INTERVAL, domain=Interval(0, 10), terms=terms
        )
        for name in names
    }
    rulebook = replace(
        paper, variables=variables, parameters={distance.name: distance}, rules=tuple(made), sources={}
    )
    draw = random.Random(0)
    return rulebook, [{name: draw.uniform(5, 8) for name in names} for _ in range(ROWS)]
