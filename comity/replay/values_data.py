"""The values behind the robot's behaviour: parameters, fired rules, inputs and membership functions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.values.inference import outvoted_text
from comity_executor import DEFAULT_LIMITS
from comity_fis import NominalVariable, NumericParameter, NumericVariable
from comity_fis.inference.value import fact_as_json

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from comity_fis import FiredRule, Inference, Known, Parameter, ParameterValue, Rule, Rulebook, Variable

_SAMPLES = 48
"""Number of line segments of a curved membership function; none is longer than 3 pixels on the page."""


def values_data(rulebook: Rulebook, stages: Sequence[Mapping[str, Inference]]) -> dict[str, object]:
    """Values by person, and the parameters, rules and variables needed to explain them.

    Args:
        rulebook: The rules.
        stages: By plan, the people whose values are new with it.
    """
    inferences = [inference for stage in stages for inference in stage.values()]
    shown = [value for inference in inferences for value in inference.parameters.values()]
    rules = {fired.rule.number: fired.rule for value in shown for fired in _fired(value)}
    read = {name for rule in rules.values() for name in rule.reads}
    return {
        "people": [{name: _person(inference, read) for name, inference in stage.items()} for stage in stages],
        "parameters": {name: _parameter(one) for name, one in rulebook.parameters.items()},
        "rules": {str(number): _rule(rules[number]) for number in sorted(rules)},
        "variables": {name: _variable(one) for name, one in rulebook.variables.items() if name in read},
    }


def _fired(value: ParameterValue) -> Iterator[FiredRule]:
    yield from value.fired
    yield from value.shift.fired if value.shift else ()


def _person(inference: Inference, read: Iterable[str]) -> dict[str, object]:
    wanted = set(read)
    return {
        "notes": inference.notes,
        "band": _band(inference["conversational_distance"].number),
        "inputs": {name: fact_as_json(known) for name, known in inference.inputs.items() if name in wanted},
        "parameters": {name: _value(value, inference.inputs) for name, value in inference.parameters.items()},
    }


def _band(wanted_m: float) -> list[float]:
    """Distance range in which a greeting continues [m]."""
    limits = DEFAULT_LIMITS
    return [max(limits.safety_floor_m, wanted_m - limits.leave_closer_m), wanted_m + limits.leave_farther_m]


def _value(value: ParameterValue, inputs: Mapping[str, Known | None]) -> dict[str, object]:
    answer = value.as_json()
    fired = [[fired.rule.number, round(fired.strength, 4)] for fired in value.fired]
    moved = (
        [[fired.rule.number, round(fired.strength, 4)] for fired in value.shift.fired] if value.shift else []
    )
    outline = getattr(value.desirability, "outline", None)
    return {
        **{
            key: answer[key]
            for key in ("value", "unit", "spread", "origin", "contributions", "note", "parts")
        },
        "outvoted": outvoted_text(value, inputs),
        "fired": fired,
        "moved": moved,
        "desirability": answer["desirability"],
        "curve": None if outline is None else _points(outline),
    }


def _parameter(parameter: Parameter) -> dict[str, object]:
    if isinstance(parameter, NumericParameter):
        low, high = parameter.rules.ends
        terms = {name: _outline(term, term.knots, low, high) for name, term in parameter.terms.items()}
        return {"unit": parameter.unit, "domain": [low, high], "terms": terms}
    return {"unit": None, "domain": None, "terms": dict.fromkeys(parameter.terms)}


def _rule(rule: Rule) -> dict[str, object]:
    return {
        "text": rule.text,
        "gives": [[is_.name, is_.term] for is_ in rule.consequents],
        "reads": rule.reads,
        "evidence": rule.evidence,
        "source": rule.source,
        "against": rule.counter_evidence or None,
        "note": rule.note or None,
    }


def _variable(variable: Variable) -> dict[str, object]:
    about = {
        "kind": variable.kind,
        "level": variable.measured,
        "unit": variable.unit,
        "reason": variable.reason,
    }
    if isinstance(variable, NumericVariable):
        low, high = variable.domain.ends
        terms = {name: _outline(term, term.knots, low, high) for name, term in variable.terms.items()}
        return {**about, "domain": [low, high], "terms": terms, "categories": None}
    categories = variable.categories if isinstance(variable, NominalVariable) else tuple(variable.terms)
    return {**about, "domain": None, "terms": None, "categories": categories}


def _outline(
    degree: Callable[[float], float], knots: tuple[float, ...], low: float, high: float
) -> list[list[float]]:
    """Vertices of a polyline for a membership function; its exact corners if it is piecewise linear."""
    corners = {x for x in knots if low <= x <= high} | {low, high}
    if len(knots) != 4:
        corners |= {low + (high - low) * k / _SAMPLES for k in range(_SAMPLES + 1)}
    return _points((x, degree(x)) for x in sorted(corners))


def _points(points: Iterable[tuple[float, float]]) -> list[list[float]]:
    return [[round(x, 4), round(y, 4)] for x, y in points]
