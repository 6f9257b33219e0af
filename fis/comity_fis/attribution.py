"""What each rule contributes to a value: the parts add up to the value itself.

Each point under the aggregated set belongs to the rule that attains the maximum there (to several in equal
parts where they tie). A rule's share is its part of the area; its contribution is the moment of its part
over the whole area, so that the sum of all contributions is the centre of area.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

from comity_fis.antecedent import TIE
from comity_fis.ownership import Group, Piece, pieces_of
from comity_fis.parameter import NumericParameter
from comity_fis.rule import Rule
from comity_fis.value import ParameterValue


class Portion(NamedTuple):
    """What one rule owns of the aggregated set."""

    share: float
    """Of the area, in [0, 1]."""
    contribution: float
    """In the parameter's unit."""


@dataclass(frozen=True, slots=True)
class Attribution:
    """The aggregated set of one numeric parameter, divided among the rules that fired."""

    terms: tuple[str, ...]
    """That rules gave; an owner of a piece stands for the first so many rules of one of them."""
    rules: tuple[tuple[Rule, ...], ...]
    """Of each term, the strongest first."""
    pieces: tuple[Piece, ...]
    area: float

    @property
    def moment(self) -> float:
        """About 0."""
        return sum([piece.moment for piece in self.pieces])

    def owners(self, piece: Piece) -> tuple[Rule, ...]:
        """The rules that attain the maximum over a piece, each once."""
        rules = (rule for term, count in piece.owners for rule in self.rules[term][:count])
        return tuple({rule.number: rule for rule in rules}.values())

    def portions(self) -> dict[int, Portion]:
        """Each rule's portion, by its number."""
        areas = {rule.number: 0.0 for rules in self.rules for rule in rules}
        moments = dict(areas)
        for number, area, moment in self._parts():
            areas[number] += area
            moments[number] += moment
        return {number: Portion(areas[number] / self.area, moments[number] / self.area) for number in areas}

    def _parts(self) -> Iterator[tuple[int, float, float]]:
        """Numbers of rules with area and moment; several times for a rule."""
        alone = [[(0.0, 0.0)] * len(rules) for rules in self.rules]
        for piece in self.pieces:
            if len(piece.owners) == 1:
                term, count = piece.owners[0]
                area, moment = alone[term][count - 1]
                alone[term][count - 1] = area + piece.area / count, moment + piece.moment / count
            elif piece.owners:
                owners = self.owners(piece)
                for rule in owners:
                    yield rule.number, piece.area / len(owners), piece.moment / len(owners)
        # A rule has its part of whatever it owns together with weaker ones.
        for rules, parts in zip(self.rules, alone, strict=True):
            area = moment = 0.0
            for rule, part in zip(reversed(rules), reversed(parts), strict=True):
                area, moment = area + part[0], moment + part[1]
                yield rule.number, area, moment


NOTHING = Attribution((), (), (), 0.0)
"""Where no rule decided."""


def attribute(value: ParameterValue, parameter: NumericParameter) -> Attribution:
    """Divide what the rules gave; nothing is divided where no rule decided the value."""
    if value.origin not in ("culture", "situation"):
        return NOTHING
    given: dict[str, list[tuple[Rule, float]]] = {}
    level = inf
    for rule, strength in value.fired:  # strongest first
        if level - strength > TIE:
            level = strength
        for is_ in rule.consequents:
            if is_.name == parameter.name:
                given.setdefault(is_.term, []).append((rule, level))
    groups = [
        Group(parameter.terms[term], tuple([strength for _, strength in firings]))
        for term, firings in given.items()
    ]
    pieces = pieces_of(groups, *parameter.rules.ends)
    return Attribution(
        terms=tuple(given),
        rules=tuple([tuple([rule for rule, _ in firings]) for firings in given.values()]),
        pieces=pieces,
        area=sum([piece.area for piece in pieces]),
    )
