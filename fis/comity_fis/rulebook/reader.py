"""Builds a rulebook from a file: every name that a part uses must refer to another part."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache, partial

from comity_fis.errors import Location, WrongValueError, unknown_word
from comity_fis.rulebook.models import (
    NominalParameterModel,
    NominalVariableModel,
    RulebookModel,
    RuleModel,
    Tables,
    VariableModel,
)
from comity_fis.rulebook.named_table import named_populations, named_scores, refuse_outside
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.situation import refuse_person_in_shift
from comity_fis.rules.grammar import Terms, parse_guard, parse_rule
from comity_fis.rules.rule import Condition, Rule, Source, literals
from comity_fis.validation.yaml_file import YamlFile
from comity_fis.variables.parameter import Parameter
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

KEPT = 16
"""Number of compiled rulebooks to cache; only changes of their score tables invalidate them."""


def rulebook_from(file: YamlFile) -> Rulebook:
    """The rulebook of a file, with the current content of the score tables that it names.

    Raises:
        InputError: With the line of the first error.
    """
    model = _checked(file)
    return _compiled(file, tuple(_tables(name, variable, file) for name, variable in model.variables.items()))


@lru_cache(maxsize=KEPT)
def _checked(file: YamlFile) -> RulebookModel:
    return file.check(RulebookModel)


def _tables(name: str, variable: VariableModel, file: YamlFile) -> Tables:
    scores = populations = None
    if (derived := variable.derived_from) is not None and derived.table is not None:
        place = ("variables", name, "derived_from", "table")
        scores = named_scores(derived.table, file, place, column=derived.column, variable=name)
    if isinstance(variable, NominalVariableModel) and variable.categories_from is not None:
        populations = named_populations(
            variable.categories_from, file, ("variables", name, "categories_from")
        )
    return Tables(scores, populations)


@lru_cache(maxsize=KEPT)
def _compiled(file: YamlFile, tables: tuple[Tables, ...]) -> Rulebook:
    """The rulebook; `tables` has the tables of each variable in order."""
    model = _checked(file)
    sources = {key: source.build(key) for key, source in model.sources.items()}
    variables = _variables(model, file, tables)
    parameters = _parameters(model, file, {name: variable.terms for name, variable in variables.items()})
    reader = _RuleReader(file, sources, variables, parameters)
    rules = tuple(reader.read(number, rule) for number, rule in enumerate(model.rules, 1))
    with file.placing("rules"):
        return Rulebook(
            name=model.name,
            description=model.description,
            variables=_with_named_cultures(variables, rules),
            parameters=parameters,
            rules=rules,
            sources=sources,
            methods=model.methods.build(),
        )


def _variables(model: RulebookModel, file: YamlFile, tables: tuple[Tables, ...]) -> dict[str, Variable]:
    variables: dict[str, Variable] = {}
    for (name, variable), read in zip(model.variables.items(), tables, strict=True):
        with file.placing("variables", name):
            variables[name] = built = variable.build(name, read)
        if isinstance(built, NumericVariable) and read.scores is not None:
            refuse_outside(built, read.scores, file)
    return variables


def _with_named_cultures(variables: dict[str, Variable], rules: tuple[Rule, ...]) -> dict[str, Variable]:
    """The variables; culture variables get the categories that rules name, so that an audit sees them."""
    named = [is_ for rule in rules for is_ in literals(rule.antecedent)]
    return {
        name: variable.naming(is_.term for is_ in named if is_.name == name)
        if isinstance(variable, NominalVariable) and variable.tells_culture
        else variable
        for name, variable in variables.items()
    }


def _parameters(model: RulebookModel, file: YamlFile, inputs: Terms) -> dict[str, Parameter]:
    parameters: dict[str, Parameter] = {}
    for name, parameter in model.parameters.items():
        with file.placing("parameters", name):
            if name in inputs:
                raise WrongValueError(expected="a name that no variable has", got=repr(name))
            if isinstance(parameter, NominalParameterModel):
                parameters[name] = parameter.build(name, _guards(name, parameter, file, inputs))
            else:
                parameters[name] = parameter.build(name)
    return parameters


def _guards(
    name: str, parameter: NominalParameterModel, file: YamlFile, inputs: Terms
) -> dict[str, Condition]:
    guards: dict[str, Condition] = {}
    for category, text in parameter.requires.items():
        location = ("parameters", name, "requires", category)
        _check_known(category, parameter.categories, "a category of this parameter", file, location)
        guards[category] = parse_guard(text, inputs=inputs, place=partial(file.where_in, location, text))
    return guards


@dataclass(frozen=True, slots=True)
class _RuleReader:
    """Reads rules and resolves every name in them."""

    file: YamlFile
    sources: dict[str, Source]
    variables: dict[str, Variable]
    parameters: dict[str, Parameter]

    def read(self, number: int, model: RuleModel) -> Rule:
        location = ("rules", number - 1)
        for i, key in enumerate(model.sources):
            _check_known(key, self.sources, "a key of `sources`", self.file, (*location, "sources", i))
        place = partial(self.file.where_in, (*location, "rule"), model.rule)
        antecedent, consequents = parse_rule(
            model.rule,
            inputs={name: known.terms for name, known in (*self.variables.items(), *self.parameters.items())},
            outputs={name: parameter.conclusions for name, parameter in self.parameters.items()},
            place=place,
        )
        with self.file.placing(*location, "rule"):
            refuse_person_in_shift(antecedent, consequents, self.variables, self.parameters)
        return Rule(
            number=number,
            text=model.rule,
            antecedent=antecedent,
            consequents=consequents,
            sources=tuple(self.sources[key] for key in model.sources),
            evidence=model.evidence,
            counter_evidence=model.counter_evidence or "",
            note=model.note or "",
            weight=model.weight,
            enabled=model.enabled,
            finding=model.finding or "",
        )


def _check_known(name: str, names: Collection[str], what: str, file: YamlFile, location: Location) -> None:
    if name not in names:
        raise unknown_word(what, name, names, where=file.where(location))
