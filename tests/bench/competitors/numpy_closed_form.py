"""The paper's second case with numpy, by hand: what a programmer who needs only this would write."""

from __future__ import annotations

from typing import Any

import numpy as np

CHUNK = 8192


class System:
    """Closed form for the three output terms; nothing is checked, nothing explained."""

    def __init__(self, description: dict[str, Any]) -> None:
        terms = description["inputs"]["individualism"]["terms"]
        self.bumps = [terms[name]["two_term_gaussian"] for name in ("LC1", "LC2")]

    def one(self, row: dict[str, float]) -> float:
        """One input, as a column of one."""
        return float(self.many({name: np.array([x]) for name, x in row.items()})[0])

    def many(self, columns: dict[str, Any]) -> Any:
        """A column, in chunks."""
        scores, genders = columns["individualism"], columns["gender"]
        out = np.empty(len(scores))
        for start in range(0, len(scores), CHUNK):
            part = slice(start, start + CHUNK)
            out[part] = self._chunk(scores[part], genders[part])
        return out

    def _chunk(self, x: Any, gender: Any) -> Any:
        low, high = (
            np.minimum(1, a1 * np.exp(-(((x - b1) / c1) ** 2)) + a2 * np.exp(-(((x - b2) / c2) ** 2)))
            for (a1, b1, c1), (a2, b2, c2) in self.bumps
        )
        woman = gender == 0
        near, middle, far = np.where(woman, low, 0), np.where(woman, high, low), np.where(woman, 0, high)
        first, second = np.minimum(np.minimum(near, middle), 0.5), np.minimum(np.minimum(middle, far), 0.5)
        # Heights of trapezoids (.45 .45 .65 .75), (.65 .75 .95 1.05), (.95 1.05 1.2 1.2), about .45.
        area = near * (0.3 - 0.05 * near) + middle * (0.4 - 0.1 * middle) + far * (0.25 - 0.05 * far)
        area -= first * (0.1 - 0.1 * first) + second * (0.1 - 0.1 * second)
        moment = near * (0.045 + near * (-0.015 + near * (0.01 / 6)))
        moment += middle * (0.16 - 0.04 * middle)
        moment += far * (0.15625 + far * (-0.025 - far * (0.01 / 6)))
        moment -= first * (0.025 - 0.025 * first) + second * (0.055 - 0.055 * second)
        return 0.45 + moment / area
