"""Causes: from the reading that switched a branch back to the culture score behind the parameter.

A chain reads from the near to the far: a fault, where one is behind what was read; what was read; the
condition that it turned, the plan step which that condition serves, the parameter of the step, the strongest
rule behind the parameter (among those that rest on something disclosed, where there are any), and the
variables in the rule, with the source of a score.
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
    """One link of the chain, as traces and answers hold it; `chain` makes them of a node's `Account`."""

    kind: CauseKind
    text: str
    value: float | str | None
    """A reading's or a parameter's number or word, the strength of a rule, what a variable was; else None."""

    @property
    def words(self) -> str:
        """The text, of a rule with its strength."""
        is_rule = self.kind == "rule" and isinstance(self.value, float)
        return f"{self.text} ({self.value:.2f})" if is_rule else self.text


@dataclass(frozen=True, slots=True)
class Account:
    """What a node itself knows about its last result: the near end of the chain, from which `chain` makes it.

    It is no `Cause`, for it gives more than one: the fault, the reading, and the names of parameters of which
    the node knows no rule and no culture score; those come from its `Provenance`.
    """

    text: str
    value: float | None = None
    parameter: str | None = None
    """The parameter of the plan step that the result depends on."""
    others: tuple[str, ...] = ()
    """Further parameters of the person that shaped what was done."""
    fault: str | None = None
    """What is wrong with the robot or around it, where that is behind it."""

    @property
    def words(self) -> str:
        """The text, with the fault behind it."""
        return f"{self.text}: {self.fault}" if self.fault else self.text


@dataclass(frozen=True, slots=True)
class Provenance:
    """What a node stands on: a step of the plan, and the person's parameters."""

    step: PlanStep
    values: Inference


class Explains(Protocol):
    """A node that can account for its results; asked only when a result changes."""

    provenance: Provenance | None

    def account(self) -> Account | None:
        """Why the last result came about; None where there is nothing to add."""
        ...


def explains(node: object) -> TypeGuard[Explains]:
    """Whether a node does; `isinstance` takes its time with protocols."""
    return hasattr(node, "account")


def causes_of(node: Behaviour, condition: str | None = None) -> tuple[Cause, ...]:
    """The causes behind what a node came to last, nearest first, as far as it can account for it.

    Args:
        node: Any; py_trees' own, and those of a user, have a feedback message.
        condition: The node and its result in words, where it is not the node's own result that is explained.
    """
    if explains(node):
        account = node.account()
        return chain(condition, account, node.provenance) if account or condition else ()
    message = "" if node.children else node.feedback_message
    return chain(condition, Account(message) if message else None, None)


def chain(condition: str | None, account: Account | None, provenance: Provenance | None) -> tuple[Cause, ...]:
    """The causes behind one result, nearest first, as far as they are known.

    Args:
        condition: The node and its new result in words, `docked?(johanna) -> failure`; None where it is the
            node's own result that is accounted for.
        account: What that node read.
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
    """The strongest rule behind a number; for a word, the strongest of those that conclude it.

    A rule that rests on something disclosed goes before one that holds only because nothing excludes it.
    Where no rule gave the number, the strongest of those that moved it. Rules that conclude something else at
    the same strength have as much part in a number.
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
