"""A plan: the actions in order, each with its full-precision parameters and why it was chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Alternative:
    """Another way to do a step, and what it would have cost on top."""

    arguments: tuple[str, ...]
    extra_cost: int
    """In plan cost units (1 cm of metre-equivalents); 0 is a tie."""


@dataclass(frozen=True, slots=True)
class Why:
    """Why a step is done this way and not the next best."""

    text: str
    alternatives: tuple[Alternative, ...]
    """Cheapest first."""


@dataclass(frozen=True, slots=True)
class PlanStep:
    """One action with everything that its execution needs."""

    action: str
    arguments: tuple[str, ...]
    """Robot, person, then the discrete choices: a side, or a modality and a gesture."""
    origin: tuple[str, str] | None
    """Where the robot comes from, as place and side; None where the action does not move it."""
    parameters: Mapping[str, float | str]
    """Full precision, in each parameter's own unit; the planner itself saw scaled integers."""
    cost: int
    why: Why

    @property
    def person(self) -> str:
        """Whom the step is for."""
        return self.arguments[1]


@dataclass(frozen=True, slots=True)
class Plan:
    """What the planner found."""

    engine: str
    optimal: bool
    """Proven: no plan costs less."""
    reproducible: bool
    """False where a time limit cut the search off, so that another machine may find another plan."""
    cost: int
    """The sum over the steps, in cm of metre-equivalents."""
    steps: tuple[PlanStep, ...]
