"""A rulebook: variables, parameters, and the rules between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from comity_fis.engine import engine_for
from comity_fis.errors import InputError, closest
from comity_fis.inference import Block, Person, decide
from comity_fis.methods import MAMDANI, Methods
from comity_fis.parameter import Parameter
from comity_fis.rule import Rule, Source
from comity_fis.value import Inference
from comity_fis.variable import Variable

Inputs = Mapping[str, float | str | None]
"""What is known of one person: a variable that is missing or None was not disclosed."""

Settings = Mapping[str, float | str]
"""What one person explicitly asked for, by parameter."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rulebook:
    """Variables, parameters and rules; immutable, no memory between calls, safe to share between threads."""

    name: str
    description: str
    variables: Mapping[str, Variable]
    parameters: Mapping[str, Parameter]
    rules: tuple[Rule, ...]
    sources: Mapping[str, Source]
    methods: Methods = MAMDANI
    """How the rules are evaluated."""
    _blocks: tuple[Block, ...] = field(init=False, repr=False, compare=False)
    """In the order in which they can be evaluated."""

    def __post_init__(self) -> None:
        blocks = {name: self._block(parameter) for name, parameter in self.parameters.items()}
        object.__setattr__(self, "_blocks", tuple(blocks[name] for name in _evaluation_order(blocks)))

    def infer(self, inputs: Inputs, mode: str = "exact", settings: Settings | None = None) -> Inference:
        """Every parameter for one person.

        Args:
            inputs: Values of variables; what is missing or None counts as not disclosed.
            mode: How degrees and centres of area are computed: exact, matlab or skfuzzy.
            settings: What the person asked for; it replaces the rules, and only safety changes it.

        Raises:
            InputError: if a name, a value or the mode cannot be used.
        """
        person = Person(
            self.variables, self.parameters, self.checked_inputs(inputs), engine_for(mode), self.methods
        )
        asked = self.checked_settings(settings or {})
        for block in self._blocks:
            name = block.parameter.name
            person.values[name] = decide(block, person, asked.get(name))
        return Inference(
            rulebook=self.name,
            mode=mode,
            inputs=person.inputs,
            parameters={name: person.values[name] for name in self.parameters},
        )

    def checked_inputs(self, inputs: Inputs) -> dict[str, float | str | None]:
        """A value or None for every variable, in declared order.

        Raises:
            InputError: if a name is unknown or a value is outside its variable's domain.
        """
        for name in inputs:
            if name not in self.variables:
                raise _unknown_name(name, "variable", self.variables, self.name)
        given = {name: inputs.get(name) for name in self.variables}
        return {name: None if v is None else self.variables[name].check(v) for name, v in given.items()}

    def checked_settings(self, settings: Settings) -> dict[str, float | str]:
        """The settings, each inside what a person may ask for; what a category requires is checked later.

        Raises:
            InputError: if a name is unknown or a value cannot be asked for.
        """
        for name in settings:
            if name not in self.parameters:
                raise _unknown_name(name, "parameter", self.parameters, self.name)
        return {name: self.parameters[name].check(value) for name, value in settings.items()}

    def rules_for(self, parameter: str) -> tuple[Rule, ...]:
        """The rules that decide a parameter, in the rulebook's order."""
        return tuple(rule for rule in self.rules if any(is_.name == parameter for is_ in rule.consequents))

    def _block(self, parameter: Parameter) -> Block:
        rules = tuple(
            (r, is_.term) for r in self.rules for is_ in r.consequents if is_.name == parameter.name
        )
        return Block(parameter, rules, tuple(dict.fromkeys(name for rule, _ in rules for name in rule.reads)))


def _evaluation_order(blocks: Mapping[str, Block]) -> tuple[str, ...]:
    """Parameters such that each comes after those that its rules read.

    Raises:
        InputError: if they read each other in a circle.
    """
    reads = {name: [read for read in block.reads if read in blocks] for name, block in blocks.items()}
    try:
        return tuple(TopologicalSorter(reads).static_order())
    except CycleError as error:
        raise InputError(
            expected="parameters that do not depend on themselves",
            got=" <- ".join(error.args[1]),
            remedy="Remove one of the rules that read another parameter.",
        ) from None


def _unknown_name(name: object, kind: str, known: Mapping[str, object], rulebook: str) -> InputError:
    return InputError(
        expected=f"a {kind} of the rulebook {rulebook}", got=repr(name), remedy=closest(str(name), known)
    )
