"""Finds the rules of a rulebook that depend on gender or nationality rather than on the person alone."""

from __future__ import annotations

from collections.abc import Mapping

from comity.parameters.standing import reads_culture
from comity_fis import Rulebook

GENDER, NATIONALITY = "gender", "nationality"


def group_rules(rulebook: Rulebook) -> Mapping[str, tuple[int, ...]]:
    """Numbers of the enabled rules that read `gender` or `nationality`, by these names.

    A rule depends on nationality if it reads a culture, or a score derived from a culture.
    """
    read = {GENDER: {GENDER}, NATIONALITY: {variable.name for variable in reads_culture(rulebook)}}
    found = {
        group: tuple(rule.number for rule in rulebook.rules if rule.enabled and names & set(rule.reads))
        for group, names in read.items()
    }
    return {group: numbers for group, numbers in found.items() if numbers}
