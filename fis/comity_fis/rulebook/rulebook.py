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
"""What is known of one person: a variable that is missing, None or NaN was not disclosed. A value is a number
or a category, or something rougher: see `comity_fis.inference.known.known`."""

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
    program: Program = field(init=False, repr=False, compare=False)
    """The rules by what they decide."""
    coercions: Mapping[str, Coercion] = field(init=False, repr=False, compare=False)
    """Of the variables that are used above their own level of measurement."""
    facts: frozenset[str] = field(init=False, repr=False, compare=False)
    """The names under which something can be told: of variables, and of facts that they are derived from."""

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
        """Every parameter for one person.

        Args:
            inputs: Values of variables; what is missing, None or NaN counts as not disclosed. A variable that
                is derived from a fact follows from it, unless it is told itself.
            mode: How degrees and centres of area are computed: exact, matlab or skfuzzy.
            settings: What the person asked for; it replaces the rules, and only safety changes it.
            learnt: What meetings with the person taught, by numeric parameter; it is added to what the rules
                give, and a setting replaces it too.

        Raises:
            InputError: if a name, a value or the mode cannot be used.
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
        """One parameter's value for one person, as `infer` finds it.

        Raises:
            InputError: if a name or a value cannot be used.
        """
        if not isinstance(parameter, str) or parameter not in self.parameters:
            raise _unknown_name(parameter, "parameter", self.parameters, self.name)
        return self.infer(inputs)[parameter].value

    def infer_many(self, columns: Columns) -> Answers:
        """The value of every parameter for many people at once, as `infer` finds them one by one.

        Args:
            columns: By variable, a table of numpy arrays, lists or pandas: numbers, categories, or the
                numbers of categories in declared order (-1: not disclosed), all of one length. None, NaN and
                pandas' NA are not disclosed, and so is a variable that is missing; a variable that is derived
                from a fact follows from that one's column. Other columns are ignored, with a note.

        Returns:
            By parameter, an array of float64, or of the categories' names; in `neutral` the rows for which
            the rules have nothing to go on, in `notes` what was ignored.

        Raises:
            InputError: if no column or a value cannot be used, with the number of its row, from 0.
        """
        from comity_fis.inference.columns import infer_columns
        from comity_fis.rulebook.table import told_columns

        told, notes = told_columns(self.name, self.variables, columns)
        return infer_columns(self.program, list(self.parameters), told, notes)

    def to_skfuzzy(self, points: int = 1001) -> Any:
        """The rules as a `skfuzzy.control.ControlSystem`, for a simulation with all inputs given.

        Its answers are these to within the error of its grid. Where no rule fires, a simulation has no
        output; here the neutral value stands. Inputs that no rule reads are left out.

        Args:
            points: Even places of every universe; the corners of the terms are added to them.

        Raises:
            InputError: for what `skfuzzy.control` has not: words as inputs or outputs, singletons, rules that
                read a parameter, values that the situation moves, other methods.
        """
        from comity_fis.rulebook.control_system import control_system

        return control_system(self.program, self.parameters, self.rules, points)

    def with_rule(self, number: int, rule: Rule | str) -> Rulebook:
        """The same rulebook with one rule replaced.

        Args:
            number: Of the rule to replace, from 1.
            rule: The new one, which takes over the number; or its text, which takes over nothing: sources and
                evidence of the old rule do not speak for it.

        Raises:
            InputError: if there is no such rule, or the text cannot be read.
        """
        from comity_fis.rulebook.replacement import replaced_rule  # it imports the parser

        new = replaced_rule(self.rules, self.variables, self.parameters, number, rule)
        return replace(self, rules=(*self.rules[: number - 1], new, *self.rules[number:]))

    def checked_inputs(self, inputs: Inputs) -> dict[str, Stated | None]:
        """A value or None for every variable, in declared order.

        Raises:
            InputError: if a name is unknown or a value is outside its variable's domain.
        """
        return self._checked(self._told(inputs)[0])

    def _checked(self, told: Inputs) -> dict[str, Stated | None]:
        return {
            name: None if (value := told.get(name)) is None else known(variable, value)
            for name, variable in self.variables.items()
        }

    def _told(self, inputs: Inputs) -> tuple[Inputs, tuple[str, ...], Mapping[str, str]]:
        """What is told, with what follows from it; notes; where scores come from, by variable."""
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
        """The settings, each inside what a person may ask for; what a category requires is checked later.

        Raises:
            InputError: if a name is unknown or a value cannot be asked for.
        """
        for name in by_name(settings, "settings by the name of a parameter"):
            if name not in self.parameters:
                raise _unknown_name(name, "parameter", self.parameters, self.name)
        return {name: self.parameters[name].check(settings[name]) for name in by_name(settings)}

    def rules_for(self, parameter: str) -> tuple[Rule, ...]:
        """The rules that give a parameter its value, in the rulebook's order; not those that only move it."""
        clauses = self.program.blocks[parameter].clauses
        return tuple({clause.rule.number: clause.rule for clause in clauses}.values())

    def reads(self, parameter: str) -> tuple[str, ...]:
        """The variables and other parameters that a parameter's rules read, and those that only move it."""
        shift = self.program.shifts.get(parameter)
        return (*self.program.blocks[parameter].reads, *(shift.reads if shift else ()))


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


def _unknown_name(name: object, kind: str, known: Collection[str], rulebook: str) -> InputError:
    return InputError(
        expected=f"a {kind} of the rulebook {rulebook}", got=shown(name), remedy=closest(str(name), known)
    )
