"""Counterfactuals: the value for other inputs, changing one variable at a time.

Covers every other category of a nominal input, both ends of an unknown number, and the nearest change of a
known number that changes the dominant term.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from comity_fis.explanation.attribution import TIE
from comity_fis.inference.value import Inference, ParameterValue
from comity_fis.learning.learnt import Learnt
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.dependencies import Dependencies
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.rule import Is, literals
from comity_fis.variables.parameter import NumericParameter, Parameter
from comity_fis.variables.variable import NominalVariable, NumericVariable

STEPS = 24
"""Number of points searched towards each end of the domain, in addition to every knot of the terms."""

SAME = 1e-9
"""Tolerance for equal values, as a fraction of the parameter's range."""

NEAREST = 1e-10
"""Precision of a search, as a fraction of the variable's range."""


@dataclass(frozen=True, slots=True)
class Counterfactual:
    """The value for one changed or added input of the person."""

    input: str
    given: float | tuple[str, ...]
    """A number, or all categories that give the same value."""
    value: ParameterValue
    leads: tuple[str, ...]
    flips: bool
    """Whether the dominant term changes."""


@dataclass(frozen=True, slots=True)
class Flip:
    """The nearest value of an input at which the dominant term changes."""

    input: str
    now: float
    to: float
    leads: tuple[str, ...]
    """The dominant terms there; empty if no rule fires any more."""
    value: ParameterValue
    """The value there."""
    change: float
    """Change relative to the input's range, in [0, 1]."""


def leading(value: ParameterValue, parameter: Parameter) -> tuple[str, ...]:
    """The dominant terms, concluded by the strongest rules, in declared order; for categories, the value.

    Several terms if they tie; empty if no rule decided.
    """
    if not value.decided_by_rules:
        return ()
    if not isinstance(parameter, NumericParameter):
        return (value.word,)
    strengths = {
        is_.term: firing.strength
        for firing in reversed(value.fired)  # strongest last
        for is_ in firing.rule.consequents
        if is_.name == parameter.name
    }
    most = max(strengths.values())
    return tuple(term for term in parameter.terms if strengths.get(term, -1.0) >= most - TIE)


def flipped(before: tuple[str, ...], after: tuple[str, ...]) -> bool:
    """Whether a dominant term is lost, or one appears where there was none."""
    return not set(before) <= set(after) or (not before and bool(after))


