"""Content of a binding: which arguments and costs of a domain come from which person's parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from comity_domain.custom.reading.reading import CustomProblem
from comity_fis.errors import WrongValueError

OptionValue = str | float | tuple[float, float] | None
"""Meaning of an object: a category, a number or a range of a parameter, or None for no preference."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """An argument of an action for which people have preferences."""

    parameter: str
    """A parameter of the rulebook."""
    weight: float = 1.0
    """Preference cost: units of the domain's own cost per unit of -ln(desirability)."""
    objects: Mapping[str, OptionValue] = field(default_factory=dict)
    """Meaning of each object; an object not listed stands for the category of the same name."""

    def __post_init__(self) -> None:
        if not 0.0 <= self.weight <= 1e6:
            raise WrongValueError(expected="a weight from 0 to 1000000", got=self.weight)

    def full(self, own: CustomProblem, possible: Iterable[str]) -> Option:
        """The option with a meaning for every possible object, keyed by the object's name in the problem.

        Args:
            own: The problem that declares the objects.
            possible: Names of all objects that the argument may be.
        """
        named = {name.lower(): meaning for name, meaning in self.objects.items()}
        return replace(
            self, objects={name: named.get(name, own.as_written(name).lower()) for name in possible}
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionBinding:
    """What one action takes from a person's parameters."""

    person: str
    """Name of the action's argument that is the person, without the question mark."""
    parameters: tuple[str, ...] = ()
    """Parameters of the rulebook that the step carries at full precision."""
    options: Mapping[str, Option] = field(default_factory=dict)
    """Options by the action's argument, without the question mark."""
    base: float | None = None
    """Cost of the action in units of the domain's own cost; None takes the domain's cost."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FluentBinding:
    """A numeric function of one argument, a person, whose value is inferred for that person."""

    parameter: str
    scale: int = 1
    """Factor from the value to the planner's whole number (rounded): 1000 for mm if the unit is m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Binding:
    """All bindings of a domain; PDDL names are case-insensitive."""

    actions: Mapping[str, ActionBinding] = field(default_factory=dict)
    fluents: Mapping[str, FluentBinding] = field(default_factory=dict)
    cost_scale: int = 100
    """Planner cost units per unit of the domain's own cost: 100 turns metres into centimetres."""

    def of(self, action: str) -> ActionBinding | None:
        """The binding of an action, by its case-insensitive name; None if it has none."""
        return next((one for name, one in self.actions.items() if name.lower() == action.lower()), None)
