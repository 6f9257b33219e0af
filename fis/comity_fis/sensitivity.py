"""How a value answers to a small change of one input: exact derivatives, one on each side.

The centre of area is a smooth function of the heights at which rules cut their terms: where the aggregated
set is flat at a rule's strength it rises with it, over the width of that flat stretch; elsewhere nothing
moves. The strengths change with the input by the chain rule through `min`, `max`, complement and membership.
At a corner of any of these the two sides differ.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf, isfinite, isinf
from typing import Any, NamedTuple

from comity_fis.antecedent import Literal, literal_of
from comity_fis.attribution import Attribution, attribute
from comity_fis.interval import Interval
from comity_fis.ownership import Piece
from comity_fis.parameter import NumericParameter
from comity_fis.possibility import Rough
from comity_fis.reading import Reading
from comity_fis.rule import And, Condition, Hedged, Is, Not, Rule
from comity_fis.rulebook import Rulebook
from comity_fis.slope import Side, slope
from comity_fis.value import FiredRule, Inference, ParameterValue
from comity_fis.variable import NumericVariable

TIE = 1e-12
"""Degrees that differ by less are equal: either may decide when the input moves."""

SIDES: tuple[Side, Side] = (-1, 1)

FLAT = 1e-12
"""A derivative below this share of the output's range per range of the input is none."""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """The derivative of a numeric parameter by one numeric input, in the parameter's unit per unit of it."""

    input: str
    at: float
    unit: str | None
    """Of the input."""
    below: float | None
    """Coming from smaller values; infinite where the value jumps; None at the lower end of the domain."""
    above: float | None
    """Coming from larger values; None at the upper end."""
    flat_over: Interval | None = None
    """Around the input's value, where the parameter's value stays as it is; None where it is not flat."""

    @property
    def kink(self) -> bool:
        """Whether the two sides differ."""
        if self.below is None or self.above is None or self.below == self.above:
            return False
        return abs(self.below - self.above) > 1e-9 * (abs(self.below) + abs(self.above))

    @property
    def derivative(self) -> float | None:
        """What both sides agree on, or the only side; None at a kink or a jump."""
        sides = [side for side in (self.below, self.above) if side is not None]
        return None if self.kink or not sides or isinf(sides[0]) else sides[0]

    @property
    def flat(self) -> bool:
        """Whether a small change changes nothing."""
        return self.derivative == 0.0


def sensitivities(
    rulebook: Rulebook, inference: Inference, read: Reading, attribution: Attribution
) -> tuple[Sensitivity, ...]:
    """The derivative of one numeric parameter by each numeric input that was disclosed and that it reads."""
    parameter = read.parameters[0]
    found = []
    for name in read.inputs:
        variable, at = rulebook.variables[name], inference.inputs[name]
        if not isinstance(variable, NumericVariable) or not isinstance(at, int | float):
            continue
        below, above = (
            _Movement(rulebook, inference, read, name, side, {parameter: attribution}).derivative(parameter)
            for side in SIDES
        )
        found.append(
            Sensitivity(
                input=name,
                at=at,
                unit=variable.unit,
                below=None if at <= variable.domain.low else below,
                above=None if at >= variable.domain.high else above,
            )
        )
    return tuple(found)


NOTHING = Attribution((), (), (), 0.0)

Rate = tuple[float, float]
"""A degree, and how fast it changes when the input moves to the chosen side."""


class _Decided(NamedTuple):
    """A number that rules give: what a parameter sets out from, or what the situation adds to it."""

    number: float
    parameter: NumericParameter
    attribution: Attribution
    fired: tuple[FiredRule, ...]
    rules: Sequence[Rule]
    """All that could give it."""


@dataclass(frozen=True, slots=True)
class _Movement:
    """One input, moving to one side at one unit per unit of time: how fast does everything else move?"""

    rulebook: Rulebook
    inference: Inference
    read: Reading
    input: str
    side: Side
    attributions: dict[str, Attribution]
    rates: dict[str, float] = field(default_factory=dict)
    literals: dict[Literal, Rate] = field(default_factory=dict)

    def derivative(self, parameter: str) -> float:
        """The slope on this side, in the parameter's unit per unit of the input."""
        rate = self._rate(parameter) * self.side
        parameter_range, domain = self._ranges(parameter)
        return 0.0 if abs(rate) <= FLAT * parameter_range / domain else rate

    def _ranges(self, parameter: str) -> tuple[float, float]:
        made, variable = self.rulebook.parameters[parameter], self.rulebook.variables[self.input]
        assert isinstance(made, NumericParameter)
        assert isinstance(variable, NumericVariable)
        return made.rules.high - made.rules.low, variable.domain.high - variable.domain.low

    def _rate(self, parameter: str) -> float:
        if parameter not in self.rates:
            self.rates[parameter] = self._found_rate(parameter)
        return self.rates[parameter]

    def _found_rate(self, name: str) -> float:
        value, parameter = self.inference[name], self.rulebook.parameters[name]
        if not isinstance(parameter, NumericParameter) or value.start.origin == "setting":
            return 0.0
        if _held(value, parameter):
            return 0.0
        rate = self._block_rate(self._given(name, value, parameter))
        if name in self.rulebook.program.shifts:
            rate += self._block_rate(self._shift(name, value.shift))
        return rate

    def _given(self, name: str, value: ParameterValue, parameter: NumericParameter) -> _Decided:
        """What the rules give, before anything moves it."""
        if name not in self.attributions:
            self.attributions[name] = attribute(value, parameter)
        start = value.start.value
        assert isinstance(start, float | int)
        return _Decided(start, parameter, self.attributions[name], value.fired, self.rulebook.rules_for(name))

    def _shift(self, name: str, shift: ParameterValue | None) -> _Decided:
        """What the situation adds."""
        block = self.rulebook.program.shifts[name]
        parameter = block.parameter
        assert isinstance(parameter, NumericParameter)
        told = [c.rule for c in block.clauses if any(self.inference.inputs[n] is not None for n in c.reads)]
        if shift is None:
            return _Decided(parameter.neutral, parameter, NOTHING, (), told)
        return _Decided(shift.number, parameter, attribute(shift, parameter), shift.fired, told)

    def _block_rate(self, decided: _Decided) -> float:
        starting = self._starting(decided)
        if not decided.fired or not decided.attribution.rules:
            return inf if starting else 0.0
        area, moment = self._growth(decided.attribution, decided.parameter, starting)
        rate = (moment - decided.number * area) / decided.attribution.area
        return rate if isfinite(rate) else inf

    def _growth(
        self, attribution: Attribution, parameter: NumericParameter, starting: Mapping[str, float]
    ) -> tuple[float, float]:
        """How fast area and moment (about 0) of the aggregated set grow."""
        area = moment = 0.0
        speeds: dict[int, float] = {}
        for piece in attribution.pieces:
            if not piece.flat:
                continue
            for left, right, speed in (
                [(piece.left, piece.right, self._speed(attribution, piece.owners, speeds))]
                if piece.owners
                else _grown(piece, parameter, starting)
            ):
                area += speed * (right - left)
                moment += speed * (right - left) * (left + right) / 2
        return area, moment

    def _speed(self, attribution: Attribution, owners: tuple[int, ...], speeds: dict[int, float]) -> float:
        """Of the owners that share a height, the one that gains most keeps it."""
        for i in owners:
            if i not in speeds:
                speeds[i] = self._gain(attribution.rules[i])
        return max(speeds[i] for i in owners)

    def _starting(self, decided: _Decided) -> Mapping[str, float]:
        """Terms that no rule gives yet and that begin to rise at this very place, with their speed."""
        parameter = decided.parameter
        if not any(self._begins(name) for name in self._moved(parameter.name)):
            return {}
        fired = {firing.rule.number for firing in decided.fired}
        starting: dict[str, float] = {}
        for rule in decided.rules:
            if rule.number not in fired and (speed := self._gain(rule)) > 0:
                for is_ in rule.consequents:
                    if is_.name == parameter.name and is_.term in parameter.terms:
                        starting[is_.term] = max(speed, starting.get(is_.term, 0.0))
        return starting

    def _moved(self, parameter: str) -> list[str]:
        """What moves among the things that a parameter's rules read."""
        return [
            name
            for name in self.read.reads[parameter]
            if name == self.input or (name in self.rulebook.parameters and self._rate(name) != 0.0)
        ]

    def _begins(self, name: str) -> bool:
        """Whether some degree leaves 0, or its complement does."""
        holder = self.rulebook.variables.get(name) or self.rulebook.parameters[name]
        literals = (Literal(name, term) for term in holder.terms)
        return any(degree in (0.0, 1.0) and rate != 0.0 for degree, rate in map(self._literal, literals))

    def _gain(self, rule: Rule) -> float:
        """How fast a rule's strength grows."""
        return rule.weight * self._of(rule.antecedent)[1]

    def _of(self, condition: Condition, *, negated: bool = False) -> Rate:
        """Degree and rate of a condition.

        Of several parts that decide together, `min` follows the slowest and `max` the fastest.
        """
        if isinstance(condition, Is | Hedged):
            return self._literal(literal_of(condition, negated))
        if isinstance(condition, Not):
            return self._of(condition.part, negated=not negated)
        parts = [self._of(part, negated=negated) for part in condition.parts]
        if isinstance(condition, And) is not negated:
            least = min(degree for degree, _ in parts)
            return least, min(rate for degree, rate in parts if degree <= least + TIE)
        most = max(degree for degree, _ in parts)
        return most, max(rate for degree, rate in parts if degree >= most - TIE)

    def _literal(self, literal: Literal) -> Rate:
        if literal not in self.literals:
            self.literals[literal] = self._found_literal(literal)
        return self.literals[literal]

    def _found_literal(self, literal: Literal) -> Rate:
        name, term, exponent, negated = literal
        value = self.inference.inputs.get(name)
        if isinstance(value, Rough):
            membership: Any = self.rulebook.variables[name].terms[term]
            return value.possibility(membership, exponent, negated), 0.0
        if name in self.rulebook.variables and value is None:
            return 1.0, 0.0
        degree, rate = _hedged(*self._plain(name, term), exponent)
        return (1.0 - degree, -rate) if negated else (degree, rate)

    def _plain(self, name: str, term: str) -> Rate:
        """A term by itself, of a value that is known precisely."""
        if name in self.rulebook.parameters:
            return self._of_parameter(name, term)
        variable, value = self.rulebook.variables[name], self.inference.inputs[name]
        if not isinstance(variable, NumericVariable):
            return variable.terms[term](str(value)), 0.0
        assert isinstance(value, int | float)
        membership = variable.terms[term]
        rate = self.side * slope(membership, value, self.side) if name == self.input else 0.0
        return membership(value), rate

    def _of_parameter(self, name: str, term: str) -> Rate:
        parameter, value = self.rulebook.parameters[name], self.inference[name]
        degree, rate = parameter.membership(term, value.value), self._rate(name)
        if rate == 0.0 or not isinstance(parameter, NumericParameter):
            return degree, 0.0
        return degree, rate * slope(parameter.terms[term], value.number, 1 if rate > 0 else -1)


def _held(value: ParameterValue, parameter: NumericParameter) -> bool:
    """Whether a limit holds the value in place."""
    return value.number != value.start.value and value.number in (*parameter.ask.ends, *parameter.safe.ends)


def _hedged(degree: float, rate: float, exponent: float) -> Rate:
    """A degree to a power, and its rate by the chain rule."""
    if exponent == 1.0 or rate == 0.0:
        return degree**exponent, rate
    if degree == 0.0:
        return 0.0, inf if exponent < 1.0 else 0.0
    return degree**exponent, exponent * degree ** (exponent - 1.0) * rate


def _grown(
    empty: Piece, parameter: NumericParameter, starting: Mapping[str, float]
) -> Sequence[tuple[float, float, float]]:
    """Where terms that begin to rise fill an empty stretch, and how fast."""
    if not starting:
        return ()
    knots = {x for term in starting for x in parameter.terms[term].knots if empty.left < x < empty.right}
    grown = []
    for left, right in pairwise((empty.left, *sorted(knots), empty.right)):
        middle = (left + right) / 2
        speeds = [speed for term, speed in starting.items() if parameter.terms[term](middle) > 0]
        if speeds:
            grown.append((left, right, max(speeds)))
    return grown
