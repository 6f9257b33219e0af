"""Explains a step of a custom domain: whose preference, which rules, and the alternatives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from comity_domain.custom.binding.binding import ActionBinding
from comity_domain.custom.costs.preference import Preference
from comity_domain.custom.solving.bound import Bound
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import argument_of, other_ways, row_of, tries
from comity_domain.explanation.evidence import concludes, words
from comity_domain.plans.plan import Alternative, StepExplanation
from comity_domain.problem.setting import is_setting
from comity_fis.explanation.disclosure import facts_first, kept_back
from comity_fis.inference.value import Inference, ParameterValue
from comity_fis.listing import listed


def why(index: int, actions: Sequence[GroundAction], binding: ActionBinding, bound: Bound) -> StepExplanation:
    """The explanation of one step of a plan."""
    assert bound.people is not None
    action = actions[index]
    name = argument_of(action, binding.person.lower(), bound)
    person = bound.people[bound.own.as_written(name)]
    row = row_of(action, bound) if bound.classical else None
    reasons = [
        _option(
            bound.own.as_written(argument_of(action, argument.lower(), bound)),
            option.parameter,
            preference,
            person,
        )
        for argument, option in binding.options.items()
        if row and (preference := row.preferences[argument.lower()])
    ]
    reasons += [_value(person[parameter], person) for parameter in binding.parameters]
    whose = f"{bound.own.as_written(name)}: " if reasons else ""
    chosen = whose + "; ".join(reasons)
    if not row or not binding.options:
        return StepExplanation(chosen, (), chosen=chosen)
    others = list(_others(index, actions, binding, bound))
    if not others and not tries(actions, bound):
        return StepExplanation(
            f"{chosen}; no other option was tried: the plan is too large", (), chosen=chosen
        )
    text = f"{chosen}; {_runner_up(others, binding, action, bound)}"
    return StepExplanation(text, tuple(others), chosen=chosen)


def _others(
    index: int, actions: Sequence[GroundAction], binding: ActionBinding, bound: Bound
) -> Iterator[Alternative]:
    options = [argument.lower() for argument in binding.options]
    for other, extra in other_ways(index, actions, options, bound):
        yield Alternative(tuple(map(bound.own.as_written, other.arguments)), extra, "")


def _option(name: str, parameter: str, preference: Preference, person: Inference) -> str:
    if preference.value is None:
        return f"{name}: nothing to like or dislike"
    category = preference.value if isinstance(preference.value, str) else None
    because = _because(person[parameter], person, category)
    return f"{name}: desirability {preference.desirability:.2f} as {words(parameter)} ({because})"


def _value(value: ParameterValue, person: Inference) -> str:
    shown = value.value if isinstance(value.value, str) else f"{value.value:.3f} {value.unit or ''}".strip()
    return f"{words(value.name)} {words(shown)} ({_because(value, person, None)})"


def _because(value: ParameterValue, person: Inference, category: str | None) -> str:
    """The strongest rule behind a value; for a category, the strongest rule in its favour."""
    if is_setting(value):
        return "asked for"
    speaking = [fired for fired in value.fired if concludes(fired, value.name, category)]
    if not value.fired or (category and not speaking):
        return "no rule speaks for it" if value.fired else value.note or f"{value.origin} value"
    rule = facts_first(speaking or value.fired, person.inputs)[0].rule
    hidden = listed(map(words, kept_back(rule, person.inputs)))
    return f"rule {rule.number}: {words(rule.text)}" + (f"; {hidden} not disclosed" if hidden else "")


def _runner_up(
    others: Sequence[Alternative], binding: ActionBinding, action: GroundAction, bound: Bound
) -> str:
    if not others:
        return "no other option keeps the plan working"
    names = [parameter.name for parameter in bound.problem.action(action.name).parameters]
    places = [names.index(argument.lower()) for argument in binding.options]
    first = others[0]
    name = " with ".join(first.arguments[place] for place in places)
    price = f"{first.extra_cost} more" if first.extra_cost else "the same"
    return f"{name} would cost {price} with the rest as it is"
