"""What an explanation costs beside the inference that it explains.

Contributions and derivatives come with the value for a few inferences' worth; everything else (leaving out
each rule, what other inputs would give, the nearest flip) asks again and grows linearly with the rules.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from itertools import product

from comity_fis import Rulebook, explain, load_rulebook
from comity_fis.explanation import attributed
from comity_fis.interval import Interval
from comity_fis.measurement import Level
from comity_fis.membership import Trapezoid
from comity_fis.reading import reading
from comity_fis.rule import And, Is, Rule
from comity_fis.variable import NumericVariable
from tests.bench.contest import Bench, in_turn
from tests.bench.rows import Row

Inputs = dict[str, float | str | None]


def run(bench: Bench) -> list[Row]:
    """One inference, the same with contributions and derivatives, and everything there is to say."""
    rows: list[Row] = []
    for task, (rulebook, inputs, parameter) in _cases().items():
        calls = 3 if bench.quick or len(rulebook.rules) > 100 else 200
        turns = {name: _timed(do, calls) for name, do in _contestants(rulebook, inputs, parameter).items()}
        rows += in_turn(turns, rounds=bench.rounds, suite="explaining", task=task, per="call")
    return rows


def _contestants(rulebook: Rulebook, inputs: Inputs, parameter: str) -> dict[str, Callable[[], object]]:
    def with_contributions() -> None:
        inference = rulebook.infer(inputs)
        attribution, _ = attributed(rulebook, inference, reading(rulebook, inference, parameter))
        attribution.portions()

    return {
        "infer": lambda: rulebook.infer(inputs),
        "with contributions and derivatives": with_contributions,
        "explain": lambda: explain(rulebook, inputs, parameter),
    }


def _timed(do: Callable[[], object], calls: int) -> Callable[[], float]:
    """Seconds of processor time per call."""

    def turn() -> float:
        start = time.process_time()
        for _ in range(calls):
            do()
        return (time.process_time() - start) / calls

    return turn


def _cases() -> dict[str, tuple[Rulebook, Inputs, str]]:
    woman: Inputs = {"individualism": 67.0, "gender": "female"}
    distance = "conversational_distance"
    return {
        "case 2, 4 rules": (load_rulebook("bruno2017-case2"), woman, distance),
        "bruno2017, all parameters inferred": (load_rulebook("bruno2017"), woman, distance),
        **{f"6 inputs, {rules} rules": (*grid(rules), distance) for rules in (135, 270, 540)},
    }


def grid(rules: int) -> tuple[Rulebook, Inputs]:
    """A rulebook of six inputs with three overlapping terms each, and an input that makes 64 rules fire."""
    names = [f"x{i}" for i in range(1, 7)]
    terms = {
        "low": Trapezoid(0, 0, 2, 5),
        "middle": Trapezoid(2, 5, 5, 8),
        "high": Trapezoid(5, 8, 10, 10),
    }
    paper = load_rulebook("bruno2017-case2")
    distance = paper.parameters["conversational_distance"]
    outputs, made = list(distance.terms), []
    # `middle` and `high` first: the input below lies between them.
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
    return rulebook, {name: 6.0 + i / 10 for i, name in enumerate(names)}
