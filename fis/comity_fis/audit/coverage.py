"""Coverage: for which people rules apply, and who gets the neutral value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_fis.audit.evidence import deciding_rules
from comity_fis.audit.sweep import decided_by
from comity_fis.record import Record
from comity_fis.rules.rule import literals
from comity_fis.scores.shipped import individualism_scores
from comity_fis.variables.own_words import CULTURE
from comity_fis.variables.variable import NominalVariable

if TYPE_CHECKING:
    from comity_fis.audit.attributes import Attribute
    from comity_fis.rulebook.rulebook import Rulebook


@dataclass(frozen=True, slots=True)
class Reached(Record):
    """Coverage of one parameter if a single fact is known."""

    parameter: str
    attribute: str
    values: int
    """Number of values of the attribute; of a number, one per term."""
    neutral: tuple[str, ...]
    """Number of values for which a rule applies."""


@dataclass(frozen=True, slots=True)
class Coverage(Record):
    """The people covered by a rulebook."""

    scored: int
    """Number of rows of the score tables, each culture once."""
    cultures: int
    """Number of them that change something when only the culture is known."""
    named: tuple[str, ...]
    """Cultures named by a rule, alone or in a group."""
    alone: tuple[Reached, ...]
    """By parameter, for each attribute that can change it."""
    unread: Mapping[str, tuple[str, ...]]
    """By parameter, attributes without effect on it."""
    unruled: tuple[str, ...]
    """Parameters without any rule: everyone gets the neutral value."""


def coverage(rulebook: Rulebook, known: Mapping[str, Attribute]) -> Coverage:
    """Compute the coverage by disclosing one fact at a time."""
    scored = _scored(rulebook)
    deciding = {name: decided_by(rulebook, name, known) for name in rulebook.parameters}
    alone = tuple(
        _reached(rulebook, name, attribute) for name in deciding for attribute in deciding[name].values()
    )
    by_culture = [one for one in alone if one.attribute == CULTURE]
    reached = scored & set(known[CULTURE].labels) if by_culture else set()
    for one in by_culture[:1]:
        reached -= set(one.neutral).intersection(*(other.neutral for other in by_culture))
    return Coverage(
        scored=len(scored),
        cultures=len(reached),
        named=_named(rulebook),
        alone=alone,
        unread={
            name: tuple(attribute for attribute in known if attribute not in decides)
            for name, decides in deciding.items()
        },
        unruled=tuple(name for name, decides in deciding.items() if not decides),
    )


def _scored(rulebook: Rulebook) -> frozenset[str]:
    """The cultures in the tables that variables are derived from; of individualism where there are none."""
    tables = [
        variable.derived_from.table.rows
        for variable in rulebook.variables.values()
        if variable.derived_from and variable.derived_from.fact == CULTURE and variable.derived_from.table
    ]
    return frozenset(row.key for rows in tables or [individualism_scores()] for row in rows)


def _reached(rulebook: Rulebook, parameter: str, attribute: Attribute) -> Reached:
    neutral = []
    for place in attribute.levels:
        inference = rulebook.infer(said(rulebook, attribute, place))
        if inference[parameter].origin == "neutral":
            neutral.append(attribute.labels[place])
    return Reached(parameter, attribute.name, len(attribute.levels), tuple(neutral))


def said(rulebook: Rulebook, attribute: Attribute, place: int) -> dict[str, object]:
    """The variables of a person of whom the value at a place is known, words as words."""
    facts = attribute.facts(place)
    for name, value in facts.items():
        variable = rulebook.variables[name]
        if isinstance(variable, NominalVariable):
            assert isinstance(value, int)
            facts[name] = variable.categories[value - variable.first_number]
    return facts


def _named(rulebook: Rulebook) -> tuple[str, ...]:
    """Cultures in the conditions of rules that decide something, in the table's order."""
    variable = rulebook.variables.get(CULTURE)
    if not isinstance(variable, NominalVariable):
        return ()
    deciding = deciding_rules(rulebook)
    terms = {
        literal.term
        for rule in rulebook.rules
        if rule.number in deciding
        for literal in literals(rule.antecedent)
        if literal.name == CULTURE
    }
    members = {member for term in terms for member in variable.terms[term].members}
    return tuple(category for category in variable.categories if category in members)
