"""A rulebook's rules, compiled: what can be worked out once is, and never changes afterwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from comity_fis.defuzzification.closed_form import ClosedForm, closed_form
from comity_fis.rules.antecedent import (
    Antecedent,
    Literal,
    Logic,
    Modified,
    compile_antecedent,
    logic_of,
)
from comity_fis.rules.methods import MAMDANI, Methods
from comity_fis.rules.rule import Rule
from comity_fis.rules.rule import literals as literals_of
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.variables.variable import Variable


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
    """By the numbers of their rules."""
    reads: tuple[str, ...]
    """The variables and other parameters in the rules' antecedents."""
    needs: tuple[str, ...]
    """The same and those that the requirements of categories read."""
    refusals: Mapping[str, Antecedent]
    """Of a nominal parameter's guarded categories: the opposite of what must hold.

    What an undisclosed value might be, it might also not be: the opposite then holds to degree 1, and the
    category is refused.
    """
    form: ClosedForm | None
    """Of a numeric parameter's centre of area, where its terms allow one."""
    repeats: bool = field(init=False)
    """Whether a rule gives the parameter two terms, and has two clauses."""
    stops: tuple[tuple[int, int], ...] = field(init=False)
    """For each literal without which a clause cannot hold, the others, which can; clause i is bit i."""

    def __post_init__(self) -> None:
        numbers = {clause.rule.number for clause in self.clauses}
        object.__setattr__(self, "repeats", len(numbers) < len(self.clauses))
        object.__setattr__(self, "stops", _stops(self.clauses))

    def firings(self, degrees: Sequence[float], logic: Logic[float]) -> list[Firing]:
        """The clauses that hold, from the degrees of all literals; most of many rules are never looked at."""
        possible = (1 << len(self.clauses)) - 1
        for literal, others in self.stops:
            if degrees[literal] == 0.0:
                possible &= others
        firings = []
        while possible:
            clause = self.clauses[(possible & -possible).bit_length() - 1]
            possible &= possible - 1
            strength = clause.weight * clause.antecedent.strength(degrees, logic)
            if strength > 0.0:
                firings.append((clause, strength))
        return firings


# Plain tuples where an inference unpacks them: Python takes twice as long for named ones.

Firing = tuple[Clause, float]
"""A clause that holds, with its strength in (0, 1]."""

Question = tuple[int, Callable[[Any], float]]
"""The number of a literal about a variable, and its degree for a value that is known precisely."""


@dataclass(frozen=True, slots=True)
class Program:
    """All blocks of a rulebook, over one table of literals."""

    blocks: tuple[Block, ...]
    """In an order in which they can be evaluated."""
    literals: tuple[Literal, ...]
    """What antecedents are made of, by number. A block that another rulebook shares keeps its numbers: the
    table only ever grows at its end."""
    variables: Mapping[str, Variable]
    """That the literals are about, besides parameters."""
    methods: Methods = MAMDANI
    """How the blocks are evaluated; they are compiled in the same way for all."""
    shifts: Mapping[str, Block] = field(default_factory=dict)
    """For each parameter that the situation may move, the rules of by how much."""
    questions: Mapping[str, tuple[Question, ...]] = field(init=False)
    """By variable."""
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
        questions = {name: self._questions(name) for name in about if name in self.variables}
        object.__setattr__(self, "questions", questions)
        lines: dict[str, tuple[Block, ...]] = {}
        for block in self.blocks:
            before = (line for name in block.reads if name in lines for line in lines[name])
            lines[block.parameter.name] = (*{id(other): other for other in before}.values(), block)
        object.__setattr__(self, "lines", lines)

    def _questions(self, name: str) -> tuple[Question, ...]:
        questions: list[Question] = []
        for number in self.about[name]:
            _, term, exponent, negated = self.literals[number]
            membership: Any = self.variables[name].terms[term]  # over numbers or over words
            plain = exponent == 1.0 and not negated
            asked = membership if plain else Modified(membership, exponent, negated)
            questions.append((number, asked.__call__))  # a method is called sooner than its object
        return tuple(questions)

    def block(self, parameter: str) -> Block:
        """The block of one parameter."""
        return self.lines[parameter][-1]

    def up_to(self, parameter: str) -> tuple[Block, ...]:
        """The block of one parameter, behind those that it needs."""
        return self.lines[parameter]


def compile_block(
    parameter: Parameter, rules: Sequence[Rule], literals: dict[Literal, int], methods: Methods
) -> Block:
    """The block of a parameter; rules that are off or conclude none of its terms are passed over.

    Args:
        parameter: What is decided.
        rules: Of the rulebook.
        literals: Known ones with their numbers; new ones are added.
        methods: Of the rulebook.
    """
    clauses = tuple(
        Clause(rule, rule.weight, is_.term, compile_antecedent(rule.antecedent, literals), rule.reads)
        for rule in sorted(rules, key=lambda rule: rule.number)
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
    form = (
        closed_form(parameter.terms, parameter.rules, methods)
        if isinstance(parameter, NumericParameter)
        else None
    )
    guards = [c.requires for c in getattr(parameter, "categories", ()) if c.requires is not None]
    needs = dict.fromkeys((*reads, *(literal.name for guard in guards for literal in literals_of(guard))))
    return Block(parameter, clauses, reads, tuple(needs), refusals, form)


def _stops(clauses: Sequence[Clause]) -> tuple[tuple[int, int], ...]:
    every = (1 << len(clauses)) - 1
    others: dict[int, int] = {}
    for i, clause in enumerate(clauses):
        for literal in clause.antecedent.necessary:
            others[literal] = others.get(literal, every) & ~(1 << i)
    return tuple(others.items())
