"""What an explanation costs beside the inference that it explains.

Contributions and derivatives come with the value for a few inferences' worth; everything else (leaving out
each rule, what other inputs would give, the nearest flip) asks again and grows linearly with the rules.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from itertools import product
from statistics import median

from comity_fis import Rulebook, explain, load_rulebook
from comity_fis.explanation import attributed
from comity_fis.interval import Interval
from comity_fis.measurement import Level
from comity_fis.membership import Trapezoid
from comity_fis.reading import reading
from comity_fis.rule import And, Is, Rule
from comity_fis.variable import NumericVariable

Inputs = dict[str, float | str | None]


def suite(rounds: int = 15) -> dict[str, dict[str, float]]:
    """By case: seconds of one inference and of one explanation, cheap part and whole, and their ratios."""
    return {name: _measured(*case, rounds=rounds) for name, case in _cases().items()}


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


def _measured(rulebook: Rulebook, inputs: Inputs, parameter: str, rounds: int) -> dict[str, float]:
    def cheap() -> None:
        inference = rulebook.infer(inputs)
        attribution, _ = attributed(rulebook, inference, reading(rulebook, inference, parameter))
        attribution.portions()

    tasks: tuple[Callable[[], object], ...] = (
        lambda: rulebook.infer(inputs),
        cheap,
        lambda: explain(rulebook, inputs, parameter),
    )
    for task in tasks:
        task()
    times = [[_seconds(task) for task in tasks] for _ in range(rounds)]
    infer, value, whole = (median(column) for column in zip(*times, strict=True))
    return {
        "infer_s": infer,
        "value_contributions_derivatives_s": value,
        "explain_s": whole,
        "value_contributions_derivatives_ratio": value / infer,
        "explain_ratio": whole / infer,
        "explain_per_rule_s": whole / len(rulebook.rules),
    }


def _seconds(task: Callable[[], object]) -> float:
    start = time.perf_counter()
    task()
    return time.perf_counter() - start


if __name__ == "__main__":
    import json

    print(json.dumps(suite(), indent=2))
