"""Which rules of a rulebook go by a group that a person is counted to, and not by the person alone."""

from __future__ import annotations

from collections.abc import Mapping

from comity.parameters.standing import reads_culture
from comity_fis import Rulebook

GENDER, NATIONALITY = "gender", "nationality"


def group_rules(rulebook: Rulebook) -> Mapping[str, tuple[int, ...]]:
    """By `gender` and `nationality`, the numbers of the rules that are on and read it.

    A rule reads nationality where it reads a culture, or a score that a table gives a culture.
    """
    read = {GENDER: {GENDER}, NATIONALITY: {variable.name for variable in reads_culture(rulebook)}}
    found = {
        group: tuple(rule.number for rule in rulebook.rules if rule.enabled and names & set(rule.reads))
        for group, names in read.items()
    }
    return {group: numbers for group, numbers in found.items() if numbers}
