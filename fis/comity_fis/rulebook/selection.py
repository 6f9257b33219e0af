"""A part of a rulebook: some of its parameters, with the rules and variables they depend on."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from comity_fis.errors import unknown_word
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.rule import Rule, literals
from comity_fis.variables.parameter import NominalParameter, Parameter


def selected(rulebook: Rulebook, names: Collection[str]) -> Rulebook:
    """The rulebook reduced to some parameters, each inferred as in the full rulebook.

    Parameters that their rules read are included. Rules are renumbered; a rule that concludes several
    parameters keeps only the conclusions about included ones.

    Args:
        rulebook: The full rulebook.
        names: Names of the parameters to keep.

    Raises:
        InputError: There is no such parameter.
    """
    for name in names:
        if name not in rulebook.parameters:
            raise unknown_word(f"a parameter of the rulebook {rulebook.name}", name, rulebook.parameters)
    needed = {block.parameter.name for name in names for block in rulebook.program.up_to(name)}
    parameters = {name: kept for name, kept in rulebook.parameters.items() if name in needed}
    rules = tuple(replace(rule, number=i) for i, rule in enumerate(_about(rulebook.rules, needed), 1))
    read = {name for rule in rules for name in rule.reads} | {*_required(parameters.values())}
    variables = {name: variable for name, variable in rulebook.variables.items() if name in read}
    return replace(rulebook, variables=variables, parameters=parameters, rules=rules)


def _about(rules: Collection[Rule], parameters: Collection[str]) -> Iterator[Rule]:
    for rule in rules:
        consequents = tuple(is_ for is_ in rule.consequents if is_.name in parameters)
        if consequents:
            yield replace(rule, consequents=consequents)


def _required(parameters: Collection[Parameter]) -> Iterator[str]:
    """The variables in the conditions that categories require."""
    for parameter in parameters:
        if isinstance(parameter, NominalParameter):
            for category in parameter.categories:
                if category.requires is not None:
                    yield from (is_.name for is_ in literals(category.requires))
