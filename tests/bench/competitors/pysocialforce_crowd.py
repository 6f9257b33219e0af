"""PySocialForce: one call is one step of everybody."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pysocialforce


class System:
    """A square hall without groups."""

    def __init__(self, description: dict[str, Any]) -> None:
        side = description["side_m"]
        starts, goals = np.array(description["starts"]), np.array(description["goals"])
        way = goals - starts
        velocity = way / np.maximum(np.linalg.norm(way, axis=1), 1e-9)[:, None]
        walls = [(0, side, 0, 0), (0, side, side, side), (0, 0, 0, side), (side, side, 0, side)]
        step_s = description["step_s"]
        with tempfile.NamedTemporaryFile("w", suffix=".toml", delete=False) as file:
            file.write(f"step_width = {step_s}\nagent_radius = 0.2\n[scene]\nenable_group = false\n")
        state = np.hstack([starts, velocity, goals])
        self.simulator = pysocialforce.Simulator(state, obstacles=walls, config_file=file.name)
        Path(file.name).unlink()

    def one(self, _row: dict[str, float]) -> float:
        """A step; the mean of all x."""
        self.simulator.step(1)
        return float(self.simulator.peds.pos()[:, 0].mean())
