"""Comity itself, through its public calls."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from comity_fis import NominalVariable, Rulebook, load_rulebook


class System:
    """One rulebook; `one` is `infer` with all its records, and the number read from it."""

    def __init__(self, description: dict[str, Any]) -> None:
        self.answer = description["answer"]
        self.rulebook = _load(description)
        self.words = {
            name: variable.categories
            for name, variable in self.rulebook.variables.items()
            if isinstance(variable, NominalVariable)
        }
        self._said: dict[int, dict[str, Any]] = {}

    def one(self, row: dict[str, float]) -> float:
        """One inference."""
        return self.rulebook.infer(self._as_said(row))[self.answer].number

    def many(self, columns: dict[str, Any]) -> Any:
        """One column."""
        return self.rulebook.infer_many(columns)[self.answer]

    def _as_said(self, row: dict[str, float]) -> dict[str, Any]:
        """Categories by name; looked up once per row, since callers have names to begin with."""
        said = self._said.get(id(row))
        if said is None:
            said = {name: self.words[name][int(x)] if name in self.words else x for name, x in row.items()}
            self._said[id(row)] = said
        return said


def _load(description: dict[str, Any]) -> Rulebook:
    if "rulebook" in description:
        return load_rulebook(description["rulebook"])
    with TemporaryDirectory() as folder:
        path = Path(folder) / "bench.yaml"
        path.write_text(description["yaml"], encoding="utf-8")
        return load_rulebook(path)
