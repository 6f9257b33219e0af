"""What each rule contributes to a value: the parts add up to the value itself.

Each point under the aggregated set belongs to the rule that attains the maximum there (to several in equal
parts where they tie). A rule's share is its part of the area; its contribution is the moment of its part
over the whole area, so that the sum of all contributions is the centre of area.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

from comity_fis.defuzzification.closed_form import ClosedForm
from comity_fis.explanation.neighbours import parts_of
from comity_fis.explanation.owned import Group, Owner, Part, Piece
from comity_fis.explanation.ownership import pieces_of
from comity_fis.inference.value import ParameterValue
from comity_fis.rules.antecedent import TIE
from comity_fis.rules.rule import Rule
from comity_fis.variables.parameter import NumericParameter


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
    """That rules gave; an owner stands for the first so many rules of one of them."""
    rules: tuple[tuple[Rule, ...], ...]
    """Of each term, the strongest first."""
    groups: tuple[Group, ...]
    """The strengths of these rules."""
    parts: tuple[Part, ...]
    """Who owns what."""
    domain: tuple[float, float]
    area: float
    """Of the whole set."""
    moment: float
    """Of the whole set about 0."""

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The outline from left to right."""
        return pieces_of(self.groups, *self.domain) if self.groups else ()

    def owners(self, owners: Iterable[Owner]) -> tuple[Rule, ...]:
        """The rules that they stand for, each once."""
        rules = (rule for term, count in owners for rule in self.rules[term][:count])
        return tuple({rule.number: rule for rule in rules}.values())

    def portions(self) -> dict[int, Portion]:
        """Each rule's portion, by its number."""
        areas = {rule.number: 0.0 for rules in self.rules for rule in rules}
        moments = dict(areas)
        for number, area, moment in self._of_rules():
            areas[number] += area
            moments[number] += moment
        return {number: Portion(areas[number] / self.area, moments[number] / self.area) for number in areas}

    def _of_rules(self) -> Iterator[tuple[int, float, float]]:
        """Numbers of rules with area and moment; several times for a rule."""
        alone = [[(0.0, 0.0)] * len(rules) for rules in self.rules]
        for owners, area, moment, _ in self.parts:
            if len(owners) == 1:
                ((term, count),) = owners
                before = alone[term][count - 1]
                alone[term][count - 1] = before[0] + area / count, before[1] + moment / count
            elif owners:
                rules = self.owners(owners)
                for rule in rules:
                    yield rule.number, area / len(rules), moment / len(rules)
        # A rule has its part of whatever it owns together with weaker ones.
        for rules, parts in zip(self.rules, alone, strict=True):
            area = moment = 0.0
            for rule, part in zip(reversed(rules), reversed(parts), strict=True):
                area, moment = area + part[0], moment + part[1]
                yield rule.number, area, moment


NOTHING = Attribution((), (), (), (), (0.0, 0.0), 0.0, 0.0)
"""Where no rule decided."""


def attribute(value: ParameterValue, parameter: NumericParameter) -> Attribution:
    """Divide what the rules gave; nothing is divided where no rule decided the value."""
    if not value.decided_by_rules:
        return NOTHING
    given = (
        (rule, is_.term, strength)
        for rule, strength in value.fired
        for is_ in rule.consequents
        if is_.name == parameter.name and is_.term in parameter.terms
    )
    return divided(given, parameter, None)


def divided(
    given: Iterable[tuple[Rule, str, float]], parameter: NumericParameter, form: ClosedForm | None
) -> Attribution:
    """Divide what rules gave.

    Args:
        given: Rules with a term and a strength, strongest first.
        parameter: Whose the terms are.
        form: Of its centre of area, where it has one: then it is quicker.
    """
    by_term: dict[str, list[tuple[Rule, float]]] = {}
    level = inf
    for rule, term, strength in given:
        if level - strength > TIE:
            level = strength
        by_term.setdefault(term, []).append((rule, level))
    rules, groups = [], []
    for term, firings in by_term.items():
        of_term, strengths = zip(*firings, strict=True)
        rules.append(of_term)
        groups.append(Group(parameter.terms[term], strengths))
    parts = (
        [piece.part for piece in pieces_of(groups, *parameter.rules.ends)]
        if form is None
        else parts_of(form, tuple(by_term), groups)
    )
    area = moment = 0.0
    for _, own_area, own_moment, _ in parts:
        area, moment = area + own_area, moment + own_moment
    terms = tuple(by_term)
    return Attribution(terms, tuple(rules), tuple(groups), tuple(parts), parameter.rules.ends, area, moment)
