"""One measured (culture, parameter) tuple: the value, its convention, the people and the study."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, cast, get_args

from comity_fis import (
    InputError,
    NumericParameter,
    NumericVariable,
    Parameter,
    Rulebook,
    Variable,
    Where,
    closest,
)
from comity_fis.listing import listed
from comity_fis.validation.csv_table import CsvTable, Row, short
from comity_fis.variables.unit import factor

Convention = Literal["surface", "centre"]
Partner = Literal["robot", "person"]

UNNAMED = "unnamed study"
FAR_OFF = 10
"""Factor beyond the range of possible requests above which a number is taken for a wrong unit (our
choice)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurement:
    """One row: a study's result for people with these facts."""

    line: int
    study: str
    """Name of the study; rows are compared within a study only."""
    source: str
    facts: Mapping[str, float | str]
    """Facts by variable of the rulebook, or `culture`."""
    parameter: str
    value: float | str
    """Number in the parameter's unit, or a category."""
    measured: Convention | None
    """Convention of a distance (between which points); None if the source does not state it."""
    partner: Partner
    """Partner of the distance: their radius is part of a distance between centres."""
    n: int | None
    """Number of people; None if unknown."""
    sd: float | None
    """Standard deviation between people, in the parameter's unit; None if unknown."""
    participant: str
    """Participant within the study; empty if the row summarises several people, or does not name one."""
    note: str


def facts_of(rulebook: Rulebook) -> Mapping[str, Variable | None]:
    """Facts that a row may state: the rulebook's variables, and facts that variables are derived from."""
    derived = {
        variable.derived_from.fact: None if variable.derived_from.table else variable
        for variable in rulebook.variables.values()
        if variable.derived_from is not None
    }
    return {**derived, **rulebook.variables}


@dataclass(frozen=True, slots=True)
class RowReader:
    """Reads rows of one table for one rulebook."""

    table: CsvTable
    rulebook: Rulebook
    facts: tuple[str, ...]
    """Headings that are facts."""
    about: str = ""
    """Parameter of rows that name none."""

    def measurement(self, row: Row) -> Measurement:
        """One row, checked except for the values of facts, which inference checks."""
        try:
            parameter = self._parameter(row)
            study, source = self._cell(row, "study"), self._cell(row, "source")
            value, scale = self._value(row, parameter)
            _refuse_below_zero(parameter, value)
            deviation = self._optional_number(row, "sd")
            self._refuse_slip_of_unit(parameter, [value, 0.0 if deviation is None else deviation * scale])
            return Measurement(
                line=row.line,
                study=study or source or UNNAMED,
                source=source,
                facts=self._facts(row),
                parameter=parameter.name,
                value=value,
                measured=self._convention(row, parameter),
                partner=cast(Partner, self._one_of(row, "partner", Partner) or "robot"),
                n=self._count(row),
                sd=None if deviation is None else deviation * scale,
                participant=self._cell(row, "participant"),
                note=self._cell(row, "note"),
            )
        except InputError as error:
            raise error.at(Where(self.table.file, row.line)) from None

    def _cell(self, row: Row, name: str) -> str:
        return row.cell(self.table.heading.index(name)) if name in self.table.heading else ""

    def _parameter(self, row: Row) -> Parameter:
        name = self._cell(row, "parameter") or self.about
        if name not in self.rulebook.parameters:
            raise InputError(
                expected=f"a parameter of the rulebook {self.rulebook.name}",
                got=short(name) if name else "nothing",
                remedy=closest(name, self.rulebook.parameters),
            )
        return self.rulebook.parameters[name]

    def _value(self, row: Row, parameter: Parameter) -> tuple[float | str, float]:
        """The value, and the factor of its unit conversion."""
        cell, unit = self._cell(row, "value"), self._cell(row, "unit")
        if not isinstance(parameter, NumericParameter):
            return parameter.check(cell), 1.0
        scale = factor(unit or ("1" if parameter.unit == "1" else ""), parameter.unit)
        return self.table.number(cell, row.line, f"a finite number as {parameter.name}") * scale, scale

    def _refuse_slip_of_unit(self, parameter: Parameter, numbers: list[float | str]) -> None:
        if isinstance(parameter, NumericParameter):
            most = FAR_OFF * max(map(abs, parameter.ask.ends))
            if too_large := [n for n in numbers if isinstance(n, float) and abs(n) > most]:
                raise InputError(
                    expected=f"{parameter.name} of at most {most:g} {parameter.unit}, "
                    f"{FAR_OFF} times what anybody may ask for",
                    got=f"{too_large[0]:g} {parameter.unit}",
                    remedy="Check the unit: centimetres may have been taken for metres.",
                )

    def _facts(self, row: Row) -> Mapping[str, float | str]:
        cells = {name: self._cell(row, name) for name in self.facts}
        told = {name: cell for name, cell in cells.items() if cell and cell != "unknown"}
        variables = facts_of(self.rulebook)
        return {
            name: self.table.number(cell, row.line, f"a number as {name}")
            if isinstance(variables[name], NumericVariable)
            else cell
            for name, cell in told.items()
        }

    def _convention(self, row: Row, parameter: Parameter) -> Convention | None:
        said = self._one_of(row, "measured", Convention)
        if said and (not isinstance(parameter, NumericParameter) or parameter.measured is None):
            raise InputError(
                expected=f"no word on points of bodies for {parameter.name}, which the rulebook does not "
                "declare to be a distance between bodies",
                got=repr(said),
                remedy="Leave `measured` empty, or let the rulebook say how the parameter is measured.",
            )
        return cast("Convention | None", said)

    def _one_of(self, row: Row, name: str, words: object) -> str | None:
        cell = self._cell(row, name).lower()
        if cell and cell not in get_args(words):
            raise InputError(
                expected=f"{listed(get_args(words), 'or')} as {name}, or an empty cell",
                got=short(cell),
                remedy="Leave it empty where the source does not say.",
            )
        return cell or None

    def _optional_number(self, row: Row, name: str) -> float | None:
        cell = self._cell(row, name)
        number = self.table.number(cell, row.line) if cell else None
        if number is not None and number < 0:
            raise InputError(
                expected=f"{name} of 0 or more",
                got=short(cell),
                remedy="Leave it empty where it is not known.",
            )
        return number

    def _count(self, row: Row) -> int | None:
        number = self._optional_number(row, "n")
        if number is not None and (number != int(number) or number < 1):
            raise InputError(
                expected="a whole number of people as n",
                got=short(self._cell(row, "n")),
                remedy="Leave it empty where it is not known.",
            )
        return None if number is None else int(number)


def _refuse_below_zero(parameter: Parameter, value: float | str) -> None:
    """Refuse negative values of a parameter that cannot be negative, such as a distance."""
    if isinstance(parameter, NumericParameter) and parameter.ask.low >= 0 and float(value) < 0:
        raise InputError(
            expected=f"{parameter.name} of 0 {parameter.unit} or more",
            got=f"{value:g} {parameter.unit}",
            remedy="Check the sign, and what the study counted from.",
        )
