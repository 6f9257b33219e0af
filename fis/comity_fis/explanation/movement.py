"""One input moves to one side at one unit per unit of time: how fast does a parameter move?

Forwards, as an inference goes: from the input to the literals about it, to the strengths of rules, to the
heights at which they cut their terms, to the centre of area, to the literals about that parameter, and on.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from operator import itemgetter
from typing import TYPE_CHECKING, cast

from comity_fis.defuzzification.engine import EXACT
from comity_fis.explanation.attribution import NOTHING, Attribution, GivenTerm, divided
from comity_fis.explanation.growth import speed_of_centre
from comity_fis.explanation.moving_degree import MovingDegree, moving_logic
from comity_fis.inference.block import Block, Program
from comity_fis.inference.firing import Fired, fire
from comity_fis.inference.inference import Person, meet, settle
from comity_fis.inference.value import Inference, ParameterValue
from comity_fis.membership.function import Singleton
from comity_fis.membership.slope import slopes
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.situation import told_part
from comity_fis.rules.antecedent import TIE, Antecedent
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

if TYPE_CHECKING:
    from comity_fis.inference.possibility import Stated

Rates = dict[int, float]
"""How fast literals change that do, by number."""

Strongest = tuple[str, float, Antecedent]
"""A term with the weight and the decisive literals of a rule that gives it as strongly as any."""


@dataclass(frozen=True, slots=True)
class Given:
    """A number that rules give: what a parameter sets out from, or what the situation adds to it."""

    block: Block
    strongest: Collection[Strongest]
    """What decides the heights of its terms."""
    attribution: Attribution
    """What these rules give it, divided; nothing where no rule gives it."""


@dataclass(frozen=True, slots=True)
class Standing:
    """How things stand before anything moves."""

    program: Program
    blocks: Sequence[Block]
    """What decides the parameter, behind what decides those that it needs."""
    values: Mapping[str, ParameterValue]
    degrees: Sequence[float]
    """Of all literals."""
    given: Mapping[str, Given]
    """By parameter, what it sets out from."""
    shifts: Mapping[str, Given]
    """By numeric parameter that the situation may move, what it adds."""

    @property
    def attribution(self) -> Attribution:
        """What the rules give the parameter, divided among them."""
        return self.given[self.blocks[-1].parameter.name].attribution


def standing_of(rulebook: Rulebook, inference: Inference, parameter: str) -> Standing:
    """How things stand around one parameter."""
    program = rulebook.program
    stated = cast("Mapping[str, Stated | None]", inference.inputs)  # a mixture is explained part by part
    person = meet(program, rulebook.variables, stated, EXACT)
    blocks, given, shifts = program.up_to(parameter), {}, {}
    for block in blocks:
        name = block.parameter.name
        value = inference[name]
        given[name] = _given(block, person, decided=value.decided_by_rules)
        if name in program.shifts:
            told = told_part(program.shifts[name], person)
            shifts[name] = _given(told, person, decided=value.shift is not None)
        settle(program, person, block.parameter, value)
    return Standing(program, blocks, inference.parameters, person.degrees, given, shifts)


def _given(block: Block, person: Person, *, decided: bool) -> Given:
    fired, made = fire(block, person), block.parameter
    attribution = NOTHING
    if decided and isinstance(made, NumericParameter):
        strongest_first = sorted(fired.clauses, key=itemgetter(1), reverse=True)
        attribution = divided(
            (GivenTerm(clause.rule, clause.term, strength) for clause, strength in strongest_first),
            made,
            person.program.methods,
        )
    return Given(block, _strongest(fired, person.degrees), attribution)


def _strongest(fired: Fired, degrees: Sequence[float]) -> Collection[Strongest]:
    """Of many rules that tie, most often the same few literals are decisive."""
    return dict.fromkeys(
        [
            (clause.term, clause.weight, clause.antecedent.decisive(degrees))
            for clause, strength in fired.clauses
            if strength >= fired.strengths[clause.term] - TIE
        ]
    )


def rates_of(program: Program, variable: NumericVariable, at: float) -> tuple[Rates, Rates]:
    """How fast the literals about an input change while it moves down, and up."""
    down: Rates = {}
    up: Rates = {}
    for number in program.about.get(variable.name, ()):
        _, term, exponent, negated = program.literals[number]
        membership = variable.terms[term]
        below, above = slopes(membership, at)
        if exponent != 1.0:
            below, above = (_hedged(slope, membership(at), exponent) for slope in (below, above))
        if below:
            down[number] = below if negated else -below
        if above:
            up[number] = -above if negated else above
    return down, up


def speed_of(standing: Standing, rates: Rates) -> float:
    """How fast the parameter moves while literals change; infinite where it jumps."""
    speed, rates = 0.0, dict(rates)
    for block in standing.blocks:
        speed = _of_parameter(standing, block, rates) if rates else 0.0
        if speed:
            rates |= _about_parameter(standing, block, speed)
    return speed


def _about_parameter(standing: Standing, block: Block, speed: float) -> Rates:
    parameter, program = block.parameter, standing.program
    assert isinstance(parameter, NumericParameter), "only numbers move"
    value = standing.values[parameter.name].number
    rates: Rates = {}
    for number in program.about.get(parameter.name, ()):
        _, term, exponent, negated = program.literals[number]
        slope = slopes(parameter.terms[term], value)[speed > 0]
        rate = speed * _hedged(slope, parameter.membership(term, value), exponent)
        rates[number] = -rate if negated else rate
    return rates


def _of_parameter(standing: Standing, block: Block, rates: Rates) -> float:
    parameter = block.parameter
    value = standing.values[parameter.name]
    if not isinstance(parameter, NumericParameter) or value.asked_for or _held(value, parameter):
        return 0.0
    speed = _of_given(standing, standing.given[parameter.name], rates)
    if parameter.name in standing.shifts:
        speed += _of_given(standing, standing.shifts[parameter.name], rates)
    return speed


def _held(value: ParameterValue, parameter: NumericParameter) -> bool:
    """Whether a limit holds the value in place."""
    if value.origin == "culture":
        return False  # no limit came after it
    return value.number != value.start.value and value.number in (*parameter.ask.ends, *parameter.safe.ends)


def _of_given(standing: Standing, given: Given, rates: Rates) -> float:
    parameter = given.block.parameter
    assert isinstance(parameter, NumericParameter)
    if standing.program.methods.aggregation == "sum":
        return _of_average(standing, given, parameter, rates)
    if not given.attribution.pieces:
        return inf if _starting(standing, given.block, (), rates) else 0.0
    speeds = _growing(given.strongest, rates)
    speeds |= _starting(standing, given.block, tuple(speeds), rates)
    if not any(speeds.values()):
        return 0.0
    speed = speed_of_centre(given.attribution, speeds, parameter.terms)
    return speed if isfinite(speed) else inf


def _of_average(standing: Standing, given: Given, parameter: NumericParameter, rates: Rates) -> float:
    """How fast a mean of constants moves while their weights, the strengths of rules, change."""
    degrees = [MovingDegree(degree, rates.get(i, 0.0)) for i, degree in enumerate(standing.degrees)]
    logic, attribution, speed = moving_logic(standing.program.methods), given.attribution, 0.0
    for clause in given.block.clauses:
        strength, rate = clause.antecedent.strength(degrees, logic)
        if not rate or (strength <= 0.0 and rate < 0.0):
            continue
        if not attribution.pieces:
            return inf  # the first rule that fires takes the value over
        constant = parameter.conclusions[clause.term]
        assert isinstance(constant, Singleton)
        speed += clause.weight * rate * (constant.place - attribution.centre) / attribution.area
    return speed if isfinite(speed) else inf


def _growing(strongest: Collection[Strongest], rates: Rates) -> dict[str, float]:
    """How fast the terms grow that rules give: of rules that are strongest together, the fastest counts."""
    speeds: dict[str, float] = {}
    for term, weight, decisive in strongest:
        gain = weight * decisive.rate(rates)
        if gain > speeds.get(term, -inf):
            speeds[term] = gain
    return speeds


def _starting(standing: Standing, block: Block, given: Collection[str], rates: Rates) -> dict[str, float]:
    """How fast terms begin to rise at this very place that no rule gives yet."""
    speeds: dict[str, float] = {}
    if any(rate > 0 and standing.degrees[number] == 0.0 for number, rate in rates.items()):
        for clause in block.clauses:
            if clause.term in given:
                continue
            gain = clause.weight * clause.antecedent.decisive(standing.degrees).rate(rates)
            if gain > speeds.get(clause.term, 0.0):
                speeds[clause.term] = gain
    return speeds


def _hedged(slope: float, degree: float, exponent: float) -> float:
    """The slope of a degree to a power, by the chain rule."""
    if exponent == 1.0 or slope == 0.0:
        return slope
    if degree == 0.0:
        return inf if exponent < 1.0 else 0.0
    hedged: float = slope * exponent * degree ** (exponent - 1.0)
    return hedged
