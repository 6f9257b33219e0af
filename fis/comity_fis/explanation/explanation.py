"""The full explanation of a value: what determines it, how sensitive it is, and what would change it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace

from comity_fis.errors import InputError, unknown_word
from comity_fis.explanation.attribution import NOTHING, Attribution, Portion, attribute
from comity_fis.explanation.removal import Without, without_each
from comity_fis.explanation.sensitivity import Sensitivity, sensitivities
from comity_fis.explanation.what_if import Counterfactual, Flip, leading, what_if
from comity_fis.inference.known import Known
from comity_fis.inference.value import FiredRule, Inference, ParameterValue
from comity_fis.learning.learnt import Learnt
from comity_fis.rulebook.dependencies import reading
from comity_fis.rulebook.rulebook import Inputs, Rulebook, Settings
from comity_fis.rulebook.sugeno import is_sugeno
from comity_fis.rules.methods import MAMDANI
from comity_fis.rules.rule import Condition, Rule
from comity_fis.variables.parameter import NominalParameter, NumericParameter, Parameter
from comity_fis.variables.variable import Variable


@dataclass(frozen=True, slots=True)
class RuleAccount:
    """The effect of one fired rule on the value."""

    rule: Rule
    strength: float
    terms: tuple[str, ...]
    """The terms that it concludes."""
    share: float | None
    """Share of the aggregated set's area, or of the constants' strengths, in [0, 1]; None if nominal."""
    contribution: float | None
    """Contribution in the parameter's unit; contributions add up to the value before adjustments. None if
    nominal."""
    without: Without
    """The value if the rulebook did not have this rule."""


@dataclass(frozen=True, slots=True)
class CategoryAccount:
    """One category of a nominal parameter."""

    name: str
    desirability: float
    """Desirability in [0, 1]; 0 if the category is excluded."""
    permitted: bool
    requires: Condition | None
    """Condition for permitting the category."""
    fired: tuple[FiredRule, ...]
    """The rules in favour of it, strongest first, whether it is permitted or not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """The explanation of one value of one person, from which text, JSON and pictures are made."""

    rulebook: str
    parameter: Parameter
    inputs: Mapping[str, Known | None]
    value: ParameterValue
    leading: tuple[str, ...]
    """The dominant terms, concluded by the strongest rules; empty if no rule decided."""
    rules: tuple[RuleAccount, ...]
    """The fired rules, strongest first; empty for a setting or the neutral value."""
    attribution: Attribution
    """The aggregated set in pieces with their owners; empty if no rule decided, or for a nominal
    parameter."""
    categories: tuple[CategoryAccount, ...]
    """The categories of a nominal parameter decided by rules, in declared order."""
    variables: tuple[Variable, ...]
    """The variables that can affect the value, in declared order."""
    reads: tuple[ParameterValue, ...]
    """Other parameters that the rules read, also indirectly."""
    sensitivities: tuple[Sensitivity, ...]
    """Sensitivities of the total value, including the situation's shift."""
    alternatives: tuple[Counterfactual, ...]
    flips: tuple[Flip, ...]
    """Numeric inputs whose change would give another dominant term, smallest change first; for nominal ones
    see the alternatives that flip."""
    off: tuple[Rule, ...]
    """Disabled rules about the parameter, in the rulebook's order."""
    unasked: ParameterValue | None
    """The value that the rules would give without the person's setting; None if there is no setting."""

    @property
    def decided_by_rules(self) -> bool:
        """Whether the value before adjustments came from rules, not from a setting or the neutral value."""
        return self.value.decided_by_rules


def explain(
    rulebook: Rulebook,
    inputs: Inputs,
    parameter: str,
    settings: Settings | None = None,
    learnt: Mapping[str, Learnt] | None = None,
) -> Explanation:
    """Explain one parameter of one person, in exact mode.

    Args:
        rulebook: The rulebook.
        inputs: Known values of the person, as in `Rulebook.infer`.
        parameter: Name of the parameter.
        settings: Explicit requests of the person.
        learnt: Corrections learnt from encounters with the person, by numeric parameter.

    Raises:
        InputError: A name or a value is invalid, or the methods are neither Mamdani's nor Sugeno's:
            contributions are defined for clipped terms aggregated by max, with their centroid, and for
            constants weighted by firing strength.
    """
    if rulebook.methods != MAMDANI and not is_sugeno(rulebook):
        raise _methods_error(rulebook)
    if parameter not in rulebook.parameters:
        raise unknown_word(f"a parameter of the rulebook {rulebook.name}", parameter, rulebook.parameters)
    asked, known = dict(settings or {}), dict(learnt or {})
    inference = rulebook.infer(inputs, settings=asked, learnt=known)
    return _Case(rulebook, inference, asked, known, parameter).explanation()


