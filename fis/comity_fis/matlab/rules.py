"""A rulebook's rules as rows of a `.fis` file: `and` or `or` over single terms, each variable once in a row.

A rule that mixes both becomes several rows with the same meaning. This is valid only for min, max and
aggregation by max, which are distributive.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from comity_fis.errors import InputError
from comity_fis.rules.methods import DUAL, Methods
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not, Or, Rule

MAX_ROWS = 200
"""Maximum number of rows for one rule."""

Indexes = Mapping[str, Mapping[str, int]]
"""Term indexes of every input or output."""

Literal = tuple[str, int]
"""A variable's name and the index of a term, negative for `not`."""


@dataclass(frozen=True, slots=True)
class MatlabRule:
    """One line of `[Rules]`."""

    reads: Mapping[str, int]
    concludes: Mapping[str, int]
    weight: float
    either: bool
    """Whether the connective is `or`."""


def rows_of(rule: Rule, inputs: Indexes, outputs: Indexes, methods: Methods) -> tuple[MatlabRule, ...]:
    """The rows that are equivalent to a rule.

    Raises:
        InputError: No such rows exist.
    """
    condition = _inward(rule.antecedent, rule, methods, negated=False)
    conclusions = list(_conclusions(rule, outputs))
    flat = _flat(condition, rule, inputs)
    antecedents = (
        [flat] if flat else [(reads, False) for reads in _alternatives(condition, rule, inputs, methods)]
    )
    if len(antecedents) * len(conclusions) > MAX_ROWS:
        raise _refusal(rule, f"a rule of at most {MAX_ROWS} rows", f"{len(antecedents)}", "Split the rule.")
    return tuple(
        MatlabRule(reads, concludes, rule.weight, either)
        for reads, either in antecedents
        for concludes in conclusions
    )


def _inward(condition: Condition, rule: Rule, methods: Methods, *, negated: bool) -> Condition:
    """Push `not` down to the single terms by De Morgan's laws."""
    if isinstance(condition, Is):
        return Not(condition) if negated else condition
    if isinstance(condition, Not):
        return _inward(condition.part, rule, methods, negated=not negated)
    if isinstance(condition, Hedged):
        raise _hedged(rule, condition)
    parts = tuple(_inward(part, rule, methods, negated=negated) for part in condition.parts)
    if not negated:
        return type(condition)(parts)
    if DUAL[methods.conjunction] != methods.disjunction:
        raise _refusal(
            rule,
            "`not` in front of single terms",
            f"`not` in front of brackets, with {methods.conjunction} and {methods.disjunction}",
            "Write the rule without it.",
        )
    return Or(parts) if isinstance(condition, And) else And(parts)


def _flat(condition: Condition, rule: Rule, inputs: Indexes) -> tuple[dict[str, int], bool] | None:
    """A condition that fits one row unchanged, and whether it is an `or`; None for any other."""
    parts = condition.parts if isinstance(condition, And | Or) else (condition,)
    literals = [_literal(part, rule, inputs) for part in parts if isinstance(part, Is | Not)]
    if len(literals) < len(parts) or len({name for name, _ in literals}) < len(literals):
        return None
    return dict(literals), isinstance(condition, Or)


def _alternatives(
    condition: Condition, rule: Rule, inputs: Indexes, methods: Methods
) -> Iterator[dict[str, int]]:
    """The condition in disjunctive normal form: alternatives, each an `and` of single terms."""
    if (methods.conjunction, methods.disjunction, methods.aggregation) != ("min", "max", "max"):
        raise _refusal(
            rule,
            "`and` or `or` over different variables, not both",
            f"`{rule.antecedent}`",
            "Split the rule: only with min, max and aggregation by max several rows mean the same.",
        )
    for literals in _disjuncts(condition, rule, inputs):
        reads: dict[str, int] = {}
        for name, index in literals:
            if reads.setdefault(name, index) != index:
                raise _refusal(
                    rule,
                    "each variable once among the parts that must hold together",
                    f"{name} twice",
                    "Declare one term for both: a row has one index per variable.",
                )
        yield reads


def _disjuncts(condition: Condition, rule: Rule, inputs: Indexes) -> list[tuple[Literal, ...]]:
    if isinstance(condition, Hedged):
        raise _hedged(rule, condition)
    if isinstance(condition, Is | Not):
        return [(_literal(condition, rule, inputs),)]
    parts = [_disjuncts(part, rule, inputs) for part in condition.parts]
    if isinstance(condition, Or):
        return [literals for part in parts for literals in part]
    count = 1
    for part in parts:
        count *= len(part)
    if count > MAX_ROWS:
        raise _refusal(rule, f"a rule of at most {MAX_ROWS} rows", f"{count}", "Split the rule.")
    return [tuple(literal for part in choice for literal in part) for choice in product(*parts)]


def _literal(part: Is | Not, rule: Rule, inputs: Indexes) -> Literal:
    is_, sign = (part, 1) if isinstance(part, Is) else (part.part, -1)
    if not isinstance(is_, Is):
        raise _hedged(rule, part)
    if is_.name not in inputs:
        raise _refusal(
            rule,
            "rules that read variables",
            f"{is_.name}, which the rules decide",
            "A .fis file is one step: its outputs cannot be read by other rules.",
        )
    if is_.term not in inputs[is_.name]:
        raise _refusal(
            rule,
            "a group of categories that stand side by side",
            f"{is_.term} of {is_.name}",
            "Declare its categories one behind the other.",
        )
    return is_.name, sign * inputs[is_.name][is_.term]


def _conclusions(rule: Rule, outputs: Indexes) -> Iterator[dict[str, int]]:
    """The consequents, in as many rows as a parameter is concluded at most."""
    rows: list[dict[str, int]] = []
    for is_ in rule.consequents:
        index = outputs[is_.name][is_.term]
        free = next((row for row in rows if is_.name not in row), None)
        if free is None:
            rows.append({is_.name: index})
        else:
            free[is_.name] = index
    yield from rows


def _hedged(rule: Rule, condition: Condition) -> InputError:
    return _refusal(
        rule, "plain terms", f"`{condition}`", "A .fis file has no hedges: declare the term that is meant."
    )


def _refusal(rule: Rule, expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=f"{expected} in rule {rule.number}", got=got, remedy=remedy)
