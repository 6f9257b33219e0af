"""Several cultures of one person: inference runs for each, and the results are combined by weight.

A number is the weighted mean of the parts' numbers, and its desirability the weighted sum of their curves. A
word is the one with the largest weighted desirability; ties go to the neutral one. That people of several
cultures lie between them is our own choice. No number leaves the range of the parts, nor does the
desirability of any word, so a word that suits both fairly may win over one that suits a single part best.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import fsum, sqrt

from comity_fis.culture.mixed_curve import MixedCurve
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.errors import WrongValueError
from comity_fis.inference.composition import Basis, inferred_word
from comity_fis.inference.known import Known, MixedFact
from comity_fis.inference.value import Contribution, FiredRule, Inference, Origin, ParameterValue, PartValue
from comity_fis.variables.parameter import NominalParameter, Parameter


@dataclass(frozen=True, slots=True)
class Part:
    """One culture of a person, with its inference."""

    name: str
    """Name in the person's words."""
    weight: float
    """Weight, above 0; only proportions count."""
    inference: Inference

    def __post_init__(self) -> None:
        if not 0 < self.weight < float("inf"):
            raise WrongValueError(expected="a weight above 0", got=self.weight)


@dataclass(frozen=True, slots=True)
class _Share:
    """The result of one part for one parameter."""

    name: str
    share: float
    value: ParameterValue


def mixed(parts: Sequence[Part], parameters: Mapping[str, Parameter]) -> Inference:
    """Combine the inferences of several cultures.

    Args:
        parts: At least one, all from the same rulebook and mode.
        parameters: The rulebook's.
    """
    first = parts[0].inference
    total = fsum(part.weight for part in parts)
    shares = [part.weight / total for part in parts]
    return replace(
        first,
        inputs={name: _fact(name, parts, shares) for name in first.inputs},
        parameters={
            name: _combined(
                parameter,
                [_Share(p.name, s, p.inference[name]) for p, s in zip(parts, shares, strict=True)],
            )
            for name, parameter in parameters.items()
        },
        notes=tuple(dict.fromkeys(note for part in parts for note in part.inference.notes)),
        sources=_sources(parts),
    )


def _sources(parts: Sequence[Part]) -> Mapping[str, str]:
    """Sources of every variable over all parts, each once."""
    told: dict[str, dict[str, None]] = {}
    for part in parts:
        for name, source in part.inference.sources.items():
            told.setdefault(name, {})[source] = None
    return {name: "; ".join(sources) for name, sources in told.items()}


def _fact(name: str, parts: Sequence[Part], shares: Sequence[float]) -> Known | None:
    given = [part.inference.inputs[name] for part in parts]
    if all(one == given[0] for one in given):
        return given[0]
    stated = [one for one in given if not isinstance(one, MixedFact)]  # a part has one culture
    return MixedFact(tuple(zip((part.name for part in parts), shares, stated, strict=True)))


def _combined(parameter: Parameter, shares: Sequence[_Share]) -> ParameterValue:
    first = shares[0].value
    if all(one.value == first for one in shares):
        return first
    made = _word(parameter, shares) if isinstance(parameter, NominalParameter) else _number(shares)
    return replace(made, parts=tuple(PartValue(one.name, one.share, one.value.value) for one in shares))


def _number(shares: Sequence[_Share]) -> ParameterValue:
    numbers = [one.value.number for one in shares]
    mean = fsum(one.share * one.value.number for one in shares)
    start, *steps = contributions = _contributions(shares)
    return replace(
        shares[0].value,
        value=min(max(mean, min(numbers)), max(numbers)),  # rounding leaves the range of the parts no more
        spread=_spread(shares, mean),
        origin=next((step.origin for step in reversed(steps) if step.value), start.origin),
        contributions=tuple(contributions),
        desirability=MixedCurve(tuple((one.share, _curve(one.value)) for one in shares)),
        fired=_fired(shares),
        note=_note(shares),
    )


