"""Examples: the rows of a table on one parameter, with their inputs and units of cross-validation."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import fsum
from typing import Literal

from comity.parameters.values import infer_for
from comity.people.profile import NOBODY
from comity.tables.basis import ParameterRules
from comity.tables.evaluation import Radii, in_convention
from comity.tables.measurement import Measurement
from comity.tables.measurements import Measurements
from comity_fis import InputError, NumericParameter, Rulebook, Where, closest, find_score

LeftOut = Literal["participant", "study", "row"]
"""Unit of cross-validation that is held out as a whole: a person, a study, or a single row."""
GROUP = "culture"
"""The variable that defines groups of people."""
Inputs = Mapping[str, object]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExampleRow:
    """One row, in the parameter's convention."""

    line: int
    person: tuple[str, str]
    """Study and name; a row without a participant counts as its own person."""
    study: str
    group: str | None
    """Culture; None if unknown."""
    value: float
    """Value in the parameter's unit and convention."""
    before: float
    """Value for this person and situation before learning."""
    inputs: Inputs
    """Inputs by variable of the rulebook; None if unknown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Examples:
    """The rows on one parameter."""

    file: str
    parameter: NumericParameter
    rows: tuple[ExampleRow, ...]
    others: int
    """Number of unused rows of other parameters."""
    unstated: int
    """Number of rows without a stated convention; the parameter's is assumed."""
    unused: tuple[str, ...]
    """Headings that the rulebook does not use."""
    sources: tuple[str, ...]
    """Sources named in the rows, without duplicates."""
    named: bool
    """Whether any row names its participant."""

    @property
    def mean(self) -> float:
        """Mean of the rows' values: the constant prediction."""
        return fsum(row.value for row in self.rows) / len(self.rows)

    @property
    def studies(self) -> int:
        """Number of studies."""
        return len({row.study for row in self.rows})

    @property
    def people(self) -> int:
        """Number of people; a row without a name counts as one."""
        return len({row.person for row in self.rows})

    @property
    def left_out(self) -> LeftOut:
        """Default unit of cross-validation: a participant if rows name them, else a study, else a row."""
        return "participant" if self.named else "study" if self.studies > 1 else "row"


def unit_of(row: ExampleRow, left_out: LeftOut) -> object:
    """The unit that a row is held out with."""
    return {"participant": row.person, "study": row.study, "row": row.line}[left_out]


def examples(rulebook: Rulebook, basis: ParameterRules, measured: Measurements, radii: Radii) -> Examples:
    """The rows of a table on one parameter.

    Args:
        rulebook: The rulebook that the table was read for.
        basis: The parameter, and its baseline before learning.
        measured: The table.
        radii: Radii of the bodies, for rows in another convention than the parameter's.

    Raises:
        InputError: if there is no row on the parameter, or a fact outside its variable's domain, with its
            line.
    """
    parameter, name = basis.parameter, basis.parameter.name
    rows = [row for row in measured.rows if row.parameter == name]
    if not rows:
        raise InputError(
            expected=f"rows on {name}",
            got=f"rows on {', '.join(sorted({row.parameter for row in measured.rows}))}",
            remedy="Name one of these with --parameter.",
            where=Where(measured.file, measured.rows[0].line),
        )
    return Examples(
        file=measured.file,
        parameter=parameter,
        rows=tuple(_examples(rulebook, basis, rows, radii, measured.file)),
        others=len(measured.rows) - len(rows),
        unstated=sum(row.measured is None for row in rows) if parameter.measured is not None else 0,
        unused=measured.unused,
        sources=tuple(dict.fromkeys(row.source for row in rows if row.source)),
        named=any(row.participant for row in rows),
    )


def chosen_inputs(rulebook: Rulebook, found: Examples, names: Sequence[str] = ()) -> tuple[str, ...]:
    """The input variables of rules.

    Args:
        rulebook: The rulebook with the variables.
        found: The rows.
        names: Requested variables. By default, those that describe the person and differ between rows, else
            those of the situation. A culture's name is not used in addition to its score.

    Raises:
        InputError: if a name is no variable with terms, or no row has a value for it.
    """
    known = [
        name
        for name, variable in rulebook.variables.items()
        if variable.terms and any(row.inputs.get(name) is not None for row in found.rows)
    ]
    for name in names:
        if name not in known:
            is_variable = name in rulebook.variables
            raise InputError(
                expected="a variable of the rulebook that rows of the table know",
                got=f"{name!r}, which none knows" if is_variable else repr(name),
                remedy=f"Add a column {name}." if is_variable else closest(name, known),
                where=Where("--inputs"),
            )
    if names:
        return tuple(dict.fromkeys(names))
    differing = [name for name in known if len({row.inputs[name] for row in found.rows} - {None}) > 1]
    scored = {
        variable.derived_from.fact
        for name, variable in rulebook.variables.items()
        if name in known and variable.derived_from is not None
    }
    by_kind = {
        kind: [name for name in differing if rulebook.variables[name].kind == kind and name not in scored]
        for kind in ("culture", "situation")
    }
    return tuple(by_kind["culture"] or by_kind["situation"])


def _examples(
    rulebook: Rulebook, basis: ParameterRules, rows: Sequence[Measurement], radii: Radii, file: str
) -> Iterator[ExampleRow]:
    """Convert rows; each distinct set of facts is inferred once."""
    known: dict[tuple[tuple[str, float | str], ...], tuple[Inputs, float]] = {}
    for row in rows:
        facts = tuple(row.facts.items())
        if facts not in known:
            told = _inputs(rulebook, row, Where(file, row.line))
            known[facts] = told, basis.value(told)
        inputs, before = known[facts]
        group = inputs.get(GROUP)
        yield ExampleRow(
            line=row.line,
            person=(row.study, row.participant) if row.participant else (row.study, f"line {row.line}"),
            study=row.study,
            group=group if isinstance(group, str) else None,
            value=in_convention(row, basis.parameter, "as_stated", radii),
            before=before,
            inputs=inputs,
        )


def _inputs(rulebook: Rulebook, row: Measurement, where: Where) -> Inputs:
    try:
        if (culture := row.facts.get(GROUP)) is not None:
            find_score(str(culture))  # an unknown country code is refused in every rulebook
        return infer_for(NOBODY, rulebook, situation=row.facts).inputs
    except InputError as error:
        raise error.at(where) from None
