"""A rulebook without the rules that determine one parameter's value: the baseline before learning."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import chain

from comity_fis import InputError, NumericParameter, Rule, Rulebook, Where, closest
from comity_fis.rulebook.selection import selected


@dataclass(frozen=True, slots=True)
class ParameterRules:
    """One parameter, all of the rulebook's variables, and the rules that only shift the value."""

    rulebook: Rulebook
    parameter: NumericParameter

    def value(self, inputs: Mapping[str, object]) -> float:
        """The neutral value, shifted by the situation if the rulebook has such rules."""
        return float(self.rulebook.value(self.parameter.name, inputs))


def basis_of(rulebook: Rulebook, name: str) -> ParameterRules:
    """The basis for learning about a parameter.

    Raises:
        InputError: if the rulebook has no such numeric parameter that rules could conclude.
    """
    parameter = parameter_of(rulebook, name)
    part = replace(selected(rulebook, [name]), variables=rulebook.variables)
    return ParameterRules(with_value_rules(part, name, (), "nothing"), parameter)


def parameter_of(rulebook: Rulebook, name: str) -> NumericParameter:
    """The parameter of that name.

    Raises:
        InputError: if there is no such numeric parameter with terms.
    """
    fitting = {
        key: one
        for key, one in rulebook.parameters.items()
        if isinstance(one, NumericParameter) and len(one.terms) > len(one.empty_terms)
    }
    if name not in fitting:
        raise InputError(
            expected=f"a parameter of the rulebook {rulebook.name} over numbers",
            got=f"{name!r}, which is one over words" if name in rulebook.parameters else repr(name),
            remedy=closest(name, fitting),
            where=Where("--parameter"),
        )
    return fitting[name]


def with_value_rules(rulebook: Rulebook, name: str, rules: Iterable[Rule], learnt_from: str) -> Rulebook:
    """The rulebook with new rules that determine one parameter's value; the previous ones are disabled.

    Args:
        rulebook: Any.
        name: Name of the parameter.
        rules: The new rules; they are numbered by their positions.
        learnt_from: Source of the new rules, stated in the notes of the disabled ones.
    """
    parameter = rulebook.parameters[name]
    assert isinstance(parameter, NumericParameter)
    kept = chain.from_iterable(_kept(rule, name, parameter, learnt_from) for rule in rulebook.rules)
    numbered = tuple(replace(rule, number=i) for i, rule in enumerate(chain(kept, rules), 1))
    sources = {source.key: source for rule in numbered for source in rule.sources}
    return replace(rulebook, rules=numbered, sources={**rulebook.sources, **sources})


def _kept(rule: Rule, name: str, parameter: NumericParameter, learnt_from: str) -> Iterable[Rule]:
    """The rule; if it determines the value, disabled and followed by a copy with its other conclusions.

    A previously learnt rule is dropped: the new rules replace it.
    """
    giving = [is_ for is_ in rule.consequents if is_.name == name and is_.term in parameter.terms]
    if giving and rule.evidence == "learnt":
        return []
    if not giving or not rule.enabled:
        return [rule]
    others = tuple(is_ for is_ in rule.consequents if is_ not in giving)
    note = f"{rule.note}. " if rule.note else ""
    off = replace(rule, enabled=False, note=f"{note}Off: rules learnt from {learnt_from} stand in its place")
    if not others:
        return [off]
    rest = replace(rule, consequents=others)
    return [off, replace(rest, text=str(rest))]
