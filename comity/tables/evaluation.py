"""Evaluation of a rulebook against measured tuples: predictions, errors by convention, accuracy by study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from typing import TYPE_CHECKING, Literal

from comity.parameters.values import infer_for
from comity.people.profile import NOBODY
from comity.tables.measurement import Convention, Measurement
from comity.tables.measurements import Measurements
from comity_fis import InputError, NumericParameter, Where, find_score
from comity_fis.audit.accuracy import Compared, StudyAccuracy, accuracy
from comity_fis.audit.agreement import StudyAgreement, agreement
from comity_fis.audit.order import equality_band
from comity_sim2d.scene.person import PERSON_RADIUS_M
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M

if TYPE_CHECKING:
    from comity_fis import Origin, ParameterValue, Rulebook

Reading = Literal["surface", "centre", "as_stated"]
"""Assumed convention of rows that do not state between which points of the bodies they measured."""


@dataclass(frozen=True, slots=True)
class Radii:
    """Radii of the bodies, by which the conventions differ [m]."""

    robot: float = ROBOT_RADIUS_M
    person: float = PERSON_RADIUS_M

    def gap(self, row: Measurement) -> float:
        """Difference between a distance of centres and one of surfaces [m]."""
        return self.person + (self.robot if row.partner == "robot" else self.person)


USUAL_RADII = Radii()


@dataclass(frozen=True, slots=True)
class Predicted:
    """One measured row, and the rulebook's prediction from the row's facts."""

    row: Measurement
    value: float | str
    """Prediction in the parameter's unit and convention."""
    spread: float | None
    origin: Origin
    score: float | None
    """Individualism score; None without a culture that has one."""
    unscored: bool
    """Whether the row names a culture without a score in any table of the rulebook."""

    @property
    def standard_error(self) -> float | None:
        """Standard error of the measured mean; None if n or the standard deviation is unknown."""
        row = self.row
        return None if row.n is None or row.sd is None else row.sd / sqrt(row.n)


@dataclass(frozen=True, slots=True)
class Numbers:
    """All rows on one numeric parameter."""

    parameter: NumericParameter
    rows: tuple[Predicted, ...]
    readings: Mapping[Reading, Mapping[str, StudyAccuracy]]
    """Accuracy by reading, then by study."""
    errors: Mapping[Reading, tuple[float, ...]]
    """By reading, the error of each row: predicted minus measured."""

    @property
    def band(self) -> float:
        """The largest difference that counts as zero."""
        return equality_band(self.parameter)


@dataclass(frozen=True, slots=True)
class NominalEvaluation:
    """All rows on one nominal parameter."""

    rows: tuple[Predicted, ...]
    studies: Mapping[str, StudyAgreement]


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A rulebook evaluated on a file of measurements."""

    rulebook: str
    measurements: Measurements
    radii: Radii
    numbers: Mapping[str, Numbers]
    words: Mapping[str, NominalEvaluation]

    @property
    def unscored(self) -> tuple[Predicted, ...]:
        """Rows of cultures without a score, predicted from the other facts only."""
        rows = [row for one in self.numbers.values() for row in one.rows]
        rows += [row for one in self.words.values() for row in one.rows]
        return tuple(row for row in rows if row.unscored)


def evaluate(rulebook: Rulebook, measurements: Measurements, radii: Radii = Radii()) -> Evaluation:
    """Evaluate a rulebook against measured tuples.

    Args:
        rulebook: The rules.
        measurements: Measurements read for this rulebook.
        radii: Radii of the bodies, for rows measured between centres.

    Raises:
        InputError: for a fact outside its variable's domain, with its line.
    """
    predicted = _predict(rulebook, measurements)
    by_parameter = {
        name: tuple(one for one in predicted if one.row.parameter == name)
        for name in dict.fromkeys(row.parameter for row in measurements.rows)
    }
    numbers: dict[str, Numbers] = {}
    words: dict[str, NominalEvaluation] = {}
    for name, rows in by_parameter.items():
        parameter = rulebook.parameters[name]
        if isinstance(parameter, NumericParameter):
            numbers[name] = _numbers(parameter, rows, radii)
        else:
            words[name] = NominalEvaluation(rows, _agreements(rows))
    return Evaluation(rulebook.name, measurements, radii, numbers, words)


def by_study(rows: Sequence[Predicted]) -> dict[str, list[int]]:
    """Row indices by study, studies in the file's order."""
    places: dict[str, list[int]] = {}
    for place, one in enumerate(rows):
        places.setdefault(one.row.study, []).append(place)
    return places


