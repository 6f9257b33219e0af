"""A rulebook against measured tuples: row by row, study by study, under both readings of a distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.measuring import EvaluateAnswer, MeasuredRowAnswer, NumbersAnswer, WordsAnswer
from comity.report.difference import bare, difference, shown_unit
from comity.report.text import number, stated, table, words
from comity_fis.audit.accuracy import StudyAccuracy
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity.tables.evaluation import Evaluation, NominalEvaluation, Numbers, Predicted
    from comity_fis.audit.accuracy import StudyAccuracy
    from comity_fis.audit.rank_correlation import RankCorrelation

ROWS_SHOWN = 40
"""Of one parameter; the JSON answer has all."""
READ_AS = {
    "surface": "If rows that do not say were measured between the nearest points of the bodies",
    "centre": "If rows that do not say were measured between the centres of the bodies",
    "as_stated": "By study",
}
BASELINES = {"neutral": "the neutral value", "constant": "the constant", "line": "the line"}
ERROR_IF = {"surface": "surface", "centre": "centre", "as_stated": "error"}


def evaluate_answer(evaluation: Evaluation, files: tuple[str, ...] = ()) -> EvaluateAnswer:
    """The answer of `comity evaluate --json`."""
    return EvaluateAnswer(
        rulebook=evaluation.rulebook,
        file=evaluation.measurements.file,
        rows=len(evaluation.measurements.rows),
        rows_without_score=len(evaluation.unscored),
        unused=evaluation.measurements.unused,
        robot_radius_m=evaluation.radii.robot,
        person_radius_m=evaluation.radii.person,
        numbers={name: _numbers_answer(one) for name, one in evaluation.numbers.items()},
        words={
            name: WordsAnswer(
                rows=tuple(_row_answer(row, {}) for row in one.rows),
                studies=one.studies,
            )
            for name, one in evaluation.words.items()
        },
        files=files,
    )


def _numbers_answer(numbers: Numbers) -> NumbersAnswer:
    return NumbersAnswer(
        unit=numbers.parameter.unit,
        measured=numbers.parameter.measured,
        equality_band=numbers.band,
        rows=tuple(
            _row_answer(row, {reading: errors[i] for reading, errors in numbers.errors.items()})
            for i, row in enumerate(numbers.rows)
        ),
        readings=numbers.readings,
    )


def _row_answer(one: Predicted, errors: Mapping[str, float]) -> MeasuredRowAnswer:
    row = one.row
    return MeasuredRowAnswer(
        line=row.line,
        study=row.study,
        source=row.source,
        facts=row.facts,
        measured=row.value,
        between=row.measured,
        partner=row.partner,
        n=row.n,
        sd=row.sd,
        standard_error=one.standard_error,
        predicted=one.value,
        spread=one.spread,
        origin=one.origin,
        errors=errors,
        note=row.note,
    )


def evaluate_text(evaluation: Evaluation) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    read = evaluation.measurements
    studies = {row.study for row in read.rows}
    yield (
        f"Rulebook {evaluation.rulebook} against {read.file}: "
        f"{counted(len(read.rows), 'row')} of {counted(len(studies), 'study', 'studies')}"
    )
    yield "What the rules say of people of whom only a row's facts are known. Studies are never pooled."
    if unscored := evaluation.unscored:
        cultures = ", ".join(dict.fromkeys(str(one.row.facts["culture"]) for one in unscored))
        yield f"{counted(len(unscored), 'row')} of a culture without a score: {cultures}."
    if read.unused:
        yield f"Headings that say nothing to this rulebook: {', '.join(read.unused)}"
    for name, numbers in evaluation.numbers.items():
        yield from _numbers_text(name, numbers, evaluation)
    for name, said in evaluation.words.items():
        yield from _words_text(name, said)
    yield from _remarks(evaluation)


def _numbers_text(name: str, numbers: Numbers, evaluation: Evaluation) -> Iterator[RenderableType]:
    parameter = numbers.parameter
    yield f"\n{words(name).capitalize()}"
    if parameter.measured is not None:
        between = {"surface": "nearest points", "centre": "centres"}[parameter.measured]
        radii = evaluation.radii
        yield (
            f"  The rulebook's distance is between the {between} of the two bodies (radius of a robot "
            f"{radii.robot:g} m, of a person {radii.person:g} m)."
        )
    if "centre" in numbers.errors:
        yield (
            "  Some rows do not say how they measured: errors if it was between surfaces, and if between "
            "centres."
        )
    yield table(
        [
            (
                one.row.study,
                _people(one),
                number(one.row.value, parameter.unit),
                number(one.value, parameter.unit),
                *(difference(errors[i], parameter.unit) for errors in numbers.errors.values()),
            )
            for i, one in enumerate(numbers.rows[:ROWS_SHOWN])
        ],
        head=("study", "people", "measured", "rulebook", *(ERROR_IF[reading] for reading in numbers.errors)),
    )
    if neutral := {_people(one): None for one in numbers.rows if one.origin == "neutral"}:
        yield f"  The neutral value stands for: {'; '.join(neutral)}."
    if len(numbers.rows) > ROWS_SHOWN:
        yield f"  and {len(numbers.rows) - ROWS_SHOWN} more rows; --json has all"
    for reading, by_study in numbers.readings.items():
        yield f"\n{READ_AS[reading]}{f', in {shown}' if (shown := shown_unit(parameter.unit)) else ''}"
        yield from _studies_text(by_study, parameter.unit, numbers.band)


def _studies_text(studies: Mapping[str, StudyAccuracy], unit: str, band: float) -> Iterator[RenderableType]:
    yield table(
        [
            (
                name,
                str(one.rows),
                bare(one.mean_absolute_error, unit, sign=False),
                bare(one.bias, unit),
                bare(one.neutral, unit, sign=False),
                bare(one.constant, unit, sign=False),
                bare(one.line, unit, sign=False),
                _rank(one.rank_correlation),
            )
            for name, one in studies.items()
        ],
        head=("study", "rows", "error", "bias", "neutral", "constant", "line", "rank"),
    )
    orders = [one.order for one in studies.values()]
    yield (
        f"  Pairs of rows of one study that differ: {sum(o.agreeing for o in orders)} in the measured order, "
        f"{sum(o.contradicting for o in orders)} in the opposite one, {sum(o.equal for o in orders)} made "
        f"equal (within {difference(band, unit, sign=False)})."
    )
    for baseline, name in BASELINES.items():
        won, studied = _won(studies, baseline)
        if studied:
            yield f"  Smaller error than {name} in {won} of {counted(studied, 'study', 'studies')}."


def _won(studies: Mapping[str, StudyAccuracy], baseline: str) -> tuple[int, int]:
    """In how many of the studies where the baseline exists the rulebook has the smaller error."""
    pairs = [
        (one.mean_absolute_error, other)
        for one in studies.values()
        if (other := getattr(one, baseline)) is not None
    ]
    return sum(own < other for own, other in pairs), len(pairs)


def _words_text(name: str, said: NominalEvaluation) -> Iterator[RenderableType]:
    yield f"\n{words(name).capitalize()}"
    yield table(
        [
            (one.row.study, _people(one), number(one.row.value), number(one.value), _hit(one))
            for one in said.rows[:ROWS_SHOWN]
        ],
        head=("study", "people", "reported", "rulebook", ""),
    )
    yield "\nBy study"
    yield table(
        [
            (
                study,
                f"{one.hits} of {one.rows}",
                "-" if one.constant_hits is None else f"{one.constant_hits} of {one.rows}",
            )
            for study, one in said.studies.items()
        ],
        head=("study", "same word", "most frequent word of the others"),
    )


def _remarks(evaluation: Evaluation) -> Iterator[RenderableType]:
    """How to read the columns; then each study's source and notes, once."""
    if evaluation.numbers:
        yield (
            "\nerror: mean absolute error; bias: mean error. The same error of knowing nothing (neutral), of "
            "saying the mean of the study's other rows (constant), of a straight line over individualism "
            "through them (line, from three rows on). rank: Spearman's correlation, with its 95 % interval "
            "from four rows on; of two rows it can only be 1 or -1."
        )
    about: dict[str, dict[str, None]] = {}
    for row in evaluation.measurements.rows:
        for text in filter(None, (row.source, row.note)):
            about.setdefault(row.study, {})[text] = None
    if about:
        yield "\nStudies"
        yield table(
            [(study, ". ".join(text.rstrip(".") for text in texts) + ".") for study, texts in about.items()]
        )


def _people(one: Predicted) -> str:
    return ", ".join(stated(fact) for fact in one.row.facts.values()) or "nothing known"


def _hit(one: Predicted) -> str:
    return "same" if one.row.value == one.value else "another"


def _rank(rank: RankCorrelation | None) -> str:
    if rank is None:
        return "-"
    if rank.low is None or rank.high is None:
        return f"{rank.value:+.2f}"
    return f"{rank.value:+.2f} ({rank.low:+.2f} to {rank.high:+.2f})"
