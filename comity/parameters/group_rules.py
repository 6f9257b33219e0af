"""Which rules of a rulebook go by a group that a person is counted to, and not by the person alone."""

from __future__ import annotations

from collections.abc import Mapping

from comity_fis import NominalVariable, Rulebook

GENDER, NATIONALITY = "gender", "nationality"


def group_rules(rulebook: Rulebook) -> Mapping[str, tuple[int, ...]]:
    """By `gender` and `nationality`, the numbers of the rules that are on and read it.

    A rule reads nationality where it reads a culture, or a score that a table gives a culture.
    """
    found = {
        group: tuple(
            rule.number
            for rule in rulebook.rules
            if rule.enabled and any(_group(rulebook, name) == group for name in rule.reads)
        )
        for group in (GENDER, NATIONALITY)
    }
    return {group: numbers for group, numbers in found.items() if numbers}


def _group(rulebook: Rulebook, name: str) -> str | None:
    variable = rulebook.variables.get(name)
    if name == GENDER:
        return GENDER
    if isinstance(variable, NominalVariable) and variable.tells_culture:
        return NATIONALITY
    derived = getattr(variable, "derived_from", None)
    return NATIONALITY if derived is not None and derived.table is not None else None
