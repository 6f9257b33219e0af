"""A rulebook: variables, parameters, and the rules between them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import InitVar, dataclass, field, replace
from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING, Any

from comity_fis.culture.derivation import derived
from comity_fis.defuzzification.engine import EXACT, engine_for
from comity_fis.errors import InputError, closest, shown
from comity_fis.html_table import html_table
from comity_fis.inference.block import Block, Program, compile_block
from comity_fis.inference.inference import Person, decide, meet, settle, value_of
from comity_fis.inference.possibility import Stated, known
from comity_fis.inference.scalar import by_name, scalar
from comity_fis.inference.value import Inference, ParameterValue
from comity_fis.learning.learnt import Learnt, refuse_unlearnable
from comity_fis.rulebook.adjustment import adjusted
from comity_fis.rulebook.situation import shift_blocks, shift_of
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Rule, Source
from comity_fis.variables.frozen import freeze
from comity_fis.variables.measurement import Coercion
from comity_fis.variables.parameter import Parameter
from comity_fis.variables.variable import Variable

if TYPE_CHECKING:
    from comity_fis.inference.column import Columns
    from comity_fis.rulebook.batch import Answers

Inputs = Mapping[str, object]
"""What is known of one person: a variable that is missing, None or NaN was not disclosed. A value is a number
or a category, or something rougher: see `comity_fis.inference.possibility.known`."""

PLAIN = (float, str, int)
"""The types of what is known precisely: there is nothing to work out."""

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
    """The rules, compiled."""
    coercions: Mapping[str, Coercion] = field(init=False, repr=False, compare=False)
    """Of the variables that are used above their own level of measurement."""
    facts: frozenset[str] = field(init=False, repr=False, compare=False)
    """The names under which something can be told: of variables, and of facts that they are derived from."""
    derivations: tuple[tuple[str, str], ...] = field(init=False, repr=False, compare=False)
    """Variables that follow from a fact, each with the fact."""
    before: InitVar[Program | None] = None
    """Of a rulebook with the same variables and parameters: its blocks are kept, but for those in `anew`."""
    anew: InitVar[frozenset[str]] = frozenset()
    """Parameters whose rules have changed since then."""

    def __post_init__(self, before: Program | None, anew: frozenset[str]) -> None:
        freeze(self, variables=self.variables, parameters=self.parameters, sources=self.sources)
        kept = {block.parameter.name: block for block in before.blocks} if before else {}
        literals = {literal: i for i, literal in enumerate(before.literals)} if before else {}
        blocks = {
            name: kept[name]
            if name in kept.keys() - anew
            else compile_block(parameter, self.rules, literals, self.methods)
            for name, parameter in self.parameters.items()
        }
        ordered = tuple(blocks[name] for name in _evaluation_order(blocks))
        coercions = {name: v.coercion for name, v in self.variables.items() if v.coercion}
        freeze(self, coercions=coercions)
        derivations = tuple((n, v.derived_from.fact) for n, v in self.variables.items() if v.derived_from)
        object.__setattr__(self, "derivations", derivations)
        object.__setattr__(self, "facts", self.variables.keys() | {fact for _, fact in derivations})
        shifts = shift_blocks(self.parameters, self.rules, literals, self.methods)
        program = Program(ordered, tuple(literals), self.variables, self.methods, shifts)
        object.__setattr__(self, "program", program)

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
        engine = engine_for(mode)
        told, notes, sources = self._told(inputs)
        person = meet(self.program, self.variables, self._checked(told), engine)
        for block in self.program.blocks:
            name = block.parameter.name
            value = decide(block, person, asked.get(name))
            if name in learnt or name in self.program.shifts:
                value = self._moved(value, block.parameter, person, learnt.get(name))
            settle(self.program, person, block.parameter, value)
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
        """One parameter's value for one person, as `infer` finds it, without the records of why.

        Raises:
            InputError: if a name or a value cannot be used.
        """
        if not isinstance(parameter, str) or parameter not in self.parameters:
            raise _unknown_name(parameter, "parameter", self.parameters, self.name)
        person = meet(self.program, self.variables, self.checked_inputs(inputs), EXACT)
        *before, block = self.program.up_to(parameter)
        for other in before:
            settle(self.program, person, other.parameter, self._decided(other, person))
        return (
            self._decided(block, person).value
            if parameter in self.program.shifts
            else value_of(block, person)
        )

    def _decided(self, block: Block, person: Person) -> ParameterValue:
        """One parameter of somebody who asked for nothing and of whom nothing was learnt."""
        return self._moved(decide(block, person, None), block.parameter, person, None)

    def _moved(
        self, value: ParameterValue, parameter: Parameter, person: Person, learnt: Learnt | None
    ) -> ParameterValue:
        block = self.program.shifts.get(parameter.name)
        return adjusted(value, parameter, shift_of(block, person) if block else None, learnt)

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
        from comity_fis.rulebook.batch import infer_many

        return infer_many(self, columns)

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

        return control_system(self, points)

    def with_rule(self, number: int, rule: Rule | str) -> Rulebook:
        """The same rulebook with one rule replaced; blocks that neither rule concludes are shared.

        Args:
            number: Of the rule to replace, from 1.
            rule: The new one, which takes over the number; or its text, which takes over nothing: sources and
                evidence of the old rule do not speak for it.

        Raises:
            InputError: if there is no such rule, or the text cannot be read.
        """
        from comity_fis.rulebook.replacement import replaced_rule

        new = replaced_rule(self, number, rule)
        touched = {is_.name for either in (self.rules[number - 1], new) for is_ in either.consequents}
        return replace(
            self,
            rules=(*self.rules[: number - 1], new, *self.rules[number:]),
            before=self.program,
            anew=frozenset(touched),
        )

    def checked_inputs(self, inputs: Inputs) -> dict[str, Stated | None]:
        """A value or None for every variable, in declared order.

        Raises:
            InputError: if a name is unknown or a value is outside its variable's domain.
        """
        return self._checked(self._told(inputs)[0])

    def _checked(self, told: Inputs) -> dict[str, Stated | None]:
        return {
            name: None
            if (value := told.get(name)) is None
            else variable.check(value)
            if isinstance(value, PLAIN)
            else known(variable, value)
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
        for name, fact in self.derivations:
            if name not in told and told.get(fact) is not None:
                told[name], source, note = derived(self.variables[name], told[fact], self.variables)
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
        return tuple(
            {clause.rule.number: clause.rule for clause in self.program.block(parameter).clauses}.values()
        )

    def reads(self, parameter: str) -> tuple[str, ...]:
        """The variables and other parameters that a parameter's rules read, and those that only move it."""
        shift = self.program.shifts.get(parameter)
        return (*self.program.block(parameter).reads, *(shift.reads if shift else ()))


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
