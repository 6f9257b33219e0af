"""The value of one parameter for one person, with its explanation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, NamedTuple

from comity_fis.html_table import html_table
from comity_fis.record import Record, plain

if TYPE_CHECKING:
    from comity_fis.defuzzification.curve import Choice, Curve
    from comity_fis.inference.known import Known
    from comity_fis.rules.rule import Rule
    from comity_fis.variables.measurement import Coercion

Origin = Literal["culture", "situation", "learnt", "setting", "safety", "neutral", "operator"]


@dataclass(frozen=True, slots=True)
class Contribution(Record):
    """One step towards a value; numeric contributions add up to the value."""

    origin: Origin
    value: float | str
    """Value in the parameter's unit: the first contribution is the start, later ones are differences."""
    text: str
    """Why, in one sentence."""


class FiredRule(NamedTuple):
    """A rule and the degree of its antecedent, in (0, 1]."""

    rule: Rule
    strength: float

    def as_json(self) -> dict[str, object]:
        """The firing as a plain dictionary."""
        return {"number": self.rule.number, "rule": self.rule.text, "strength": self.strength}


@dataclass(frozen=True, slots=True)
class PartValue(Record):
    """The result of one of several cultures alone."""

    name: str
    """The culture, in the person's words."""
    share: float
    """Its share, in (0, 1]."""
    value: float | str


@dataclass(frozen=True, slots=True)
class ParameterValue:
    """The value of one parameter for one person, and why."""

    name: str
    value: float | str
    """A number in `unit`, or a category."""
    unit: str | None
    spread: float | None
    """Standard deviation of people around the value, in `unit`; None for a category."""
    origin: Origin
    """Origin: that of the last contribution that changed the value."""
    contributions: tuple[Contribution, ...]
    desirability: Curve | Choice
    fired: tuple[FiredRule, ...]
    """Fired rules, strongest first; empty for a neutral value or a setting."""
    note: str
    """Note for the reader, for example that a neutral value is used and why; may be empty."""
    shift: ParameterValue | None = None
    """The shift by the situation, with its rules; None if there was none."""
    parts: tuple[PartValue, ...] = ()
    """For a person with several cultures: the result of each alone, if different."""
    neutral: float | str | None = None
    """The parameter's declared neutral value, in `unit`, which wins ties; None if unknown."""

    @property
    def start(self) -> Contribution:
        """The start of the value: the rules, the neutral value, or a request."""
        return self.contributions[0]

    @property
    def asked_for(self) -> bool:
        """Whether it starts from a request."""
        return self.start.origin == "setting"

    @property
    def decided_by_rules(self) -> bool:
        """Whether it starts from the rules, not from a setting or the neutral value."""
        return self.start.origin in ("culture", "situation")

    @property
    def number(self) -> float:
        """The value of a numeric parameter."""
        if isinstance(self.value, str):
            raise TypeError(f"{self.name} is nominal: its value is {self.value!r}, not a number")
        return self.value

    @property
    def word(self) -> str:
        """The value of a nominal parameter."""
        if not isinstance(self.value, str):
            raise TypeError(f"{self.name} is numeric: its value is {self.value!r}, not a word")
        return self.value

    def __float__(self) -> float:
        return self.number

    def __repr__(self) -> str:
        return f"<{self.name}: {self._words} ({self.origin})>"

    def _repr_html_(self) -> str:
        rows = ((one.origin, _shown(one.value), one.text) for one in self.contributions)
        return html_table(f"{self.name}: {self._words}", ("from", self.unit or "", "why"), rows)

    @property
    def _words(self) -> str:
        return _shown(self.value, self.unit)

    def as_json(self) -> dict[str, object]:
        """The value as plain dictionaries and lists; `desirability` by category or `curve` by number."""
        memberships = getattr(self.desirability, "memberships", None)
        outline = getattr(self.desirability, "outline", None)
        return {
            "value": self.value,
            "unit": self.unit,
            "spread": self.spread,
            "origin": self.origin,
            "contributions": plain(self.contributions),
            "rules": [fired.as_json() for fired in self.fired],
            "shift": None if self.shift is None else self.shift.as_shift(),
            "note": self.note,
            "parts": plain(self.parts),
            "desirability": plain(memberships),
            "curve": plain(outline),
        }

    def as_shift(self) -> dict[str, object]:
        """A shift by the situation, as plain dictionaries and lists."""
        return {"value": self.value, "rules": [fired.as_json() for fired in self.fired]}


@dataclass(frozen=True, slots=True)
class Inference(Mapping[str, ParameterValue]):
    """One person's parameters, inferred by one rulebook: a mapping from names to values."""

    rulebook: str
    mode: str
    """How the centre of area was computed: exact, matlab or skfuzzy."""
    inputs: Mapping[str, Known | None]
    """Every variable of the rulebook, None if undisclosed, and other facts that were read."""
    parameters: Mapping[str, ParameterValue]
    coercions: Mapping[str, Coercion] = field(default_factory=dict)
    """Coercions of variables used above their level of measurement."""
    notes: tuple[str, ...] = ()
    """Notes on the inputs, for example that a country has no score."""
    sources: Mapping[str, str] = field(default_factory=dict)
    """Sources of values that were not declared directly, with the citation; by variable."""

    def __getitem__(self, parameter: str) -> ParameterValue:
        return self.parameters[parameter]

    def __iter__(self) -> Iterator[str]:
        return iter(self.parameters)

    def __len__(self) -> int:
        return len(self.parameters)

    def __repr__(self) -> str:
        return (
            "\n  ".join((f"<Inference by {self.rulebook} for {self._known}", *map(repr, self.values()))) + ">"
        )

    def _repr_html_(self) -> str:
        rows = ((name, one._words, one.origin, one.start.text) for name, one in self.items())
        return html_table(
            f"{self.rulebook}, for {self._known}", ("parameter", "value", "decided by", "why"), rows
        )

    @property
    def _known(self) -> str:
        """What was disclosed."""
        known = (f"{name} {_shown(value)}" for name, value in self.inputs.items() if value is not None)
        return ", ".join(known) or "a person of whom nothing is known"

    def as_json(self) -> dict[str, object]:
        """The inference as plain dictionaries and lists: `comity infer --json`, without the day."""
        return {
            "rulebook": self.rulebook,
            "mode": self.mode,
            "inputs": {name: fact_as_json(value) for name, value in self.inputs.items()},
            "parameters": {name: value.as_json() for name, value in self.parameters.items()},
            "coercions": {
                name: {"to": str(coercion.to), "reason": coercion.reason}
                for name, coercion in self.coercions.items()
            },
            "notes": list(self.notes),
        }


def _shown(value: Known, unit: str | None = None) -> str:
    """A number to four digits with its unit, anything else in its own words."""
    return f"{value:.4g} {unit or ''}".rstrip() if isinstance(value, float | int) else str(value)


def fact_as_json(value: Known | None) -> object:
    """What is known of a variable, as JSON has it: an interval becomes a list of its two ends."""
    return value if value is None or isinstance(value, float | int | str) else value.as_json()
