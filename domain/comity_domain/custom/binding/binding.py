"""What a binding says: which arguments and costs of a domain come from which parameters of which person."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from comity_domain.custom.reading.reading import CustomProblem
from comity_fis.errors import WrongValueError

OptionValue = str | float | tuple[float, float] | None
"""What an object stands for: a category, a number or range of a parameter, or nothing to prefer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """An argument of an action that a person may like more or less."""

    parameter: str
    """A parameter of the rulebook."""
    weight: float = 1.0
    """Preference cost: units of the domain's own cost per unit of -ln(desirability)."""
    objects: Mapping[str, OptionValue] = field(default_factory=dict)
    """What objects stand for; one that is not named stands for the category of its own name."""

    def __post_init__(self) -> None:
        if not 0.0 <= self.weight <= 1e6:
            raise WrongValueError(expected="a weight from 0 to 1000000", got=self.weight)

    def full(self, own: CustomProblem, possible: Iterable[str]) -> Option:
        """The same with what every object stands for, objects by their names in the problem.

        Args:
            own: Where the objects are.
            possible: All that the argument may be.
        """
        named = {name.lower(): meaning for name, meaning in self.objects.items()}
        return replace(
            self, objects={name: named.get(name, own.as_written(name).lower()) for name in possible}
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionBinding:
    """What one action takes from a person."""

    person: str
    """The action's argument that is the person, without its question mark."""
    parameters: tuple[str, ...] = ()
    """Parameters of the rulebook that ride beside the step in full precision."""
    options: Mapping[str, Option] = field(default_factory=dict)
    """By the action's argument, without its question mark."""
    base: float | None = None
    """The action's price in units of the domain's own cost; None takes what the domain itself says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FluentBinding:
    """A numeric function of one argument, a person, whose value comes from them."""

    parameter: str
    scale: int = 1
    """The planner sees the value times this, rounded to a whole number: 1000 for mm where the unit is m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Binding:
    """All of it; names of PDDL in any case."""

    actions: Mapping[str, ActionBinding] = field(default_factory=dict)
    fluents: Mapping[str, FluentBinding] = field(default_factory=dict)
    cost_scale: int = 100
    """The planner counts in this part of the domain's own cost: 100 makes centimetres of metres."""

    def of(self, action: str) -> ActionBinding | None:
        """What is bound to an action, by its name in any case."""
        return next((one for name, one in self.actions.items() if name.lower() == action.lower()), None)
