"""Causes: from the reading that switched a branch back to the culture score behind a parameter.

A chain runs from near to far: a fault, if one is behind the reading; the reading; the condition that it
changed; the plan step that the condition serves; the step's parameter; the strongest rule behind the
parameter (preferring rules that rest on disclosed facts); and the variables of the rule, with the source of a
score.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, TypeGuard

from py_trees.behaviour import Behaviour

from comity_domain.plans.plan import PlanStep
from comity_fis.explanation.disclosure import facts_first
from comity_fis.inference.known import Known
from comity_fis.inference.value import FiredRule, Inference, ParameterValue
from comity_fis.record import Record
from comity_fis.rules.rule import Is, Rule

CauseKind = Literal["fault", "reading", "condition", "step", "parameter", "rule", "variable", "source"]


@dataclass(frozen=True, slots=True)
class Cause(Record):
    """One link of the chain, as in traces and answers; `chain` makes them from a node's `Account`."""

    kind: CauseKind
    text: str
    value: float | str | None
    """Value of a reading or parameter (number or word), strength of a rule, or value of a variable; else
    None."""

    @property
    def words(self) -> str:
        """The text; for a rule, with its strength."""
        is_rule = self.kind == "rule" and isinstance(self.value, float)
        return f"{self.text} ({self.value:.2f})" if is_rule else self.text


@dataclass(frozen=True, slots=True)
class Account:
    """A node's own explanation of its last result: the near end of the chain made by `chain`.

    It is not a `Cause`, since it yields several: the fault, the reading, and names of parameters whose rules
    and culture scores the node does not know; those come from its `Provenance`.
    """

    text: str
    value: float | None = None
    parameter: str | None = None
    """The parameter of the plan step that the result depends on."""
    others: tuple[str, ...] = ()
    """Further parameters of the person that shaped what was done."""
    fault: str | None = None
    """The fault of the robot or its surroundings behind the result, if any."""

    @property
    def words(self) -> str:
        """The text, with the fault behind it."""
        return f"{self.text}: {self.fault}" if self.fault else self.text


@dataclass(frozen=True, slots=True)
class Provenance:
    """The origin of a node: a plan step, and the person's parameters."""

    step: PlanStep
    values: Inference


class Explains(Protocol):
    """A node that can explain its results; asked only when a result changes."""

    provenance: Provenance | None

    def account(self) -> Account | None:
        """Explanation of the last result; None if there is nothing to add."""
        ...


def explains(node: object) -> TypeGuard[Explains]:
    """Whether a node implements `Explains`; `isinstance` is slow for protocols."""
    return hasattr(node, "account")


def causes_of(node: Behaviour, condition: str | None = None) -> tuple[Cause, ...]:
    """The causes of a node's last result, nearest first, as far as it can explain it.

    Args:
        node: Any node; those of py_trees or of a user have a feedback message.
        condition: The node and its result in words, if another node's result is explained.
    """
    if explains(node):
        account = node.account()
        return chain(condition, account, node.provenance) if account or condition else ()
    message = "" if node.children else node.feedback_message
    return chain(condition, Account(message) if message else None, None)


def chain(condition: str | None, account: Account | None, provenance: Provenance | None) -> tuple[Cause, ...]:
    """The causes of one result, nearest first, as far as known.

    Args:
        condition: The node and its new result in words, `docked?(johanna) -> failure`; None if the node's own
            result is explained.
        account: The node's explanation.
        provenance: The plan step and the parameters that the node serves.
    """
    causes = [Cause("fault", account.fault, None)] if account and account.fault else []
    if account:
        causes.append(Cause("reading", account.text, account.value))
    if condition is not None:
        causes.append(Cause("condition", condition, None))
    if provenance:
        step = provenance.step
        causes.append(Cause("step", f"{step.action}({', '.join(step.arguments)})", None))
        if account and account.parameter:
            causes += _parameter(account.parameter, provenance)
            causes += [cause for name in account.others for cause in _parameter(name, provenance)]
    return tuple(causes)


def _parameter(name: str, provenance: Provenance) -> list[Cause]:
    inferred = provenance.values.parameters.get(name)
    value = provenance.step.parameters.get(name, inferred.value if inferred else None)
    words = f"{value:.4f}" if isinstance(value, float) else str(value)
    if inferred is None:
        return [Cause("parameter", f"{name} {words}", value)]
    unit = f" {inferred.unit}" if inferred.unit and inferred.unit != "1" else ""
    given = f"{words}{unit} ({inferred.origin})"
    if isinstance(value, str) and value != inferred.value:
        given = f"{value}, planned in the place of {inferred.value} ({inferred.origin})"
    causes = [Cause("parameter", f"{name} {given}", value)]
    for fired in _decisive_rules(inferred, provenance.values):
        causes.append(Cause("rule", fired.rule.text, fired.strength))
        causes += _variables(fired.rule, provenance.values)
    return causes


def _decisive_rules(inferred: ParameterValue, values: Inference) -> list[FiredRule]:
    """The strongest rules behind a number; for a word, the strongest of those that conclude it.

    A rule that rests on a disclosed fact precedes one that fires only because nothing excludes it. If no rule
    gave the number, the strongest of those that changed it count. Rules of the same strength with another
    conclusion contribute equally to a number.
    """
    if inferred.shift and not inferred.fired:
        return [*inferred.shift.fired[:1]]
    concluded = Is(inferred.name, inferred.value) if isinstance(inferred.value, str) else None
    speaking = [fired for fired in inferred.fired if concluded is None or concluded in fired.rule.consequents]
    ranked = facts_first(speaking, values.inputs)
    return [one for one in ranked if one is ranked[0] or _tied(one, ranked[0], inferred.name)]


def _tied(one: FiredRule, first: FiredRule, parameter: str) -> bool:
    """Whether a rule is as strong as the first, and says something else about the parameter."""
    return one.strength == first.strength and _said(one, parameter) != _said(first, parameter)


def _said(fired: FiredRule, parameter: str) -> set[Is]:
    """What a rule concludes about a parameter."""
    return {one for one in fired.rule.consequents if one.name == parameter}


def _variables(rule: Rule, values: Inference) -> list[Cause]:
    causes = []
    for name in (name for name in rule.reads if name in values.inputs):
        causes.append(_variable(name, values.inputs[name]))
        if source := values.sources.get(name):
            causes.append(Cause("source", source, None))
    return causes


def _variable(name: str, value: Known | None) -> Cause:
    if value is None:
        return Cause("variable", f"{name} not disclosed", None)
    if isinstance(value, float | int):
        return Cause("variable", f"{name} {value:g}", value)
    return Cause("variable", f"{name} {value}", str(value))
