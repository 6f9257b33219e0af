"""The rules that hold for somebody, and what a value rests on that they give."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import itemgetter
from typing import TYPE_CHECKING, NamedTuple

from comity_fis.inference.block import Block, Firing
from comity_fis.inference.composition import Basis
from comity_fis.inference.value import FiredRule, Origin
from comity_fis.rules.methods import Methods

if TYPE_CHECKING:
    from comity_fis.inference.inference import Person


class Fired(NamedTuple):
    """The rules of a block that hold for somebody."""

    clauses: Sequence[Firing]
    strengths: Mapping[str, float]
    """The largest of every concluded term, whatever the aggregation; terms in the order in which they first
    came."""
    origin: Origin
    """culture or situation; neutral where no rule holds or none that holds knows anything.

    Rules of whose inputs nothing at all was disclosed hold to degree 1, and would be a guess.
    """

    def given(self, methods: Methods) -> Iterable[tuple[str, float]]:
        """Terms with their strengths: only the strongest of each where no other counts."""
        if methods.aggregation == "max":
            return self.strengths.items()
        return ((clause.term, strength) for clause, strength in self.clauses)


def fire(block: Block, person: Person) -> Fired:
    """What holds for a person of whom everything is known that the block reads."""
    firings = block.firings(person.degrees, person.program.logic)
    strengths: dict[str, float] = {}
    for clause, strength in firings:
        term = clause.term
        if strength > strengths.get(term, 0.0):
            strengths[term] = strength
    return Fired(firings, strengths, _origin(firings, person))


def basis_of(block: Block, fired: Fired) -> Basis:
    """The rules that fired, strongest first, or why there is nothing to go on."""
    if not fired.clauses:
        return Basis("neutral", (), "no rule fires" if block.clauses else "no rule that is on gives it")
    if fired.origin == "neutral":
        reads = dict.fromkeys(name for clause, _ in fired.clauses for name in clause.reads)
        return Basis("neutral", (), f"nothing is known of {', '.join(reads)}")
    strongest_first = sorted(fired.clauses, key=itemgetter(1), reverse=True)
    rules = [FiredRule(clause.rule, strength) for clause, strength in strongest_first]
    if block.repeats:
        rules = list({rule.rule.number: rule for rule in rules}.values())
    return Basis(fired.origin, tuple(rules))


def _origin(firings: Sequence[Firing], person: Person) -> Origin:
    """What those rules know: who the person is, else how things stand, else nothing."""
    origin: Origin = "neutral"
    for clause, _ in firings:
        for name in clause.reads:
            if person.discloses(name):
                if person.tells_culture(name):
                    return "culture"
                origin = "situation"
    return origin
