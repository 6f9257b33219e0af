"""A `.fis` file's rules: rows of indexes, such as `1 -2 0, 3 (0.5) : 1`, and what they say in words.

One index per input, one per output, the weight, and 1 for `and` or 2 for `or`. An index counts a variable's
terms from 1; 0 leaves the variable out, a negative one means `not`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from comity_fis.matlab.lines import WHOLE, Entry
from comity_fis.rulebook.models import LONGEST_NAME
from comity_fis.rules.grammar import MAX_LENGTH
from comity_fis.rules.rule import And, Condition, Is, Not, Or, Rule, Source

Terms = Mapping[str, Sequence[str]]
"""Variables in the file's order, each with its terms in the file's order."""

ROW = re.compile(r"([^,()]*),([^,()]*)\(([^()]*)\)\s*:\s*(\S*)")


def read_rows(rows: Sequence[Entry], *, inputs: Terms, outputs: Terms, source: Source) -> tuple[Rule, ...]:
    """The rules.

    Raises:
        InputError: for an index, a weight or a connective that stands for nothing.
    """
    return tuple(_rule(number, row, inputs, outputs, source) for number, row in enumerate(rows, 1))


def _rule(number: int, row: Entry, inputs: Terms, outputs: Terms, source: Source) -> Rule:
    match = ROW.fullmatch(row.text)
    if match is None:
        raise row.wrong("a rule such as 1 2, 1 (1) : 1", "Correct the line.")
    antecedent, consequent, weight, connective = match.groups()
    conclusions = tuple(
        _opposite(row, is_, outputs) if negative else is_
        for is_, negative in _literals(row, consequent, outputs, "output")
    )
    if not conclusions:
        raise row.wrong("a rule that concludes something", "Remove it: it never changes an answer.")
    condition = _condition(row, antecedent, inputs, connective)
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
        weight=_weight(row, weight.strip()),
    )


def _opposite(row: Entry, is_: Is, outputs: Terms) -> Is:
    """A negative conclusion: a term of its own."""
    opposite = negated(is_.term)
    if opposite in outputs[is_.name] or len(opposite) > LONGEST_NAME:
        raise row.wrong(f"a term of {is_.name!r} that can be called {opposite!r}", "Rename or shorten it.")
    return Is(is_.name, opposite)


def negated(term: str) -> str:
    """What the term of a negative index in a consequent is called."""
    return f"not {term}"


def _condition(row: Entry, text: str, inputs: Terms, connective: str) -> Condition:
    parts: tuple[Condition, ...] = tuple(
        Not(is_) if negative else is_ for is_, negative in _literals(row, text, inputs, "input")
    )
    if connective not in {"1", "2"}:
        raise row.wrong("1 (and) or 2 (or) behind the colon", "Correct it.")
    if not parts:
        raise row.wrong("a rule that reads at least one input", "Give it one: a rule needs a condition.")
    if len(parts) == 1:
        return parts[0]
    return And(parts) if connective == "1" else Or(parts)


def _literals(row: Entry, text: str, variables: Terms, kind: str) -> Iterator[tuple[Is, bool]]:
    """Every variable that a row does not leave out, with the term, and whether that is negated."""
    words = text.split()
    if len(words) != len(variables):
        raise row.wrong(f"{len(variables)} {kind} indexes, one for each {kind}", "Correct the row.")
    for word, (name, terms) in zip(words, variables.items(), strict=True):
        if not WHOLE.fullmatch(word):
            raise row.wrong(
                f"a whole number where {word[:20]!r} stands",
                "GNU Octave's hedges (fractions of an index) are not MATLAB's, and not read.",
            )
        index = int(word)
        if abs(index) > len(terms):
            raise row.wrong(
                f"an index of {name!r} from -{len(terms)} to {len(terms)}", "Correct it, or add a term."
            )
        if index:
            yield Is(name, terms[abs(index) - 1]), index < 0


def _weight(row: Entry, text: str) -> float:
    weight = row.number(text)
    if not 0 < weight <= 1:
        raise row.wrong(
            "a weight above 0 and at most 1",
            "Remove a rule of weight 0: it never changes an answer."
            if weight == 0
            else "Write 1 for a rule that counts in full.",
        )
    return weight
