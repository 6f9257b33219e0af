"""Min, max and the centre of area with numpy on a grid, by hand: for any system, vectorised over people."""

from __future__ import annotations

from typing import Any

import numpy as np
from shapes import degrees, universe

POINTS = 1001
CHUNK = 256
"""People at a time: a chunk of sets is 2 MB."""


class System:
    """The sets of a chunk of people, sampled; nothing is checked, nothing explained."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.description = description
        of = description["outputs"][description["answer"]]
        self.xs = universe(of, POINTS)
        self.sampled = {term: degrees(shape, self.xs) for term, shape in of["terms"].items()}

    def one(self, row: dict[str, float]) -> float:
        """One input, as a column of one."""
        return float(self.many({name: np.array([x]) for name, x in row.items()})[0])

    def many(self, columns: dict[str, Any]) -> Any:
        """A column, in chunks."""
        out = np.empty(len(next(iter(columns.values()))))
        for start in range(0, len(out), CHUNK):
            part = slice(start, start + CHUNK)
            out[part] = self._chunk({name: column[part] for name, column in columns.items()})
        return out

    def _chunk(self, columns: dict[str, Any]) -> Any:
        answer = self.description["answer"]
        strengths: dict[str, Any] = {}
        for rule in self.description["rules"]:
            terms = [term for name, term in rule["then"] if name == answer]
            held = [
                degrees(self.description["inputs"][name]["terms"][term], columns[name])
                for name, term in rule["if"]
            ]
            for term in terms:
                strength = np.minimum.reduce(held)
                strengths[term] = np.maximum(strengths.get(term, 0.0), strength)
        sets = np.zeros((len(next(iter(columns.values()))), len(self.xs)))
        for term, strength in strengths.items():
            np.maximum(sets, np.minimum(strength[:, None], self.sampled[term]), out=sets)
        return (sets @ self.xs) / sets.sum(axis=1)
