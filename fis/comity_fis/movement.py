"""One input moves to one side at one unit per unit of time: how fast does a parameter move?

Forwards, as an inference goes: from the input to the literals about it, to the strengths of rules, to the
heights at which they cut their terms, to the centre of area, to the literals about that parameter, and on.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from operator import itemgetter

from comity_fis.antecedent import TIE, Antecedent, Single
from comity_fis.attribution import NOTHING, Attribution, divided
from comity_fis.block import Block, Program
from comity_fis.closed_form import ClosedForm
from comity_fis.engine import EXACT
from comity_fis.firing import Fired, fire
from comity_fis.growth import Leverage, leverage
from comity_fis.inference import meet, settle
from comity_fis.parameter import NumericParameter
from comity_fis.rulebook import Rulebook
from comity_fis.slope import slopes
from comity_fis.value import Inference, ParameterValue
from comity_fis.variable import NumericVariable

Rates = dict[int, float]
"""How fast literals change that do, by number."""

Strongest = tuple[str, float, Antecedent]
"""A term with the weight and the decisive literals of a rule that gives it as strongly as any."""


@dataclass(frozen=True, slots=True)
class Standing:
    """How things stand before anything moves."""

    program: Program
    blocks: Sequence[Block]
    """What decides the parameter, behind what decides those that it needs."""
    values: Mapping[str, ParameterValue]
    degrees: Sequence[float]
    """Of all literals."""
    strongest: Mapping[str, Collection[Strongest]]
    """By parameter, what decides the heights of its terms."""
    leverages: Mapping[str, Leverage]
    """By numeric parameter that rules decide, what these heights do to it."""
    is_smooth: bool
    """Whether the parameter moves forth as fast as back where all literals do that hold at all."""

    @property
    def attribution(self) -> Attribution:
        """What the rules give the parameter, divided among them."""
        name = self.blocks[-1].parameter.name
        return self.leverages[name].attribution if name in self.leverages else NOTHING


def standing_of(rulebook: Rulebook, inference: Inference, parameter: str) -> Standing:
    """How things stand around one parameter."""
    program = rulebook.program
    person = meet(program, rulebook.variables, inference.inputs, EXACT)
    blocks, strongest, leverages = program.up_to(parameter), {}, {}
    for block in blocks:
        made, value = block.parameter, inference[block.parameter.name]
        fired = fire(block, person)
        strongest[made.name] = _strongest(fired, person.degrees)
        if isinstance(made, NumericParameter) and value.origin in ("culture", "situation"):
            leverages[made.name] = leverage(_attribution(made, fired, block.form))
        settle(program, person, made, value)
    is_smooth = len(blocks) == 1 and _is_smooth(strongest[parameter], leverages.get(parameter))
    return Standing(program, blocks, inference.parameters, person.degrees, strongest, leverages, is_smooth)


def _attribution(parameter: NumericParameter, fired: Fired, form: ClosedForm | None) -> Attribution:
    strongest_first = sorted(fired.clauses, key=itemgetter(1), reverse=True)
    return divided(
        [(clause.rule, clause.term, strength) for clause, strength in strongest_first], parameter, form
    )


def _strongest(fired: Fired, degrees: Sequence[float]) -> Collection[Strongest]:
    """Of many rules that tie, most often the same few literals are decisive."""
    return dict.fromkeys(
        [
            (clause.term, clause.weight, clause.antecedent.decisive(degrees))
            for clause, strength in fired.clauses
            if strength >= fired.strengths[clause.term] - TIE
        ]
    )


def _is_smooth(strongest: Collection[Strongest], leverage: Leverage | None) -> bool:
    """Whether one literal alone decides each height, and each height is one term's."""
    terms = [term for term, _, decisive in strongest if isinstance(decisive, Single)]
    levers = leverage.levers if leverage else ()
    return len(set(terms)) == len(strongest) and all(len(names) == 1 for names, _ in levers)


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
    if not isinstance(parameter, NumericParameter) or value.origin in ("setting", "safety"):
        return 0.0
    if value.origin == "neutral":
        return inf if _starting(standing, block, (), rates) else 0.0
    speeds = _growing(standing.strongest[parameter.name], rates)
    speeds |= _starting(standing, block, tuple(speeds), rates)
    if not any(speeds.values()):
        return 0.0
    speed = standing.leverages[parameter.name].speed(speeds, parameter.terms)
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
