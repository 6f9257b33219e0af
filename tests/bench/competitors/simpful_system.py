"""simpful with its default settings."""

from __future__ import annotations

from math import exp
from typing import Any

import simpful


class System:
    """One `FuzzySystem`; categories and names as they are."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.answer = description["answer"]
        self.system = simpful.FuzzySystem(show_banner=False)
        for kind in ("inputs", "outputs"):
            for name, of in description[kind].items():
                sets = [simpful.FuzzySet(function=_function(s), term=t) for t, s in of["terms"].items()]
                variable = simpful.LinguisticVariable(sets, universe_of_discourse=of["range"])
                self.system.add_linguistic_variable(name, variable)
        self.outputs = list(description["outputs"])
        self.system.add_rules(
            [
                f"IF {_joined(rule['if'])} THEN ({name} IS {term})"
                for rule in description["rules"]
                for name, term in rule["then"]
            ]
        )

    def one(self, row: dict[str, float]) -> float:
        """One inference; outputs for which nothing fires are left out by simpful itself."""
        for name, value in row.items():
            self.system.set_variable(name, value)
        return float(self.system.Mamdani_inference(self.outputs)[self.answer])

    def many(self, columns: dict[str, Any]) -> Any:
        """One after the other."""
        size = len(next(iter(columns.values())))
        return [self.one({name: float(column[i]) for name, column in columns.items()}) for i in range(size)]


def _joined(parts: list[list[str]]) -> str:
    """Simpful joins two at a time."""
    text = f"({parts[0][0]} IS {parts[0][1]})"
    for name, term in parts[1:]:
        text = f"({text} AND ({name} IS {term}))"
    return text


def _function(shape: dict[str, Any]) -> Any:
    if "trapezoid" in shape:
        return simpful.Trapezoidal_MF(*shape["trapezoid"])
    bumps = shape["two_term_gaussian"]
    return lambda x: min(1.0, sum(a * exp(-(((x - b) / c) ** 2)) for a, b, c in bumps))
