"""Everything there is to say about one value: what gave it, what holds it in place, what would change it."""

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
    """What one rule that fired did for the value."""

    rule: Rule
    strength: float
    terms: tuple[str, ...]
    """What it gives the parameter."""
    share: float | None
    """Of the aggregated set's area, or of the strengths of all constants, in [0, 1]; None if nominal."""
    contribution: float | None
    """In the parameter's unit; they add up to what the value set out from. None for a nominal parameter."""
    without: Without
    """What would stand if the rulebook did not have this rule."""


@dataclass(frozen=True, slots=True)
class CategoryAccount:
    """One value that a nominal parameter could have."""

    name: str
    desirability: float
    """In [0, 1]; 0 where the category is out."""
    permitted: bool
    requires: Condition | None
    """What must hold before it is permitted."""
    fired: tuple[FiredRule, ...]
    """The rules that speak for it, strongest first, permitted or not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """One value of one person, explained; text, JSON and picture are drawn from it."""

    rulebook: str
    parameter: Parameter
    inputs: Mapping[str, Known | None]
    value: ParameterValue
    leading: tuple[str, ...]
    """The terms that the strongest rules give; none where no rule decided."""
    rules: tuple[RuleAccount, ...]
    """Those that fired, strongest first; none where a setting or the neutral value stands."""
    attribution: Attribution
    """The aggregated set in pieces with their owners; empty where no rule decided, or for categories."""
    categories: tuple[CategoryAccount, ...]
    """Of a nominal parameter that the rules decide, in declared order."""
    variables: tuple[Variable, ...]
    """Those that can change the value, in declared order."""
    reads: tuple[ParameterValue, ...]
    """Other parameters that the rules read, also indirectly."""
    sensitivities: tuple[Sensitivity, ...]
    """By the total value: what the situation adds moves with its own inputs."""
    alternatives: tuple[Counterfactual, ...]
    flips: tuple[Flip, ...]
    """Numbers whose change would make something else lead, smallest change first; for categories see the
    alternatives that flip."""
    off: tuple[Rule, ...]
    """Rules about it that are off, in the rulebook's order: they were not asked."""
    unasked: ParameterValue | None
    """What the rules would have given without the person's setting; None where there is none."""

    @property
    def decided_by_rules(self) -> bool:
        """Whether rules gave what the value set out from, and not a setting or the neutral value."""
        return self.value.decided_by_rules


def explain(
    rulebook: Rulebook,
    inputs: Inputs,
    parameter: str,
    settings: Settings | None = None,
    learnt: Mapping[str, Learnt] | None = None,
) -> Explanation:
    """Explain one parameter of one person, in the exact mode.

    Args:
        rulebook: The rules.
        inputs: What is known of the person, as in `Rulebook.infer`.
        parameter: What to explain.
        settings: What the person asked for.
        learnt: What meetings with the person taught, by numeric parameter.

    Raises:
        InputError: if a name or a value cannot be used, or the rulebook has other methods than Mamdani's and
            Sugeno's: what a rule contributes is defined for cut terms, united by max, and their centre of
            area, and for constants weighted by the strengths of their rules.
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
    """One question."""

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
        """Every category with the rules that speak for it, also those that a requirement keeps out."""
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
    """The parameter's own terms that a rule concludes; not those that only move it."""
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
