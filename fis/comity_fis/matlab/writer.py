"""Writes a rulebook as a `.fis` file, with a list of what such a file cannot express."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

from comity_fis.errors import InputError
from comity_fis.matlab.columns import MatlabVariable, input_column, output_column, refuse_coarse
from comity_fis.matlab.reader import METHOD_KEYS
from comity_fis.matlab.rules import Indexes, MatlabRule, rows_of
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.sugeno import is_sugeno
from comity_fis.variables.parameter import NumericParameter

FIRST_LINE = "% Written by Comity"
"""First line that marks a file as safe to overwrite."""


@dataclass(frozen=True, slots=True)
class Exported:
    """The text of a `.fis` file, and how it differs from the rulebook."""

    text: str
    changed: tuple[str, ...]
    """Content in another form: codes for categories, trapezoids for curves, several rows for a rule."""
    lost: tuple[str, ...]
    """Content that is lost, or only in comments, which no program reads."""


def write_fis(rulebook: Rulebook, *, tolerance: float | None = None) -> Exported:
    """The rulebook as a `.fis` file.

    Args:
        rulebook: A rulebook with numeric parameters, and rules that read only variables.
        tolerance: Maximum error of a trapezoid that replaces a curve MATLAB does not have; None rejects such
            curves.

    Raises:
        InputError: Something that affects the values has no counterpart.
    """
    inputs = [input_column(variable) for variable in rulebook.variables.values()]
    sugeno = is_sugeno(rulebook)
    outputs = [output_column(parameter, sugeno=sugeno) for parameter in rulebook.parameters.values()]
    refuse_coarse(rulebook, tolerance)
    reads = {column.name: column.index for column in inputs}
    gives = {column.name: column.index for column in outputs}
    _refuse_shifts(rulebook)
    by_rule = {
        rule.number: rows_of(rule, reads, gives, rulebook.methods) for rule in rulebook.rules if rule.enabled
    }
    off = _rows_that_are_off(rulebook, reads, gives)
    changed = (
        *(note for column in (*inputs, *outputs) for note in column.notes),
        *(f"rule {number}: {len(rows)} rows" for number, rows in by_rule.items() if len(rows) > 1),
        *(f"rule {number}, which is off: weight 0" for number in off),
    )
    lost = tuple(_lost(rulebook, off))
    by_rule = {number: (by_rule | off)[number] for number in sorted(by_rule | off)}
    rows = [row for rows in by_rule.values() for row in rows]
    lines = (
        f"{FIRST_LINE} from the rulebook {rulebook.name}; `comity convert` may overwrite it.",
        *(f"% {' '.join(line.split())}" for line in _comments(rulebook, changed, lost)),
        "",
        *_system(rulebook, inputs, outputs, rows, sugeno=sugeno),
        *(line for i, column in enumerate(inputs, 1) for line in _column(f"Input{i}", column)),
        *(line for i, column in enumerate(outputs, 1) for line in _column(f"Output{i}", column)),
        "[Rules]",
        *(_row(row, inputs, outputs) for row in rows),
    )
    return Exported("\n".join(lines) + "\n", changed, lost)


def _rows_that_are_off(
    rulebook: Rulebook, reads: Indexes, gives: Indexes
) -> dict[int, tuple[MatlabRule, ...]]:
    """Disabled rules as rows of weight 0, by rule number, if they can be rows."""
    off: dict[int, tuple[MatlabRule, ...]] = {}
    for rule in rulebook.rules:
        if not rule.enabled:
            with suppress(InputError):
                rows = rows_of(rule, reads, gives, rulebook.methods)
                off[rule.number] = tuple(replace(row, weight=0.0) for row in rows)
    return off


def _refuse_shifts(rulebook: Rulebook) -> None:
    """Reject situational shifts: a `.fis` file has one domain per output and no place for them."""
    for name, block in rulebook.program.shifts.items():
        raise InputError(
            expected="a rulebook whose values no situation moves, for a .fis file",
            got=f"{name} with {len(block.clauses)} rules that move it",
            remedy="Leave out its `shift` and the rules that conclude it.",
        )


def _lost(rulebook: Rulebook, off_rows: Collection[int]) -> Iterator[str]:
    """What the rulebook expresses and a `.fis` file cannot.

    Args:
        rulebook: The rulebook that was written.
        off_rows: Numbers of disabled rules that are in the file with weight 0.
    """
    yield "sources and evidence of rules (comments only), kinds, levels and units"
    yield "an input that is not disclosed; MATLAB wants a number for each"
    if off := [str(r.number) for r in rulebook.rules if not r.enabled and r.number not in off_rows]:
        yield f"rules that are off: {', '.join(off)} (comments only)"
    for parameter in rulebook.parameters.values():
        if not isinstance(parameter, NumericParameter):
            continue
        low, high = parameter.rules.ends
        yield (
            f"of {parameter.name}, that a person may ask for {parameter.ask}, that safety allows "
            f"{parameter.safe}, and the spread {parameter.spread:g} {parameter.unit}"
        )
        if parameter.neutral != (low + high) / 2:
            yield (
                f"the neutral value {parameter.neutral:g} of {parameter.name}: where no rule fires, "
                f"MATLAB gives the middle, {(low + high) / 2:g}"
            )


def _comments(rulebook: Rulebook, changed: Iterable[str], lost: Iterable[str]) -> Iterator[str]:
    yield from changed
    yield from (f"not in this file: {what}" for what in lost)
    for rule in rulebook.rules:
        against = f"; against it: {rule.counter_evidence}" if rule.counter_evidence else ""
        off = "" if rule.enabled else " (off)"
        yield f"rule {rule.number}{off}: {rule.text}; evidence {rule.evidence}; {rule.source}{against}"


def _system(
    rulebook: Rulebook,
    inputs: list[MatlabVariable],
    outputs: list[MatlabVariable],
    rows: list[MatlabRule],
    *,
    sugeno: bool,
) -> Iterator[str]:
    yield from (
        "[System]",
        f"Name='{rulebook.name}'",
        f"Type='{'sugeno' if sugeno else 'mamdani'}'",
        "Version=2.0",
        f"NumInputs={len(inputs)}",
        f"NumOutputs={len(outputs)}",
        f"NumRules={len(rows)}",
    )
    for key, field in METHOD_KEYS.items():
        averaged = sugeno and field == "defuzzification"
        yield f"{key}='{'wtaver' if averaged else getattr(rulebook.methods, field)}'"
    yield ""


def _column(head: str, column: MatlabVariable) -> Iterator[str]:
    yield from (
        f"[{head}]",
        f"Name='{column.name}'",
        f"Range={_vector((column.low, column.high))}",
        f"NumMFs={len(column.shapes)}",
    )
    for i, (term, shape) in enumerate(column.shapes.items(), 1):
        yield f"MF{i}='{term}':'{shape.kind}',{_vector(shape.numbers)}"
    yield ""


def _row(row: MatlabRule, inputs: list[MatlabVariable], outputs: list[MatlabVariable]) -> str:
    reads, gives = _indexes(row.reads, inputs), _indexes(row.concludes, outputs)
    return f"{reads}, {gives} ({_number(row.weight)}) : {2 if row.either else 1}"


def _indexes(used: Mapping[str, int], columns: Iterable[MatlabVariable]) -> str:
    return " ".join(str(used.get(column.name, 0)) for column in columns)


def _vector(numbers: Iterable[float]) -> str:
    return f"[{' '.join(map(_number, numbers))}]"


def _number(x: float) -> str:
    """The shortest text that parses to the same number."""
    return str(int(x)) if x == int(x) and abs(x) < 1e15 else repr(x)
