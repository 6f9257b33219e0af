"""The paper's second case in plain Python, by hand: floats and `math.exp`, no array anywhere."""

from __future__ import annotations

from math import exp
from typing import Any


class System:
    """Closed form for the three output terms; nothing is checked, nothing explained."""

    def __init__(self, description: dict[str, Any]) -> None:
        terms = description["inputs"]["individualism"]["terms"]
        self.bumps = [terms[name]["two_term_gaussian"] for name in ("LC1", "LC2")]

    def one(self, row: dict[str, float]) -> float:
        """One input."""
        x = row["individualism"]
        low, high = (
            min(1.0, a1 * exp(-(((x - b1) / c1) ** 2)) + a2 * exp(-(((x - b2) / c2) ** 2)))
            for (a1, b1, c1), (a2, b2, c2) in self.bumps
        )
        near, middle, far = (low, high, 0.0) if row["gender"] == 0 else (0.0, low, high)
        first, second = min(near, middle, 0.5), min(middle, far, 0.5)
        # Heights of trapezoids (.45 .45 .65 .75), (.65 .75 .95 1.05), (.95 1.05 1.2 1.2), about .45.
        area = near * (0.3 - 0.05 * near) + middle * (0.4 - 0.1 * middle) + far * (0.25 - 0.05 * far)
        area -= first * (0.1 - 0.1 * first) + second * (0.1 - 0.1 * second)
        moment = near * (0.045 + near * (-0.015 + near * (0.01 / 6)))
        moment += middle * (0.16 - 0.04 * middle)
        moment += far * (0.15625 + far * (-0.025 - far * (0.01 / 6)))
        moment -= first * (0.025 - 0.025 * first) + second * (0.055 - 0.055 * second)
        return 0.45 + moment / area

    def many(self, columns: dict[str, Any]) -> Any:
        """One after the other."""
        scores, genders = columns["individualism"].tolist(), columns["gender"].tolist()
        return [self.one({"individualism": x, "gender": g}) for x, g in zip(scores, genders, strict=True)]
