"""The final value, composed of the rules' result or the person's request.

`value = safety(setting, or culture + situation + learnt)`; every value keeps its contributions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.inference.value import Contribution, FiredRule, Origin, ParameterValue
from comity_fis.membership.function import Trapezoid, everywhere
from comity_fis.membership.interval import Interval
from comity_fis.variables.parameter import NominalParameter, NumericParameter

TIE = 1e-12
"""Desirabilities that differ by less than this are equal."""


@dataclass(frozen=True, slots=True)
class Basis:
    """The origin of a value, with a note."""

    origin: Origin
    """`culture` or `situation`; `neutral` if no rule applies; `setting` if the rules were not evaluated."""
    fired: tuple[FiredRule, ...]
    note: str = ""
    """Why the neutral value is used, or what was left out."""

    @property
    def text(self) -> str:
        """One sentence for a contribution."""
        if self.origin == "neutral":
            return f"neutral value: {self.note}"
        if self.origin == "setting":
            return "asked for by the person, replaces the rules"
        rules = ", ".join(str(fired.rule.number) for fired in self.fired)
        return f"from rule {rules}" if len(self.fired) == 1 else f"from rules {rules}"


def inferred_number(parameter: NumericParameter, basis: Basis, curve: Curve, centre: float) -> ParameterValue:
    """The rules' result as one number; it lies in the safe range, which contains the rules' range."""
    return ParameterValue(
        name=parameter.name,
        neutral=parameter.neutral,
        value=centre,
        unit=parameter.unit,
        spread=parameter.spread,
        origin=basis.origin,
        contributions=(Contribution(basis.origin, centre, basis.text),),
        desirability=curve,
        fired=basis.fired,
        note=basis.note,
    )


def neutral_number(parameter: NumericParameter, basis: Basis) -> ParameterValue:
    """The neutral value; every value of the rules' range is equally suitable."""
    curve = OutputSet(parameter.rules, (Layer(everywhere(parameter.rules), 1.0),))
    return inferred_number(parameter, basis, curve, parameter.neutral)


def asked_number(parameter: NumericParameter, asked: float) -> ParameterValue:
    """The requested value, limited only by safety.

    Desirability falls to 0 at twice the spread on both sides (our choice), so that if the place is occupied
    the robot stays as near to the wish as it can.
    """
    safe = parameter.safe
    value = safe.clamp(asked)
    contributions = [Contribution("setting", asked, Basis("setting", ()).text)]
    if value != asked:
        limit = f"at least {safe.low:g}" if value > asked else f"at most {safe.high:g}"
        contributions.append(Contribution("safety", value - asked, f"safety allows {limit} {parameter.unit}"))
    reach = 2 * parameter.spread
    return ParameterValue(
        name=parameter.name,
        neutral=parameter.neutral,
        value=value,
        unit=parameter.unit,
        spread=0.0,
        origin=contributions[-1].origin,
        contributions=tuple(contributions),
        desirability=OutputSet(
            Interval(safe.clamp(parameter.ask.low), safe.clamp(parameter.ask.high)),
            (Layer(Trapezoid(value - reach, value, value, value + reach), 1.0),),
        ),
        fired=(),
        note=contributions[-1].text if value != asked else "",
    )


def inferred_word(
    parameter: NominalParameter, basis: Basis, desirability: Mapping[str, float]
) -> ParameterValue:
    """The most desirable permitted category.

    If the neutral category wins a tie that it is not part of, the rules have left the question open: it then
    gets the tied desirability, so that choosing by desirability gives the same result.
    """
    best = max(desirability.values())
    tied = [category for category, degree in desirability.items() if best - degree < TIE]
    value = tied[0] if len(tied) == 1 else parameter.neutral
    notes = [basis.note] if basis.note else []
    if len(tied) > 1 and basis.origin != "neutral":
        notes.append(f"{', '.join(tied)} are equally desirable; {value}, the neutral value, stands")
        desirability = {**desirability, value: best}
    return ParameterValue(
        name=parameter.name,
        neutral=parameter.neutral,
        value=value,
        unit=None,
        spread=None,
        origin=basis.origin,
        contributions=(Contribution(basis.origin, value, basis.text),),
        desirability=Choice(desirability),
        fired=basis.fired,
        note="; ".join(notes),
    )


def neutral_word(parameter: NominalParameter, basis: Basis, permitted: tuple[str, ...]) -> ParameterValue:
    """The neutral category; all permitted ones are equally suitable."""
    return inferred_word(parameter, basis, dict.fromkeys(permitted, 1.0))


def asked_word(parameter: NominalParameter, asked: str) -> ParameterValue:
    """The requested category, the only one that remains."""
    return inferred_word(parameter, Basis("setting", ()), {asked: 1.0})
