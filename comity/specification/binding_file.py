"""The binding file: arguments and costs of a custom domain that come from a person's parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints

from comity.people.dated import Day
from comity.people.fact import Fact, Number
from comity.people.profile import Profile
from comity_domain.custom import ActionBinding, Binding, FluentBinding, Option

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

Name = Annotated[str, StringConstraints(min_length=1, max_length=100)]


class BoundPerson(BaseModel):
    """A person of the problem, in their situation."""

    model_config = _FILE

    profile: Name | Profile = Field(
        default="unknown", description="A shipped profile, a file, or a profile written out."
    )
    situation: Mapping[str, Fact] = Field(
        default_factory=dict, description="What holds here and now, by the name of a rulebook's variable."
    )


class BoundOption(BaseModel):
    """An argument of an action that a person may like more or less."""

    model_config = _FILE

    parameter: Name = Field(description="Of the rulebook, such as greeting_gesture.")
    weight: Number = Field(
        default=1.0,
        ge=0,
        le=1e6,
        description="What dislike is worth: units of the domain's own cost per unit of -ln(desirability).",
    )
    objects: Mapping[Name, Name | Number | tuple[Number, Number] | None] = Field(
        default_factory=dict,
        description="What objects stand for: a category, a number, a range [low, high], or null for nothing "
        "to like or dislike; one that is not named stands for the category of its own name.",
    )

    def record(self) -> Option:
        """Convert to the planner's type."""
        return Option(parameter=self.parameter, weight=self.weight, objects=self.objects)


class BoundAction(BaseModel):
    """What one action takes from a person."""

    model_config = _FILE

    person: Name = Field(description="The action's argument that is the person, without its question mark.")
    parameters: tuple[Name, ...] = Field(
        default=(), description="Parameters of the rulebook that ride beside the step in full precision."
    )
    options: Mapping[Name, BoundOption] = Field(
        default_factory=dict, description="By the action's argument, without its question mark."
    )
    base: Number | None = Field(
        default=None,
        ge=0,
        le=1e6,
        description="The action's price without any dislike, in units of the domain's own cost; left out, "
        "what the domain says, or 1 where it states no costs.",
    )

    def record(self) -> ActionBinding:
        """Convert to the planner's type."""
        options = {name: option.record() for name, option in self.options.items()}
        return ActionBinding(person=self.person, parameters=self.parameters, options=options, base=self.base)


class BoundFluent(BaseModel):
    """A numeric function of one person whose value comes from them."""

    model_config = _FILE

    parameter: Name = Field(description="A numeric parameter of the rulebook.")
    scale: Annotated[int, Field(strict=True)] = Field(
        default=1,
        ge=1,
        le=1_000_000,
        description="The planner sees the value times this, rounded: 1000 makes millimetres of metres.",
    )

    def record(self) -> FluentBinding:
        """Convert to the planner's type."""
        return FluentBinding(parameter=self.parameter, scale=self.scale)


class BindingFile(BaseModel):
    """Binds a PDDL domain to people; `comity schema binding` prints it as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity binding")

    schema_version: Literal[1]
    about: str = ""
    rulebook: Name | Mapping[str, Any] = Field(
        default="bruno2017", description="A shipped rulebook, a file, or a rulebook written out."
    )
    at: Day | None = Field(
        default=None, description="The day on which dated facts are taken; without it today, where one is."
    )
    people: Mapping[Name, Name | BoundPerson] = Field(
        default_factory=dict,
        description="Objects of the problem with their profile; of others of their types nothing is known.",
    )
    actions: Mapping[Name, BoundAction] = Field(default_factory=dict, description="By the action's name.")
    fluents: Mapping[Name, BoundFluent] = Field(
        default_factory=dict, description="Numeric functions of one argument, by name."
    )
    cost_scale: Annotated[int, Field(strict=True)] = Field(
        default=100,
        ge=1,
        le=1_000_000,
        description="The planner counts in this part of the domain's own cost: 100 makes cm of m.",
    )

    def record(self) -> Binding:
        """Convert to the planner's type."""
        return Binding(
            actions={name: action.record() for name, action in self.actions.items()},
            fluents={name: fluent.record() for name, fluent in self.fluents.items()},
            cost_scale=self.cost_scale,
        )