@dataclass(frozen=True, slots=True)
class WhatIf:
    """One parameter of one person, inferred again with one input changed."""

    rulebook: Rulebook
    """The rulebook, reduced to what the parameter depends on."""
    inference: Inference
    settings: Mapping[str, float | str]
    learnt: Mapping[str, Learnt]
    read: Dependencies

    @property
    def parameter(self) -> Parameter:
        """The parameter in question."""
        return self.rulebook.parameters[self.read.parameters[0]]

    @property
    def now(self) -> ParameterValue:
        """The current value."""
        return self.inference[self.parameter.name]

    @property
    def leads(self) -> tuple[str, ...]:
        """The current dominant terms."""
        return leading(self.now, self.parameter)

    def given(self, name: str, value: float | str) -> ParameterValue:
        """The parameter if this input had this value."""
        return self.asked_of(self.rulebook, **{name: value})

    def asked_of(self, rulebook: Rulebook, **changed: float | str) -> ParameterValue:
        """The parameter by another rulebook, or with other inputs."""
        inputs = {**self.inference.inputs, **changed}
        return rulebook.infer(inputs, settings=self.settings, learnt=self.learnt)[self.parameter.name]

    def alternatives(self) -> Iterator[Counterfactual]:
        """Every other category of each nominal input, and both ends of each unknown number."""
        for name in self.read.inputs:
            variable, now = self.rulebook.variables[name], self.inference.inputs[name]
            if isinstance(variable, NominalVariable):
                for categories in self._alike(variable):
                    if now not in categories:
                        yield self._alternative(name, categories[0], categories)
            elif now is None:
                for end in variable.domain.ends:
                    yield self._alternative(name, end, end)

    def flips(self) -> Iterator[Flip]:
        """The nearest flip of each known number that can change the dominant term, smallest change first."""
        found = (self._flip(name) for name in self.read.inputs)
        yield from sorted(filter(None, found), key=lambda flip: flip.change)

    def flat_over(self, name: str) -> Interval | None:
        """The interval around a known number where the parameter is constant, or None."""
        variable, now = self.rulebook.variables[name], self.inference.inputs[name]
        if not isinstance(variable, NumericVariable) or not isinstance(now, int | float):
            return None
        assert isinstance(self.parameter, NumericParameter)
        low, high = self.parameter.rules.ends

        def differs(x: float) -> bool:
            return abs(self.given(name, x).number - self.now.number) > SAME * (high - low)

        down, up = (
            change[0] if (change := _first(differs, now, places, variable.domain)) else places[-1]
            for places in _ways(variable, now)
        )
        return Interval(down, up) if down < up else None

    def _alternative(self, name: str, value: float | str, given: float | tuple[str, ...]) -> Counterfactual:
        answer = self.given(name, value)
        leads = leading(answer, self.parameter)
        return Counterfactual(name, given, answer, leads, flipped(self.leads, leads))

    def _alike(self, variable: NominalVariable) -> list[tuple[str, ...]]:
        """Groups of categories that no rule and no requirement distinguishes."""
        named = dict.fromkeys(is_.term for is_ in _literals(self.rulebook) if is_.name == variable.name)
        groups: dict[tuple[float, ...], list[str]] = {}
        for category in variable.categories:
            groups.setdefault(tuple(variable.terms[term](category) for term in named), []).append(category)
        return [tuple(group) for group in groups.values()]

    def _flip(self, name: str) -> Flip | None:
        variable, now = self.rulebook.variables[name], self.inference.inputs[name]
        if not isinstance(variable, NumericVariable) or not isinstance(now, int | float):
            return None

        def flips(x: float) -> bool:
            return flipped(self.leads, leading(self.given(name, x), self.parameter))

        changes = [_first(flips, now, places, variable.domain) for places in _ways(variable, now)]
        places = [change[1] for change in changes if change is not None]
        if not places:
            return None
        to = min(places, key=lambda x: abs(x - now))
        value = self.given(name, to)
        width = variable.domain.high - variable.domain.low
        return Flip(name, now, to, leading(value, self.parameter), value, abs(to - now) / width)


def what_if(
    rulebook: Rulebook,
    inference: Inference,
    settings: Mapping[str, float | str],
    learnt: Mapping[str, Learnt],
    read: Dependencies,
) -> WhatIf:
    """Set up counterfactuals with a rulebook reduced to what the parameter depends on."""
    kept = set(read.parameters)
    rules = (
        replace(rule, consequents=tuple(is_ for is_ in rule.consequents if is_.name in kept))
        for rule in rulebook.rules
    )
    focused = replace(
        rulebook,
        parameters={name: made for name, made in rulebook.parameters.items() if name in kept},
        rules=tuple(rule for rule in rules if rule.consequents),
    )
    return WhatIf(
        rulebook=focused,
        inference=inference,
        settings={name: wish for name, wish in settings.items() if name in kept},
        learnt={name: known for name, known in learnt.items() if name in kept},
        read=read,
    )


def _literals(rulebook: Rulebook) -> Iterator[Is]:
    guards = (
        category.requires
        for parameter in rulebook.parameters.values()
        for category in getattr(parameter, "categories", ())
        if category.requires is not None
    )
    return chain.from_iterable(
        map(literals, chain((rule.antecedent for rule in rulebook.rules if rule.enabled), guards))
    )


def _ways(variable: NumericVariable, now: float) -> tuple[list[float], list[float]]:
    """Points from the current value down and up to the ends of the domain, nearest first."""
    low, high = variable.domain.ends
    steps = {low + (high - low) * k / STEPS for k in range(STEPS + 1)} | {low, high}
    knots = {x for term in variable.terms.values() for x in term.knots if low < x < high}
    places = sorted(steps | knots | {now})
    at = places.index(now)
    return places[at::-1], places[at:]


def _first(
    differs: Callable[[float], bool], now: float, places: Sequence[float], domain: Interval
) -> tuple[float, float] | None:
    """The last point before the first difference in this direction, and the first point with it."""
    same = now
    for place in places[1:]:
        if differs(place):
            break
        same = place
    else:
        return None
    nearest = NEAREST * (domain.high - domain.low)
    while abs(place - same) > nearest:
        middle = (same + place) / 2
        same, place = (same, middle) if differs(middle) else (middle, place)
    return same, place
