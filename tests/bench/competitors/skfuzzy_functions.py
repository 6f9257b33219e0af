"""scikit-fuzzy's plain functions, 101 points, as its documentation uses them."""

from __future__ import annotations

from typing import Any

import numpy as np
import skfuzzy as fuzz
from shapes import degrees, universe

POINTS = 101


class System:
    """Memberships of the inputs by formula, the output set by samples."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.description = description
        self.outputs = {name: universe(of, POINTS) for name, of in description["outputs"].items()}
        self.sampled = {
            (name, term): degrees(shape, self.outputs[name])
            for name, of in description["outputs"].items()
            for term, shape in of["terms"].items()
        }

    def one(self, row: dict[str, float]) -> float:
        """All outputs; the one that is compared is returned."""
        inputs = self.description["inputs"]
        known = {
            (name, term): float(degrees(shape, np.array([row[name]]))[0])
            for name, of in inputs.items()
            for term, shape in of["terms"].items()
        }
        sets = {name: np.zeros(len(xs)) for name, xs in self.outputs.items()}
        for rule in self.description["rules"]:
            strength = min(known[name, term] for name, term in rule["if"])
            for name, term in rule["then"]:
                sets[name] = np.fmax(sets[name], np.fmin(strength, self.sampled[name, term]))
        values = {
            name: fuzz.defuzz(xs, sets[name], "centroid") if sets[name].any() else float(xs.mean())
            for name, xs in self.outputs.items()
        }
        return float(values[self.description["answer"]])

    def many(self, columns: dict[str, Any]) -> Any:
        """One after the other: the functions take no columns."""
        size = len(next(iter(columns.values())))
        return [self.one({name: column[i] for name, column in columns.items()}) for i in range(size)]
