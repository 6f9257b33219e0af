"""A plan: the actions in order, each with its full-precision parameters and why it was chosen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from comity_fis.html_table import html_table
from comity_fis.record import Record

SHOWN = 8
"""Steps in a plan's `repr`."""


@dataclass(frozen=True, slots=True)
class Alternative(Record):
    """An alternative to a step, with its additional cost."""

    arguments: tuple[str, ...]
    extra_cost: int
    """Additional cost in plan cost units (1 cm of metre-equivalents); 0 is a tie."""
    because: str
    """Reason for its cost: its desirability and the rule behind it."""


@dataclass(frozen=True, slots=True)
class RuledOut(Record):
    """An alternative that is excluded, whatever its cost."""

    arguments: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class StepExplanation:
    """Why a step is done this way and not another."""

    text: str
    alternatives: tuple[Alternative, ...]
    """Cheapest first."""
    ruled_out: tuple[RuledOut, ...] = ()
    chosen: str = ""
    """The part of the text about the choice itself, without the alternatives."""


@dataclass(frozen=True, slots=True)
class PlanStep:
    """One action with everything that its execution needs."""

    action: str
    arguments: tuple[str, ...]
    """Robot, person, then the discrete choices: a side, or a company, a modality and a gesture."""
    origin: tuple[str, str] | None
    """Origin of the robot's movement, as place and side; None if the action does not move it."""
    parameters: Mapping[str, float | str]
    """Parameters in full precision, in their own units; the planner used scaled integers."""
    cost: int
    why: StepExplanation
    cost_parts: Mapping[str, int] = field(default_factory=dict)
    """Parts of the cost, in the same units: travel, preference cost, waiting, nearness."""
    companions: tuple[str, ...] = ()
    """Others served by the step, if a group is greeted at once."""

    @property
    def person(self) -> str:
        """The person in front of whom the robot stands."""
        return self.arguments[1]

    @property
    def people(self) -> tuple[str, ...]:
        """Everyone served by the step, that person first; empty if it has no second argument."""
        return (*self.arguments[1:2], *self.companions)


@dataclass(frozen=True, slots=True)
class Plan:
    """The result of the planner."""

    engine: str
    optimal: bool
    """Whether it is proven that no plan for the visited people costs less; who is left out was decided
    before."""
    reproducible: bool
    """False if a time limit cut the search off, so that another machine may find another plan."""
    cost: int
    """Total cost of the steps, in cm of metre-equivalents."""
    steps: tuple[PlanStep, ...]
    bound: int = 0
    """Lower bound of the cost; equal to the cost if the plan is optimal."""
    killed: bool = False
    """Whether the engine process was killed; the plan is then the best found before."""

    def __repr__(self) -> str:
        steps = [f"{step.action}({', '.join(step.arguments)})" for step in self.steps]
        more = [f"and {len(steps) - SHOWN} more"] if len(steps) > SHOWN else []
        return "\n  ".join((f"<Plan: {self._summary}", *steps[:SHOWN], *more)) + ">"

    def _repr_html_(self) -> str:
        rows = ((step.action, ", ".join(step.arguments), step.cost, step.why.text) for step in self.steps)
        return html_table(f"Plan: {self._summary}", ("action", "arguments", "cost", "why"), rows)

    @property
    def _summary(self) -> str:
        found = "optimal" if self.optimal else f"a better plan saves {self.gap:.1%} at most"
        return f"{len(self.steps)} steps, cost {self.cost}, {found}, by {self.engine}"

    @property
    def gap(self) -> float:
        """Relative optimality gap, in [0, 1]; 0 if optimal."""
        return (self.cost - self.bound) / self.cost if self.cost else 0.0
