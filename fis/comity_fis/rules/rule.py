"""Rules as data: a condition on variables, its conclusions, and the evidence."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

from comity_fis.errors import WrongValueError
from comity_fis.rules.hedge import HEDGES

Evidence = Literal["strong", "moderate", "weak", "contested", "norm", "design", "learnt"]
"""Evidence for a rule. `norm`: it states what should be, which no study decides; `design`: none, it is our
choice; `learnt`: a table of examples."""

KEYWORDS = frozenset({"if", "then", "and", "or", "not", "is"})
RESERVED = KEYWORDS | HEDGES.keys() | {"more"}
"""Words that must be quoted as names; `more` because of `more or less`."""
PLAIN_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*")


@dataclass(frozen=True, slots=True)
class Is:
    """`individualism is LC1`: a variable or parameter belongs to one of its terms."""

    name: str
    term: str

    def __str__(self) -> str:
        return _statement(self, "is")


@dataclass(frozen=True, slots=True)
class Hedged:
    """`individualism is very LC1`: a term with a hedge."""

    hedge: str
    """One of `HEDGES`."""
    part: Is

    def __str__(self) -> str:
        return _statement(self, "is")


@dataclass(frozen=True, slots=True)
class Not:
    """`gender is not female`, or `not (...)`."""

    part: Condition

    def __str__(self) -> str:
        if isinstance(self.part, Is | Hedged):
            return _statement(self.part, "is not")
        return f"not ({self.part})"


@dataclass(frozen=True, slots=True)
class And:
    """Conjunction: the smallest degree counts."""

    parts: tuple[Condition, ...]

    def __str__(self) -> str:
        return " and ".join(_bracketed(part, (And, Or)) for part in self.parts)


@dataclass(frozen=True, slots=True)
class Or:
    """Disjunction: the largest degree counts."""

    parts: tuple[Condition, ...]

    def __str__(self) -> str:
        return " or ".join(_bracketed(part, (Or,)) for part in self.parts)


Condition = Is | Hedged | Not | And | Or


@dataclass(frozen=True, slots=True)
class Source:
    """A publication or a decision that a rule is based on."""

    key: str
    citation: str
    verified: str
    """What of it was read, and how."""
    found: str = ""
    """The finding, in a sentence."""
    measured: str = ""
    """How it was measured, and with which participants."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """`if individualism is LC1 then conversational_distance is close`, with its evidence."""

    number: int
    """Number in the rulebook's order, from 1."""
    text: str
    """The text as its author wrote it."""
    antecedent: Condition
    consequents: tuple[Is, ...]
    """Conclusions about one or several parameters."""
    sources: tuple[Source, ...]
    evidence: Evidence
    counter_evidence: str = ""
    note: str = ""
    """Which part is our own inference."""
    weight: float = 1.0
    """Factor on the firing strength, in (0, 1]."""
    enabled: bool = True
    """Whether the rule is enabled; a disabled rule is documented but has no effect."""
    finding: str = ""
    """Key of the finding that the rule states, in a table of evidence; several rules may share one."""
    reads: tuple[str, ...] = field(init=False, repr=False, compare=False)
    """The variables and parameters in the antecedent, without duplicates, in the order of the text."""

    def __post_init__(self) -> None:
        if not 0 < self.weight <= 1:
            raise WrongValueError(expected="a weight above 0 and at most 1", got=self.weight)
        read = dict.fromkeys(literal.name for literal in literals(self.antecedent))
        object.__setattr__(self, "reads", tuple(read))  # computed once because it is used often

    def __str__(self) -> str:
        return f"if {self.antecedent} then {' and '.join(map(str, self.consequents))}"

    @property
    def source(self) -> str:
        """All citations in one line."""
        return "; ".join(source.citation for source in self.sources)


def literals(condition: Condition) -> Iterator[Is]:
    """Every `name is term` of a condition, in the order of its text."""
    match condition:
        case Is():
            yield condition
        case Hedged(_, part):
            yield part
        case Not(part):
            yield from literals(part)
        case And(parts) | Or(parts):
            for part in parts:
                yield from literals(part)


def quoted(name: str) -> str:
    """A name as written in rules: bare if possible, otherwise in single quotes."""
    return name if PLAIN_NAME.fullmatch(name) and name.lower() not in RESERVED else f"'{name}'"


def _statement(said: Is | Hedged, verb: str) -> str:
    if isinstance(said, Hedged):
        return f"{quoted(said.part.name)} {verb} {said.hedge} {quoted(said.part.term)}"
    return f"{quoted(said.name)} {verb} {quoted(said.term)}"


def _bracketed(part: Condition, loose: tuple[type, ...]) -> str:
    return f"({part})" if isinstance(part, loose) else str(part)
