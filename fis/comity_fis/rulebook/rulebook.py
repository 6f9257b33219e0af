"""A rulebook: variables, parameters, and the rules between them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING, Any

from comity_fis.culture.derivation import derived
from comity_fis.defuzzification.engine import engine_for
from comity_fis.errors import InputError, closest, shown
from comity_fis.html_table import html_table
from comity_fis.inference.block import Block, Program, block_of
from comity_fis.inference.inference import decide
from comity_fis.inference.known import known
from comity_fis.inference.person import DisclosedPerson
from comity_fis.inference.rough import Stated
from comity_fis.inference.scalar import by_name, scalar
from comity_fis.inference.value import Inference
from comity_fis.learning.learnt import Learnt, refuse_unlearnable
from comity_fis.rulebook.adjustment import adjusted
from comity_fis.rulebook.situation import shift_blocks, shift_of
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Rule, Source
from comity_fis.variables.frozen import freeze
from comity_fis.variables.measurement import Coercion
from comity_fis.variables.parameter import Parameter
from comity_fis.variables.variable import Variable, told_names

if TYPE_CHECKING:
    from comity_fis.inference.column import Columns
    from comity_fis.inference.columns import Answers

Inputs = Mapping[str, object]
"""Known values of one person: a variable that is missing, None or NaN is unknown. A value is a number, a
category, or a fuzzy input: see `comity_fis.inference.known.known`."""

Settings = Mapping[str, float | str]
"""Explicit requests of one person, by parameter."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rulebook:
    """Variables, parameters and rules; immutable, stateless, and thread-safe."""

    name: str
    description: str
    variables: Mapping[str, Variable]
    parameters: Mapping[str, Parameter]
    rules: tuple[Rule, ...]
    sources: Mapping[str, Source]
    methods: Methods = MAMDANI
    """Inference methods."""
    program: Program = field(init=False, repr=False, compare=False)
    """The rules, grouped by the parameter they conclude."""
    coercions: Mapping[str, Coercion] = field(init=False, repr=False, compare=False)
    """Coercions of the variables used above their own level of measurement."""
    facts: frozenset[str] = field(init=False, repr=False, compare=False)
    """Names of all accepted inputs: variables, and facts from which variables are derived."""

    def __post_init__(self) -> None:
        freeze(self, variables=self.variables, parameters=self.parameters, sources=self.sources)
        blocks = {name: block_of(made, self.rules, self.methods) for name, made in self.parameters.items()}
        ordered = {name: blocks[name] for name in _evaluation_order(blocks)}
        shifts = shift_blocks(self.parameters, self.rules, self.methods)
        object.__setattr__(self, "program", Program(ordered, self.variables, self.methods, shifts))
        freeze(self, coercions={name: v.coercion for name, v in self.variables.items() if v.coercion})
        object.__setattr__(self, "facts", told_names(self.variables))

    def __repr__(self) -> str:
        return (
            f"<Rulebook {self.name}: {len(self.rules)} rules\n"
            f"  variables   {', '.join(self.variables)}\n"
            f"  parameters  {', '.join(self.parameters)}>"
        )

    def _repr_html_(self) -> str:
        rows = ((rule.number, rule.text, rule.source) for rule in self.rules)
        return html_table(f"{self.name}: {self.description}", ("rule", "text", "source"), rows)

    def infer(
        self,
        inputs: Inputs,
        mode: str = "exact",
        settings: Settings | None = None,
        learnt: Mapping[str, Learnt] | None = None,
    ) -> Inference:
        """Infer every parameter for one person.

        Args:
            inputs: Values of variables; missing, None or NaN means unknown. A variable derived from a fact is
                computed from it, unless it is given itself.
            mode: How degrees and centroids are computed: exact, matlab or skfuzzy.
            settings: Explicit requests of the person; they replace the rules, and only safety changes them.
            learnt: Corrections learnt from encounters with the person, by numeric parameter; added to the
                inferred value, but not to a setting.

        Raises:
            InputError: A name, a value or the mode is invalid.
        """
        asked = {} if settings is None else self.checked_settings(settings)
        learnt = {} if learnt is None else learnt
        refuse_unlearnable(learnt, self.parameters, self.name)
        told, notes, sources = self._told(inputs)
        person = DisclosedPerson(self.program, self._checked(told), engine_for(mode))
        for name, block in self.program.blocks.items():
            value = decide(block, person, asked.get(name))
            shift = shift_of(self.program.shifts.get(name), person)
            person.values[name] = adjusted(value, block.parameter, shift, learnt.get(name))
        return Inference(
            rulebook=self.name,
            mode=mode,
            inputs=person.inputs,
            parameters={name: person.values[name] for name in self.parameters},
            coercions=self.coercions,
            notes=notes,
            sources=sources,
        )

    def value(self, parameter: str, inputs: Inputs) -> float | str:
        """One parameter's value for one person, as `infer` computes it.

        Raises:
            InputError: A name or a value is invalid.
        """
        if not isinstance(parameter, str) or parameter not in self.parameters:
            raise _unknown_name(parameter, "parameter", self.parameters, self.name)
        return self.infer(inputs)[parameter].value

    def infer_many(self, columns: Columns) -> Answers:
        """Values of every parameter for many people at once, as `infer` computes them one by one.

        Args:
            columns: By variable, a table of numpy arrays, lists or pandas columns of equal length: numbers,
                categories, or category indexes in declared order (-1: unknown). None, NaN and pandas' NA are
                unknown, and so is a missing variable. A variable derived from a fact is computed from the
                fact's column. Other columns are ignored, with a note.

        By parameter, an array of float64 or of category names; `neutral` has the rows for which no rule had a
        known input, `notes` the ignored columns.

        Raises:
            InputError: No column is known, or a value is invalid; with its row number, from 0.
        """
        from comity_fis.inference.columns import infer_columns
        from comity_fis.rulebook.table import told_columns

        told, notes = told_columns(self.name, self.variables, columns)
        return infer_columns(self.program, list(self.parameters), told, notes)

    def to_skfuzzy(self, points: int = 1001) -> Any:
        """The rules as a `skfuzzy.control.ControlSystem`, for a simulation with all inputs given.

        Its values agree with `infer` up to grid error. If no rule fires, a simulation has no output, whereas
        `infer` gives the neutral value. Inputs that no rule reads are left out.

        Args:
            points: Number of even grid points of every universe; the corners of the terms are added.

        Raises:
            InputError: Something has no counterpart in `skfuzzy.control`: nominal inputs or outputs,
                singletons, rules that read a parameter, shifts by the situation, other methods.
        """
        from comity_fis.rulebook.control_system import control_system

        return control_system(self.program, self.parameters, self.rules, points)

    def with_rule(self, number: int, rule: Rule | str) -> Rulebook:
        """The same rulebook with one rule replaced.

        Args:
            number: Number of the rule to replace, from 1.
            rule: The new rule, which takes over the number; or its text, which takes over neither sources nor
                evidence of the old rule.

        Raises:
            InputError: There is no such rule, or the text is invalid.
        """
        from comity_fis.rulebook.replacement import replaced_rule  # it imports the parser

        new = replaced_rule(self.rules, self.variables, self.parameters, number, rule)
        return replace(self, rules=(*self.rules[: number - 1], new, *self.rules[number:]))

    def checked_inputs(self, inputs: Inputs) -> dict[str, Stated | None]:
        """A value or None for every variable, in declared order.

        Raises:
            InputError: A name is unknown, or a value is outside its variable's domain.
        """
        return self._checked(self._told(inputs)[0])

    def _checked(self, told: Inputs) -> dict[str, Stated | None]:
        return {
            name: None if (value := told.get(name)) is None else known(variable, value)
            for name, variable in self.variables.items()
        }

    def _told(self, inputs: Inputs) -> tuple[Inputs, tuple[str, ...], Mapping[str, str]]:
        """The inputs with derived values; notes; and the origin of derived scores, by variable."""
        told: dict[str, Any] = {}
        for name in by_name(inputs):
            if name not in self.facts:
                raise _unknown_name(name, "variable", self.facts, self.name)
            told[name] = scalar(inputs[name])
        notes: dict[str, None] = {}
        sources: dict[str, str] = {}
        for name, variable in self.variables.items():
            fact = variable.derived_from and variable.derived_from.fact
            if fact and name not in told and told.get(fact) is not None:
                told[name], source, note = derived(variable, told[fact], self.variables)
                notes |= {note: None} if note else {}
                sources |= {name: source} if source else {}
        return told, tuple(notes), sources

    def checked_settings(self, settings: Settings) -> dict[str, float | str]:
        """The settings, each within the requestable range; requirements of categories are checked later.

        Raises:
            InputError: A name is unknown, or a value cannot be requested.
        """
        for name in by_name(settings, "settings by the name of a parameter"):
            if name not in self.parameters:
                raise _unknown_name(name, "parameter", self.parameters, self.name)
        return {name: self.parameters[name].check(settings[name]) for name in by_name(settings)}

    def rules_for(self, parameter: str) -> tuple[Rule, ...]:
        """The rules that conclude a parameter's value, in the rulebook's order, without shift rules."""
        clauses = self.program.blocks[parameter].clauses
        return tuple({clause.rule.number: clause.rule for clause in clauses}.values())

    def reads(self, parameter: str) -> tuple[str, ...]:
        """The variables and parameters that a parameter's rules read, including shift rules."""
        shift = self.program.shifts.get(parameter)
        return (*self.program.blocks[parameter].reads, *(shift.reads if shift else ()))


def _evaluation_order(blocks: Mapping[str, Block]) -> tuple[str, ...]:
    """Parameters in topological order: each after those that its rules read.

    Raises:
        InputError: Parameters depend on each other in a cycle.
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


def _unknown_name(name: object, kind: str, known: Collection[str], rulebook: str) -> InputError:
    return InputError(
        expected=f"a {kind} of the rulebook {rulebook}", got=shown(name), remedy=closest(str(name), known)
    )
