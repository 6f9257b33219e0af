"""Examples: the rows of a table on one parameter, what is known of them, and what is left out with them."""

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
"""What is left out as one: all rows of a person, of a study, or a single one."""
GROUP = "culture"
"""The variable by which people are one group."""
Inputs = Mapping[str, object]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExampleRow:
    """One row, as the parameter counts it."""

    line: int
    person: tuple[str, str]
    """Study and name; a row that names no participant is a person by itself."""
    study: str
    group: str | None
    """The culture; None where it is not known."""
    value: float
    """In the parameter's unit and convention."""
    before: float
    """What stands for this person in this situation before anything is learnt."""
    inputs: Inputs
    """By variable of the rulebook; None where it is not known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Examples:
    """The rows on one parameter."""

    file: str
    parameter: NumericParameter
    rows: tuple[ExampleRow, ...]
    others: int
    """Rows of other parameters, which are not used."""
    unstated: int
    """Rows that do not say between which points they measured: taken to be measured as the parameter is."""
    unused: tuple[str, ...]
    """Headings that say nothing to the rulebook."""
    sources: tuple[str, ...]
    """That rows name, each once."""
    named: bool
    """Whether any row names its participant."""

    @property
    def mean(self) -> float:
        """Of the rows' values: what a constant says."""
        return fsum(row.value for row in self.rows) / len(self.rows)

    @property
    def studies(self) -> int:
        """How many there are."""
        return len({row.study for row in self.rows})

    @property
    def people(self) -> int:
        """How many are named, a row that names nobody counted as one."""
        return len({row.person for row in self.rows})

    @property
    def left_out(self) -> LeftOut:
        """What is left out by default: a participant where rows name them, else a study, else a row."""
        return "participant" if self.named else "study" if self.studies > 1 else "row"


def unit_of(row: ExampleRow, left_out: LeftOut) -> object:
    """What a row is left out with."""
    return {"participant": row.person, "study": row.study, "row": row.line}[left_out]


def examples(rulebook: Rulebook, basis: ParameterRules, measured: Measurements, radii: Radii) -> Examples:
    """The rows of a table on one parameter.

    Args:
        rulebook: That the table was read for.
        basis: The parameter, and what stands before anything is learnt of it.
        measured: The table.
        radii: Of the bodies, for rows measured between other points than the parameter.

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
    """The variables that rules may read.

    Args:
        rulebook: Of the variables.
        found: The rows.
        names: Asked for; none: those that tell who a person is and differ between rows, else those of the
            situation. A culture that is known by a score is not read by its name as well.

    Raises:
        InputError: if a name is no variable with terms, or no row knows it.
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
    """Each distinct set of facts is looked at once."""
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
            find_score(str(culture))  # a code that no country has is refused in every rulebook
        return infer_for(NOBODY, rulebook, situation=row.facts).inputs
    except InputError as error:
        raise error.at(where) from None
