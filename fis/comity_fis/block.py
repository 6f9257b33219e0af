"""A rulebook's rules, compiled: what can be worked out once is, and never changes afterwards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from comity_fis.antecedent import Antecedent, Literal, Logic, compile_antecedent, logic_of
from comity_fis.closed_form import ClosedForm, closed_form
from comity_fis.methods import MAMDANI, Methods
from comity_fis.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.rule import Rule


class Clause(NamedTuple):
    """One rule, for one term that it concludes."""

    rule: Rule
    weight: float
    term: str
    antecedent: Antecedent
    reads: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Block:
    """A parameter and everything that decides it."""

    parameter: Parameter
    clauses: tuple[Clause, ...]
    reads: tuple[str, ...]
    """The variables and other parameters in the rules' antecedents."""
    refusals: Mapping[str, Antecedent]
    """Of a nominal parameter's guarded categories: the opposite of what must hold.

    What an undisclosed value might be, it might also not be: the opposite then holds to degree 1, and the
    category is refused.
    """
    form: ClosedForm | None
    """Of a numeric parameter's centre of area, where its terms allow one."""


@dataclass(frozen=True, slots=True)
class Program:
    """All blocks of a rulebook, over one table of literals."""

    blocks: tuple[Block, ...]
    """In an order in which they can be evaluated."""
    literals: tuple[Literal, ...]
    """What antecedents are made of, by number. A block that another rulebook shares keeps its numbers: the
    table only ever grows at its end."""
    methods: Methods = MAMDANI
    """How the blocks are evaluated; they are compiled in the same way for all."""
    shifts: Mapping[str, Block] = field(default_factory=dict)
    """For each parameter that the situation may move, the rules of by how much."""
    logic: Logic[float] = field(init=False)
    """What `and` and `or` mean."""
    about: Mapping[str, tuple[int, ...]] = field(init=False)
    """The numbers of the literals about each variable or parameter."""
    lines: Mapping[str, tuple[Block, ...]] = field(init=False)
    """For each parameter, the blocks that it needs, in order, and its own at the end."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "logic", logic_of(self.methods))
        about: dict[str, tuple[int, ...]] = {}
        for number, literal in enumerate(self.literals):
            about[literal.name] = (*about.get(literal.name, ()), number)
        object.__setattr__(self, "about", about)
        lines: dict[str, tuple[Block, ...]] = {}
        for block in self.blocks:
            before = (line for name in block.reads if name in lines for line in lines[name])
            lines[block.parameter.name] = (*{id(other): other for other in before}.values(), block)
        object.__setattr__(self, "lines", lines)

    def block(self, parameter: str) -> Block:
        """The block of one parameter."""
        return self.lines[parameter][-1]

    def up_to(self, parameter: str) -> tuple[Block, ...]:
        """The block of one parameter, behind those that it needs."""
        return self.lines[parameter]


def compile_block(parameter: Parameter, rules: Sequence[Rule], literals: dict[Literal, int]) -> Block:
    """The block of a parameter; rules that are off or conclude none of its terms are passed over.

    Args:
        parameter: What is decided.
        rules: Of the rulebook.
        literals: Known ones with their numbers; new ones are added.
    """
    clauses = tuple(
        Clause(rule, rule.weight, is_.term, compile_antecedent(rule.antecedent, literals), rule.reads)
        for rule in rules
        for is_ in rule.consequents
        if rule.enabled and is_.name == parameter.name and is_.term in parameter.terms
    )
    reads = tuple(dict.fromkeys(name for clause in clauses for name in clause.reads))
    refusals: dict[str, Antecedent] = {}
    if isinstance(parameter, NominalParameter):
        refusals = {
            category.name: compile_antecedent(category.requires, literals, negated=True)
            for category in parameter.categories
            if category.requires is not None
        }
    form = closed_form(parameter.terms, parameter.rules) if isinstance(parameter, NumericParameter) else None
    return Block(parameter, clauses, reads, refusals, form)