def _word(parameter: NominalParameter, shares: Sequence[_Share]) -> ParameterValue:
    choices = [one.value.desirability for one in shares]
    memberships = [choice.memberships for choice in choices if isinstance(choice, Choice)]
    permitted = [name for name in parameter.terms if all(name in one for one in memberships)]
    desirability = {
        name: fsum(one.share * given[name] for one, given in zip(shares, memberships, strict=True))
        for name in permitted
    }
    origin = _most_telling([one.value.contributions[0].origin for one in shares])
    value = inferred_word(parameter, Basis(origin, _fired(shares), _note(shares)), desirability)
    steps = [(one, one.value.contributions[0]) for one in shares]
    return replace(value, contributions=(Contribution(origin, value.value, _text(steps)),))


def _contributions(shares: Sequence[_Share]) -> list[Contribution]:
    """The combined starting values, then the combined steps by origin; they add up to the mean."""
    starts = [(one, one.value.contributions[0]) for one in shares]
    steps = [(one, step) for one in shares for step in one.value.contributions[1:]]
    by_origin = [
        [(one, step) for one, step in steps if step.origin == origin]
        for origin in dict.fromkeys(step.origin for _, step in steps)
    ]
    return [
        Contribution(
            _most_telling([step.origin for _, step in group]),
            fsum(one.share * float(step.value) for one, step in group),
            _text(group),
        )
        for group in (starts, *by_origin)
    ]


def _text(steps: Sequence[tuple[_Share, Contribution]]) -> str:
    texts = {step.text for _, step in steps}
    if len(texts) == 1 and len({step.value for _, step in steps}) == 1:
        return texts.pop()
    return "; ".join(f"{one.name} ({one.share:.0%}) {_shown(step)}: {step.text}" for one, step in steps)


def _shown(step: Contribution) -> str:
    return step.value if isinstance(step.value, str) else f"{step.value:.3f}"


def _most_telling(origins: Sequence[Origin]) -> Origin:
    order: tuple[Origin, ...] = ("setting", "safety", "learnt", "culture", "situation", "neutral")
    return min(origins, key=order.index)


def _spread(shares: Sequence[_Share], mean: float) -> float | None:
    """Standard deviation in a population mixed in these shares (law of total variance).

    What was learnt with the person concerns the person, not a population: it is kept if the parts agree.
    """
    spreads = [one.value.spread or 0.0 for one in shares]
    learnt = any(step.origin == "learnt" for one in shares for step in one.value.contributions)
    if learnt and all(spread == spreads[0] for spread in spreads):
        return spreads[0]
    within = fsum(one.share * spread**2 for one, spread in zip(shares, spreads, strict=True))
    between = fsum(one.share * (one.value.number - mean) ** 2 for one in shares)
    return sqrt(within + between)


def _fired(shares: Sequence[_Share]) -> tuple[FiredRule, ...]:
    """Every rule that fired for a part, with the weighted mean of its strengths; strongest first."""
    strengths: dict[int, float] = {}
    rules: dict[int, FiredRule] = {}
    for one in shares:
        for firing in one.value.fired:
            number = firing.rule.number
            rules[number] = firing
            strengths[number] = strengths.get(number, 0.0) + one.share * firing.strength
    fired = [firing._replace(strength=min(strengths[number], 1.0)) for number, firing in rules.items()]
    return tuple(sorted(fired, key=lambda firing: (-firing.strength, firing.rule.number)))


def _note(shares: Sequence[_Share]) -> str:
    """What is to be said of all parts, or of some of them; why one is neutral stands in its contribution."""
    notes = [one.value.note for one in shares]
    if all(note == notes[0] for note in notes):
        return notes[0]
    return "; ".join(
        f"{one.name}: {one.value.note}" for one in shares if one.value.note and one.value.origin != "neutral"
    )


def _curve(value: ParameterValue) -> Curve:
    assert not isinstance(value.desirability, Choice)
    return value.desirability
