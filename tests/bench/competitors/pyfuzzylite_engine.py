"""pyfuzzylite: one engine, 101 points, single values and its vectorised form."""

from __future__ import annotations

from typing import Any

import fuzzylite as fl
import numpy as np

POINTS = 101


class System:
    """One `Engine`."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.answer = description["answer"]
        self.engine = fl.Engine(
            name="bench",
            input_variables=[
                fl.InputVariable(name=name, minimum=of["range"][0], maximum=of["range"][1], terms=_terms(of))
                for name, of in description["inputs"].items()
            ],
            output_variables=[
                fl.OutputVariable(
                    name=name,
                    minimum=of["range"][0],
                    maximum=of["range"][1],
                    aggregation=fl.Maximum(),
                    defuzzifier=fl.Centroid(POINTS),
                    terms=_terms(of),
                )
                for name, of in description["outputs"].items()
            ],
        )
        block = fl.RuleBlock(
            conjunction=fl.Minimum(),
            disjunction=fl.Maximum(),
            implication=fl.Minimum(),
            activation=fl.General(),
        )
        for rule in description["rules"]:
            antecedent = " and ".join(f"{name} is {term}" for name, term in rule["if"])
            consequent = " and ".join(f"{name} is {term}" for name, term in rule["then"])
            block.rules.append(fl.Rule.create(f"if {antecedent} then {consequent}", self.engine))
        self.engine.rule_blocks.append(block)

    def one(self, row: dict[str, float]) -> float:
        """One value per input."""
        for name, value in row.items():
            self.engine.input_variable(name).value = value
        self.engine.process()
        return float(self.engine.output_variable(self.answer).value)

    def many(self, columns: dict[str, Any]) -> Any:
        """Arrays in the place of values."""
        for name, column in columns.items():
            self.engine.input_variable(name).value = column.astype(float)
        self.engine.process()
        return np.asarray(self.engine.output_variable(self.answer).value)


class TwoTermGaussian(fl.Term):
    """The paper's fitted shape."""

    def __init__(self, name: str, bumps: list[list[float]]) -> None:
        super().__init__(name)
        self.bumps = bumps

    def membership(self, x: Any) -> Any:
        """The degree of one number or of many."""
        return np.minimum(1.0, sum(a * np.exp(-(((x - b) / c) ** 2)) for a, b, c in self.bumps))


def _terms(of: dict[str, Any]) -> list[Any]:
    return [
        fl.Trapezoid(name, *shape["trapezoid"])
        if "trapezoid" in shape
        else TwoTermGaussian(name, shape["two_term_gaussian"])
        for name, shape in of["terms"].items()
    ]
