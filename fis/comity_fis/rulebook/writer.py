"""Writes a rulebook as a YAML file."""

from __future__ import annotations

from dataclasses import asdict
from math import isfinite
from typing import Any

from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.variable_data import derivation_data, term_data, variable_data
from comity_fis.rules.methods import MAMDANI
from comity_fis.rules.rule import Rule
from comity_fis.validation.yaml_file import dump_yaml
from comity_fis.variables.parameter import NominalParameter, NumericParameter
from comity_fis.variables.shift import Shift
from comity_fis.variables.variable import NominalVariable, NumericVariable, OrdinalVariable

FIRST_LINE = "# Written by Comity"
"""First line that marks a file as safe to overwrite."""


def rulebook_yaml(rulebook: Rulebook, origin: str, command: str = "comity convert") -> str:
    """The text of a rulebook file that reads back as the same rulebook.

    Args:
        rulebook: Any rulebook; score tables keep the names it uses.
        origin: What it was made from, for the first line.
        command: The command that may overwrite the file.
    """
    content: dict[str, Any] = {
        "schema_version": 1,
        "name": rulebook.name,
        "description": rulebook.description,
        "sources": {
            key: _stated(
                citation=source.citation,
                verified=source.verified,
                found=source.found or None,
                measured=source.measured or None,
            )
            for key, source in rulebook.sources.items()
        },
        "variables": {
            name: variable_data(v, digits=None) if isinstance(v, NumericVariable) else _worded_variable(v)
            for name, v in rulebook.variables.items()
        },
        "parameters": {
            name: _numeric_parameter(p) if isinstance(p, NumericParameter) else _nominal_parameter(p)
            for name, p in rulebook.parameters.items()
        },
    }
    if rulebook.methods != MAMDANI:
        content["methods"] = asdict(rulebook.methods)
    content["rules"] = [_rule(rule) for rule in rulebook.rules]
    return f"{FIRST_LINE} from {origin}; `{command}` may overwrite it.\n{dump_yaml(content)}"


def _worded_variable(variable: NominalVariable) -> dict[str, Any]:
    keys = {row.key for row in variable.table.rows} if variable.table else set[str]()
    return _stated(
        kind=variable.kind,
        level=str(variable.level),
        categories=[name for name in variable.categories if name not in keys],
        categories_from=variable.table.name if variable.table else None,
        numbered_from=variable.numbered_from if isinstance(variable, OrdinalVariable) else None,
        groups={name: sorted(group.members) for name, group in variable.groups.items()} or None,
        derived_from=variable.derived_from and derivation_data(variable.derived_from),
        reason=variable.reason,
    )


def _numeric_parameter(parameter: NumericParameter) -> dict[str, Any]:
    safe = {"at_least": parameter.safe.low, "at_most": parameter.safe.high}
    return _stated(
        kind=parameter.kind,
        level="interval",
        unit=parameter.unit,
        measured=parameter.measured,
        rules=list(parameter.rules.ends),
        ask=list(parameter.ask.ends),
        safe={end: limit for end, limit in safe.items() if isfinite(limit)} or None,
        terms={name: term_data(term, digits=None) for name, term in parameter.terms.items()},
        shapes=parameter.shapes,
        neutral=parameter.neutral,
        spread=parameter.spread,
        shift=_shift(parameter.shift) if parameter.shift else None,
        reasons=dict(parameter.reasons),
    )


def _shift(shift: Shift) -> dict[str, Any]:
    return _stated(
        range=list(shift.range.ends),
        terms={name: term_data(term, digits=None) for name, term in shift.terms.items()},
        shapes=shift.shapes,
        reason=shift.reason,
    )


def _nominal_parameter(parameter: NominalParameter) -> dict[str, Any]:
    return _stated(
        kind=parameter.kind,
        level="nominal",
        categories=list(parameter.terms),
        requires={c.name: str(c.requires) for c in parameter.categories if c.requires} or None,
        neutral=parameter.neutral,
        reasons=dict(parameter.reasons),
    )


def _rule(rule: Rule) -> dict[str, Any]:
    return _stated(
        rule=rule.text,
        sources=[source.key for source in rule.sources],
        evidence=rule.evidence,
        counter_evidence=rule.counter_evidence or None,
        note=rule.note or None,
        weight=rule.weight if rule.weight != 1 else None,
        enabled=None if rule.enabled else False,
        finding=rule.finding or None,
    )


def _stated(**keys: Any) -> dict[str, Any]:
    """The given keys, without those that are None."""
    return {key: value for key, value in keys.items() if value is not None}