@dataclass(frozen=True, slots=True)
class _Case:
    """One parameter of one person to explain."""

    rulebook: Rulebook
    inference: Inference
    asked: Mapping[str, float | str]
    learnt: Mapping[str, Learnt]
    name: str

    def explanation(self) -> Explanation:
        value, parameter = self.inference[self.name], self.rulebook.parameters[self.name]
        read = reading(self.rulebook, self.inference, self.name)
        question = what_if(self.rulebook, self.inference, self.asked, self.learnt, read)
        attribution = self._attribution(parameter)
        return Explanation(
            rulebook=self.inference.rulebook,
            parameter=parameter,
            inputs=self.inference.inputs,
            value=value,
            leading=leading(value, parameter),
            rules=self._rules(attribution, without_each(question)) if value.decided_by_rules else (),
            attribution=attribution,
            categories=self._categories(),
            variables=tuple(self.rulebook.variables[name] for name in read.inputs),
            reads=tuple(self.inference[name] for name in read.parameters[1:]),
            sensitivities=sensitivities(question),
            alternatives=tuple(question.alternatives()),
            flips=tuple(question.flips()),
            off=self._off(),
            unasked=self._unasked(),
        )

    def _attribution(self, parameter: Parameter) -> Attribution:
        value = self.inference[self.name]
        if not isinstance(parameter, NumericParameter) or not value.decided_by_rules:
            return NOTHING
        return attribute(value.fired, parameter, self.rulebook.methods)

    def _rules(self, attribution: Attribution, without: Mapping[int, Without]) -> tuple[RuleAccount, ...]:
        portions = attribution.portions()
        nothing = Portion(0.0, 0.0) if portions else None
        accounts = []
        for firing in self.inference[self.name].fired:
            portion = portions.get(firing.rule.number, nothing)
            accounts.append(
                RuleAccount(
                    rule=firing.rule,
                    strength=firing.strength,
                    terms=_given(firing.rule, self.rulebook.parameters[self.name]),
                    share=portion and portion.share,
                    contribution=portion and portion.contribution,
                    without=without[firing.rule.number],
                )
            )
        return tuple(accounts)

    def _categories(self) -> tuple[CategoryAccount, ...]:
        """Every category with the rules in favour of it, including categories excluded by a requirement."""
        parameter, value = self.rulebook.parameters[self.name], self.inference[self.name]
        if not isinstance(parameter, NominalParameter) or self.name in self.asked:
            return ()
        memberships: Mapping[str, float] = getattr(value.desirability, "memberships", {})
        fired = self._unguarded(parameter).fired
        return tuple(
            CategoryAccount(
                name=category.name,
                desirability=memberships.get(category.name, 0.0),
                permitted=category.name in memberships,
                requires=category.requires,
                fired=tuple(
                    firing
                    for firing in fired
                    if any(
                        (is_.name, is_.term) == (self.name, category.name) for is_ in firing.rule.consequents
                    )
                ),
            )
            for category in parameter.categories
        )

    def _unguarded(self, parameter: NominalParameter) -> ParameterValue:
        """The parameter as if all its categories were permitted."""
        if all(category.requires is None for category in parameter.categories):
            return self.inference[self.name]
        open_ = replace(
            parameter, categories=tuple(replace(category, requires=None) for category in parameter.categories)
        )
        rulebook = replace(self.rulebook, parameters={**self.rulebook.parameters, self.name: open_})
        return rulebook.infer(self.inference.inputs, settings=self.asked, learnt=self.learnt)[self.name]

    def _off(self) -> tuple[Rule, ...]:
        return tuple(
            rule
            for rule in self.rulebook.rules
            if not rule.enabled and any(is_.name == self.name for is_ in rule.consequents)
        )

    def _unasked(self) -> ParameterValue | None:
        if self.name not in self.asked:
            return None
        rest = {name: wish for name, wish in self.asked.items() if name != self.name}
        return self.rulebook.infer(self.inference.inputs, settings=rest, learnt=self.learnt)[self.name]


def _given(rule: Rule, parameter: Parameter) -> tuple[str, ...]:
    """The parameter's own terms that a rule concludes, without those of its shift."""
    return tuple(
        is_.term for is_ in rule.consequents if is_.name == parameter.name and is_.term in parameter.terms
    )


def _methods_error(rulebook: Rulebook) -> InputError:
    chosen = asdict(rulebook.methods)
    others = [f"{name} {chosen[name]}" for name, usual in asdict(MAMDANI).items() if chosen[name] != usual]
    return InputError(
        expected="a rulebook with the methods min, max, min, max and centroid, or a Sugeno system, "
        "for an explanation",
        got=f"{rulebook.name} with {', '.join(others)}",
        remedy="See the rules that fired with `comity infer`, or leave out the rulebook's `methods`.",
    )
