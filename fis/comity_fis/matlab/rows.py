"""Translates a `.fis` file's rules, rows of indexes such as `1 -2 0, 3 (0.5) : 1`, to rules in words.

One index per input, one per output, the weight, and 1 for `and` or 2 for `or`. Indexes count a variable's
terms from 1; 0 omits the variable, a negative index means `not`. A weight of 0 disables a rule.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from comity_fis.matlab.lines import MatlabLine, whole
from comity_fis.rulebook.models import LONGEST_NAME
from comity_fis.rules.grammar import MAX_LENGTH
from comity_fis.rules.rule import And, Condition, Is, Not, Or, Rule, Source

Terms = Mapping[str, Sequence[str]]
"""Variables in the file's order, each with its terms in the file's order."""

ROW = re.compile(r"([^,()]*),([^,()]*)\(([^()]*)\)\s*:\s*(\S*)")


def read_rows(
    rows: Sequence[MatlabLine], *, inputs: Terms, outputs: Terms, source: Source, constants: bool = False
) -> tuple[Rule, ...]:
    """The rules; rows without a conclusion are skipped.

    Args:
        rows: The rule lines of the file.
        inputs: Inputs with their terms.
        outputs: Outputs with their terms.
        source: Source of all rules.
        constants: Whether the outputs' terms are constants, which cannot be negated.

    Raises:
        InputError: An index, weight or connective is invalid.
    """
    read = [_parts(row, inputs, outputs) for row in rows]
    for parts in read:
        if constants and any(negative for _, negative in parts.concludes):
            raise parts.row.wrong(
                "indexes of outputs from 0 in a Sugeno system",
                "A constant has no opposite: declare another one.",
            )
    return tuple(
        _rule(number, parts, outputs, source)
        for number, parts in enumerate((parts for parts in read if parts.concludes), 1)
    )


class _Parts(NamedTuple):
    """The parts of a row."""

    row: MatlabLine
    reads: tuple[tuple[Is, bool], ...]
    """Antecedents, each with whether it is negated."""
    concludes: tuple[tuple[Is, bool], ...]
    """Consequents, each with whether it is negated."""
    weight: float
    connective: int | None


def _parts(row: MatlabLine, inputs: Terms, outputs: Terms) -> _Parts:
    match = ROW.fullmatch(row.text)
    if match is None:
        raise row.wrong("a rule such as 1 2, 1 (1) : 1", "Correct the line.")
    antecedent, consequent, weight, connective = match.groups()
    concludes = tuple(_literals(row, consequent, outputs, "output"))
    reads = tuple(_literals(row, antecedent, inputs, "input"))
    return _Parts(row, reads, concludes, _weight(row, weight.strip()), whole(connective))


def _rule(number: int, parts: _Parts, outputs: Terms, source: Source) -> Rule:
    row = parts.row
    conclusions = tuple(
        _opposite(row, is_, outputs) if negative else is_ for is_, negative in parts.concludes
    )
    condition = _condition(parts)
    text = f"if {condition} then {' and '.join(map(str, conclusions))}"
    if len(text) > MAX_LENGTH:
        raise row.wrong(f"a rule of at most {MAX_LENGTH} characters in words", "Split it.")
    return Rule(
        number=number,
        text=text,
        antecedent=condition,
        consequents=conclusions,
        sources=(source,),
        evidence="design",
        weight=parts.weight or 1.0,
        enabled=parts.weight > 0,
    )


def _opposite(row: MatlabLine, is_: Is, outputs: Terms) -> Is:
    """The conclusion for a negative index: a separate, complementary term."""
    opposite = negated(is_.term)
    if opposite in outputs[is_.name] or len(opposite) > LONGEST_NAME:
        raise row.wrong(f"a term of {is_.name!r} that can be called {opposite!r}", "Rename or shorten it.")
    return Is(is_.name, opposite)


def negated(term: str) -> str:
    """Name of the term for a negative index in a consequent."""
    return f"not {term}"


def _condition(parts: _Parts) -> Condition:
    literals: tuple[Condition, ...] = tuple(Not(is_) if negative else is_ for is_, negative in parts.reads)
    if parts.connective not in {1, 2}:
        raise parts.row.wrong("1 (and) or 2 (or) behind the colon", "Correct it.")
    if not literals:
        raise parts.row.wrong(
            "a rule that reads at least one input", "Give it one: a rule needs a condition."
        )
    if len(literals) == 1:
        return literals[0]
    return And(literals) if parts.connective == 1 else Or(literals)


def _literals(row: MatlabLine, text: str, variables: Terms, kind: str) -> Iterator[tuple[Is, bool]]:
    """Every variable with a nonzero index in a row, with its term and whether it is negated."""
    words = text.split()
    if len(words) != len(variables):
        raise row.wrong(f"{len(variables)} {kind} indexes, one for each {kind}", "Correct the row.")
    for word, (name, terms) in zip(words, variables.items(), strict=True):
        index = whole(word)
        if index is None:
            raise row.wrong(
                f"a whole number where {word[:20]!r} stands",
                "GNU Octave's hedges (fractions of an index) are not MATLAB's, and not read.",
            )
        if abs(index) > len(terms):
            raise row.wrong(
                f"an index of {name!r} from -{len(terms)} to {len(terms)}"
                if terms
                else f"the index 0 of {name!r}, which has no terms",
                "Correct it, or add a term.",
            )
        if index:
            yield Is(name, terms[abs(index) - 1]), index < 0


def _weight(row: MatlabLine, text: str) -> float:
    weight = row.number(text)
    if not 0 <= weight <= 1:
        raise row.wrong("a weight from 0 to 1", "Write 1 for a rule that counts in full.")
    return weight
