"""A part of a rulebook: some of its parameters, with the rules and variables that decide them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from comity_fis.errors import unknown_word
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.rule import Rule, literals
from comity_fis.variables.parameter import NominalParameter, Parameter


def selected(rulebook: Rulebook, names: Collection[str]) -> Rulebook:
    """The rulebook with some of its parameters only, each inferred as it is in the whole.

    Parameters that their rules read come along. Rules are counted again, and one that concludes several
    parameters keeps what it says about these.

    Args:
        rulebook: The whole.
        names: Of the parameters to keep.

    Raises:
        InputError: if there is no such parameter.
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
    """The variables that categories make a condition of."""
    for parameter in parameters:
        if isinstance(parameter, NominalParameter):
            for category in parameter.categories:
                if category.requires is not None:
                    yield from (is_.name for is_ in literals(category.requires))