def _predict(rulebook: Rulebook, measurements: Measurements) -> list[Predicted]:
    """Predict each row; each distinct set of facts is inferred once."""
    inferred: dict[tuple[tuple[str, float | str], ...], _Inferred] = {}
    predicted = []
    for row in measurements.rows:
        facts = tuple(row.facts.items())
        if facts not in inferred:
            inferred[facts] = _infer(rulebook, row, Where(measurements.file, row.line))
        parameters, individualism, unscored = inferred[facts]
        value = parameters[row.parameter]
        predicted.append(Predicted(row, value.value, value.spread, value.origin, individualism, unscored))
    return predicted


_Inferred = tuple[Mapping[str, "ParameterValue"], float | None, bool]
"""Values by parameter, the individualism score, and whether a culture without a score was named."""


def _infer(rulebook: Rulebook, row: Measurement, where: Where) -> _Inferred:
    culture = row.facts.get("culture")
    try:
        found = None if culture is None else find_score(str(culture))
        inference = infer_for(NOBODY, rulebook, situation=row.facts)
    except InputError as error:
        raise error.at(where) from None
    unscored = culture is not None and found is None and not inference.sources
    number = inference.inputs.get("individualism")
    if not isinstance(number, float):
        number = None if found is None else found.value
    return inference.parameters, number, unscored


def _numbers(parameter: NumericParameter, rows: tuple[Predicted, ...], radii: Radii) -> Numbers:
    unstated = parameter.measured is not None and any(one.row.measured is None for one in rows)
    readings: tuple[Reading, ...] = ("surface", "centre") if unstated else ("as_stated",)
    compared: dict[Reading, list[Compared]] = {
        reading: [_compared(one, parameter, reading, radii) for one in rows] for reading in readings
    }
    studies = by_study(rows)
    return Numbers(
        parameter=parameter,
        rows=rows,
        readings={
            reading: accuracy(
                {name: [pairs[place] for place in places] for name, places in studies.items()},
                band=equality_band(parameter),
                neutral=parameter.neutral,
            )
            for reading, pairs in compared.items()
        },
        errors={reading: tuple(pair.error for pair in pairs) for reading, pairs in compared.items()},
    )


def _compared(one: Predicted, parameter: NumericParameter, reading: Reading, radii: Radii) -> Compared:
    """A row converted to the parameter's convention."""
    assert isinstance(one.value, float)
    return Compared(in_convention(one.row, parameter, reading, radii), one.value, one.score)


def in_convention(
    row: Measurement, parameter: NumericParameter, reading: Reading, radii: Radii = Radii()
) -> float:
    """A measured number in the parameter's convention: between surfaces, or between centres.

    Args:
        row: A row of this parameter.
        parameter: The parameter, which defines its convention.
        reading: Convention of the row if it does not state one.
        radii: Radii of the bodies.
    """
    assert isinstance(row.value, float)
    said: Convention | Reading | None = row.measured or reading
    if parameter.measured is None or said in (parameter.measured, "as_stated"):
        return row.value
    return row.value - radii.gap(row) if said == "centre" else row.value + radii.gap(row)


def _agreements(rows: tuple[Predicted, ...]) -> dict[str, StudyAgreement]:
    return {
        name: agreement([(str(rows[place].row.value), str(rows[place].value)) for place in places])
        for name, places in by_study(rows).items()
    }
