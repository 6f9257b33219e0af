"""What each rule contributes to a value: the parts add up to the value itself.

Each point under the aggregated set belongs to the rule that attains the maximum there (to several in equal
parts where they tie). A rule's share is its part of the area; its contribution is the moment of its part
over the whole area, so that the sum of all contributions is the centre of area.
"""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.centroid import Cut
from comity_fis.ownership import Piece, pieces_of
from comity_fis.parameter import NumericParameter
from comity_fis.rule import Rule
from comity_fis.value import ParameterValue


@dataclass(frozen=True, slots=True)
class Portion:
    """What one rule owns of the aggregated set."""

    share: float
    """Of the area, in [0, 1]."""
    contribution: float
    """In the parameter's unit."""


@dataclass(frozen=True, slots=True)
class Attribution:
    """The aggregated set of one numeric parameter, divided among the rules that fired."""

    rules: tuple[Rule, ...]
    """What the owners of the pieces stand for: a rule once for each term that it gives."""
    terms: tuple[str, ...]
    """The term of each of them."""
    pieces: tuple[Piece, ...]
    area: float

    def portions(self) -> dict[int, Portion]:
        """Each rule's portion, by its number."""
        areas = dict.fromkeys((rule.number for rule in self.rules), 0.0)
        moments = dict(areas)
        for piece in self.pieces:
            owners = {self.rules[owner].number for owner in piece.owners}
            for number in owners:
                areas[number] += piece.area / len(owners)
                moments[number] += piece.moment / len(owners)
        return {number: Portion(areas[number] / self.area, moments[number] / self.area) for number in areas}


def attribute(value: ParameterValue, parameter: NumericParameter) -> Attribution:
    """Divide what the rules gave; nothing is divided where no rule decided the value."""
    if not value.decided_by_rules:
        return Attribution((), (), (), 0.0)
    given = [
        (firing.rule, is_.term, Cut(parameter.terms[is_.term], firing.strength))
        for firing in value.fired
        for is_ in firing.rule.consequents
        if is_.name == parameter.name and is_.term in parameter.terms
    ]
    pieces = pieces_of([cut for _, _, cut in given], *parameter.rules.ends)
    return Attribution(
        rules=tuple(rule for rule, _, _ in given),
        terms=tuple(term for _, term, _ in given),
        pieces=pieces,
        area=sum(piece.area for piece in pieces),
    )
