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
    """Another way to do a step, and what it would have cost on top."""

    arguments: tuple[str, ...]
    extra_cost: int
    """In plan cost units (1 cm of metre-equivalents); 0 is a tie."""
    because: str
    """Where the price of it comes from: its desirability and the rule behind that."""


@dataclass(frozen=True, slots=True)
class RuledOut(Record):
    """A way to do a step that is not open, whatever the cost."""

    arguments: tuple[str, ...]
    reason: str


@dataclass(frozen=True, slots=True)
class StepExplanation:
    """Why a step is done this way and not the next best."""

    text: str
    alternatives: tuple[Alternative, ...]
    """Cheapest first."""
    ruled_out: tuple[RuledOut, ...] = ()
    chosen: str = ""
    """The part of the text that is about what is done, and not about what else could be."""


@dataclass(frozen=True, slots=True)
class PlanStep:
    """One action with everything that its execution needs."""

    action: str
    arguments: tuple[str, ...]
    """Robot, person, then the discrete choices: a side, or a company, a modality and a gesture."""
    origin: tuple[str, str] | None
    """Where the robot comes from, as place and side; None where the action does not move it."""
    parameters: Mapping[str, float | str]
    """Full precision, in each parameter's own unit; the planner itself saw scaled integers."""
    cost: int
    why: StepExplanation
    cost_parts: Mapping[str, int] = field(default_factory=dict)
    """What the cost is made of, in the same units: the way, dislike of the choice, waiting, nearness."""
    companions: tuple[str, ...] = ()
    """Others whom the step serves too, where a company is greeted at once."""

    @property
    def person(self) -> str:
        """The person before whom the robot stands."""
        return self.arguments[1]

    @property
    def people(self) -> tuple[str, ...]:
        """Everybody whom the step is for, that one first; nobody where it has no second argument."""
        return (*self.arguments[1:2], *self.companions)


@dataclass(frozen=True, slots=True)
class Plan:
    """What the planner found."""

    engine: str
    optimal: bool
    """Proven: no plan for those who are visited costs less; who is left out was settled before, by price."""
    reproducible: bool
    """False where a time limit cut the search off, so that another machine may find another plan."""
    cost: int
    """The sum over the steps, in cm of metre-equivalents."""
    steps: tuple[PlanStep, ...]
    bound: int = 0
    """No plan costs less than this; equal to the cost where the plan is optimal."""
    killed: bool = False
    """The engine, a process, was killed from outside; the plan is the best that it had found."""

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
        """The share of the cost, in [0, 1], that a better plan could at most save; 0 where it is optimal."""
        return (self.cost - self.bound) / self.cost if self.cost else 0.0
