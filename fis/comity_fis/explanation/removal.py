"""What would stand without each rule, one at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from comity_fis.inference.value import Inference, Origin, ParameterValue
from comity_fis.learning.learnt import Learnt
from comity_fis.rulebook.dependencies import Reading
from comity_fis.rulebook.rulebook import Rulebook, Settings
from comity_fis.rules.rule import Rule


@dataclass(frozen=True, slots=True)
class Without:
    """What would stand if the rulebook did not have a rule."""

    value: float | str
    origin: Origin
    note: str


def without_each(
    rulebook: Rulebook,
    inference: Inference,
    settings: Settings,
    learnt: Mapping[str, Learnt],
    read: Reading,
) -> Mapping[int, Without]:
    """What a parameter would be without each of the rules that fired for it, by their numbers.

    Most rules need no second inference: leaving one out changes something only if it alone is the strongest
    for a term, if it alone reads something that was disclosed, or if it decides a parameter that other rules
    read. So the cost grows with the number of terms, and not with the square of the number of rules.
    """
    name = read.parameters[0]
    value = inference[name]
    needed = _alone_for_a_term(value) | _alone_disclosing(rulebook, value, inference)
    if rulebook.methods.aggregation != "max":
        needed = {firing.rule.number for firing in value.fired}  # every rule adds something
    found = {}
    for firing in value.fired:
        rule = firing.rule
        behind = any(is_.name in read.parameters[1:] for is_ in rule.consequents)
        there = (
            _removed(rulebook, rule, inference, settings, learnt)[name]
            if behind or rule.number in needed
            else value
        )
        found[rule.number] = Without(there.value, there.origin, there.note)
    return found


def _removed(
    rulebook: Rulebook,
    rule: Rule,
    inference: Inference,
    settings: Settings,
    learnt: Mapping[str, Learnt],
) -> Inference:
    rest = tuple(other for other in rulebook.rules if other.number != rule.number)
    return replace(rulebook, rules=rest).infer(inference.inputs, settings=settings, learnt=learnt)


def _alone_for_a_term(value: ParameterValue) -> set[int]:
    """Rules whose term would be cut lower without them."""
    first: dict[str, tuple[float, set[int]]] = {}
    for firing in value.fired:  # strongest first
        for is_ in firing.rule.consequents:
            if is_.name == value.name:
                strength, numbers = first.setdefault(is_.term, (firing.strength, set()))
                if firing.strength == strength:
                    numbers.add(firing.rule.number)
    return {number for _, numbers in first.values() for number in numbers if len(numbers) == 1}


def _alone_disclosing(rulebook: Rulebook, value: ParameterValue, inference: Inference) -> set[int]:
    """The rule without which nothing that was disclosed would be read, or nothing about who the person is."""
    alone: set[int] = set()
    for tells in (_discloses, _discloses_culture):
        telling = [
            firing.rule.number
            for firing in value.fired
            if any(tells(rulebook, inference, name) for name in firing.rule.reads)
        ]
        alone.update(telling if len(telling) == 1 else ())
    return alone


def _discloses(rulebook: Rulebook, inference: Inference, name: str) -> bool:
    if name in rulebook.parameters:
        return inference[name].origin != "neutral"
    return inference.inputs[name] is not None


def _discloses_culture(rulebook: Rulebook, inference: Inference, name: str) -> bool:
    if name in rulebook.parameters:
        return inference[name].start.origin == "culture"
    return inference.inputs[name] is not None and rulebook.variables[name].kind == "culture"
