"""scikit-fuzzy's control system: a fresh simulation per call, since a used one keeps old answers."""

from __future__ import annotations

from functools import reduce
from operator import and_
from typing import Any

from shapes import degrees, universe
from skfuzzy import control

POINTS = 101


class System:
    """One `ControlSystem`."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.answer = description["answer"]
        inputs = {
            name: _filled(control.Antecedent(universe(of, POINTS), name), of)
            for name, of in description["inputs"].items()
        }
        outputs = {
            name: _filled(control.Consequent(universe(of, POINTS), name), of)
            for name, of in description["outputs"].items()
        }
        self.system = control.ControlSystem(
            [
                control.Rule(
                    reduce(and_, [inputs[name][term] for name, term in rule["if"]]),
                    [outputs[name][term] for name, term in rule["then"]],
                )
                for rule in description["rules"]
            ]
        )

    def one(self, row: dict[str, float]) -> float:
        """One simulation."""
        simulation = control.ControlSystemSimulation(self.system)
        for name, value in row.items():
            simulation.input[name] = value
        simulation.compute()
        return float(simulation.output[self.answer])

    def many(self, columns: dict[str, Any]) -> Any:
        """One simulation of arrays."""
        simulation = control.ControlSystemSimulation(self.system)
        for name, column in columns.items():
            simulation.input[name] = column.astype(float)
        simulation.compute()
        return simulation.output[self.answer]


def _filled(variable: Any, of: dict[str, Any]) -> Any:
    for term, shape in of["terms"].items():
        variable[term] = degrees(shape, variable.universe)
    return variable
