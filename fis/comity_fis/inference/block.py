"""The rules that determine each parameter, in an order in which they can be evaluated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from comity_fis.defuzzification.closed_form import ClosedForm, closed_form
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Condition, Rule, literals
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.variables.variable import Variable


class Clause(NamedTuple):
    """One rule, restricted to one term that it concludes."""

    rule: Rule
    term: str


@dataclass(frozen=True, slots=True)
class Block:
    """A parameter and the rules that determine it."""

    parameter: Parameter
    clauses: tuple[Clause, ...]
    """In the order of rule numbers; a rule that concludes two terms of the parameter has two clauses."""
    form: ClosedForm | None
    """Closed form of a numeric parameter's centre of area, if its terms allow one."""

    @property
    def reads(self) -> tuple[str, ...]:
        """The variables and other parameters in the rules' antecedents."""
        return tuple(dict.fromkeys(name for clause in self.clauses for name in clause.rule.reads))

    @property
    def needs(self) -> tuple[str, ...]:
        """The same, plus those read by the requirements of categories."""
        guards = (is_.name for guard in self.requirements.values() for is_ in literals(guard))
        return tuple(dict.fromkeys((*self.reads, *guards)))

    @property
    def requirements(self) -> Mapping[str, Condition]:
        """Conditions for permitting categories of a nominal parameter, by category."""
        if not isinstance(self.parameter, NominalParameter):
            return {}
        return {one.name: one.requires for one in self.parameter.categories if one.requires is not None}


@dataclass(frozen=True, slots=True)
class Program:
    """All blocks of one rulebook."""

    blocks: Mapping[str, Block]
    """Blocks by parameter, each after those that its rules read."""
    variables: Mapping[str, Variable]
    methods: Methods
    shifts: Mapping[str, Block]
    """Blocks of the shift rules, for each parameter that the situation may shift."""

    @property
    def reads(self) -> frozenset[str]:
        """The variables and parameters read by active rules and requirements."""
        return frozenset(
            name for block in (*self.blocks.values(), *self.shifts.values()) for name in block.needs
        )

    def up_to(self, parameter: str) -> tuple[Block, ...]:
        """The block of one parameter, preceded by those of the parameters that it needs."""
        needed = {parameter}
        for name, block in reversed(list(self.blocks.items())):
            if name in needed:
                needed.update(block.reads)
        return tuple(block for name, block in self.blocks.items() if name in needed)


def block_of(parameter: Parameter, rules: Sequence[Rule], methods: Methods = MAMDANI) -> Block:
    """The block of a parameter; inactive rules and rules for other parameters are ignored."""
    form = (
        closed_form(parameter.terms, parameter.rules, methods)
        if isinstance(parameter, NumericParameter)
        else None
    )
    return Block(parameter, tuple(_clauses(parameter, rules)), form)


def _clauses(parameter: Parameter, rules: Sequence[Rule]) -> Iterator[Clause]:
    for rule in sorted(rules, key=lambda rule: rule.number):
        for is_ in rule.consequents if rule.enabled else ():
            if is_.name == parameter.name and is_.term in parameter.terms:
                yield Clause(rule, is_.term)
