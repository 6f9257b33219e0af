"""The rules that fire for a person, and the origin of the resulting value."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import NamedTuple

from comity_fis.inference.block import Block
from comity_fis.inference.composition import Basis
from comity_fis.inference.person import DisclosedPerson
from comity_fis.inference.value import FiredRule, Origin
from comity_fis.rules.antecedent import strength
from comity_fis.rules.methods import Methods, united
from comity_fis.rules.rule import Rule


class Firing(NamedTuple):
    """A fired rule, for one term that it concludes."""

    rule: Rule
    term: str
    strength: float
    """Strength, in (0, 1]."""


@dataclass(frozen=True, slots=True)
class Fired:
    """The rules of a block that fire for a person."""

    firings: Sequence[Firing]
    """In the order of rule numbers."""
    origin: Origin
    """`culture` or `situation`; `neutral` if no rule fires that has a known input.

    Rules without any disclosed input fire with degree 1, and would be a guess.
    """

    def strengths(self, methods: Methods) -> dict[str, float]:
        """Combined strength of the rules for every concluded term."""
        return united(((one.term, one.strength) for one in self.firings), methods.aggregation)

    def given(self, methods: Methods) -> Iterable[tuple[str, float]]:
        """Terms with their strengths: only the strongest of each if others do not count."""
        if methods.aggregation == "max":
            return self.strengths(methods).items()
        return ((one.term, one.strength) for one in self.firings)


def fire(block: Block, person: DisclosedPerson) -> Fired:
    """Evaluate the rules for a person of whom everything is known that the block reads."""
    firings = [
        Firing(rule, term, rule.weight * strength(rule.antecedent, person.degree, person.logic))
        for rule, term in block.clauses
    ]
    holding = [firing for firing in firings if firing.strength > 0.0]
    return Fired(holding, _origin(holding, person))


def basis_of(block: Block, fired: Fired) -> Basis:
    """The fired rules, strongest first, or why none applies."""
    if not fired.firings:
        return Basis("neutral", (), "no rule fires" if block.clauses else "no rule that is on gives it")
    if fired.origin == "neutral":
        reads = dict.fromkeys(name for firing in fired.firings for name in firing.rule.reads)
        return Basis("neutral", (), f"nothing is known of {', '.join(reads)}")
    strongest_first = sorted(fired.firings, key=attrgetter("strength"), reverse=True)
    rules = {one.rule.number: FiredRule(one.rule, one.strength) for one in strongest_first}
    return Basis(fired.origin, tuple(rules.values()))


def _origin(firings: Sequence[Firing], person: DisclosedPerson) -> Origin:
    """What those rules know: who the person is, else how things stand, else nothing."""
    disclosed = [name for firing in firings for name in firing.rule.reads if person.discloses(name)]
    if not disclosed:
        return "neutral"
    return "culture" if any(map(person.tells_culture, disclosed)) else "situation"
