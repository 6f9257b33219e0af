"""`comity study power`: how many people a study with people needs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from collections.abc import Iterator

    from comity.answers.study import StudyPowerAnswer
    from comity.study.measured_spread import MeasuredSpread

Difference = Annotated[float, typer.Option("--difference-cm", help="Between the means of two conditions.")]
Spread = Annotated[
    float | None, typer.Option("--sd-cm", help="Standard deviation between people; or --from measures it.")
]
From = Annotated[
    Path | None, typer.Option("--from", metavar="FILE.csv", help="A table with a row for each person.")
]
ColumnName = Annotated[
    str | None,
    typer.Option("--column", metavar="NAME", help="Of the table; its name ends with _m, _cm or _mm."),
]
By = Annotated[
    str | None, typer.Option("--by", metavar="NAME", help="Take the spread within the groups of a column.")
]
Correlation = Annotated[
    float | None,
    typer.Option("--paired", metavar="R", help="Each person meets both; their two values correlate so."),
]
Cluster = Annotated[int, typer.Option("--cluster", min=1, help="People who come together, as in a ward.")]
Icc = Annotated[float, typer.Option("--icc", help="How alike people of one cluster are, 0 to 1.")]
Alpha = Annotated[float, typer.Option("--alpha", help="Of a two-sided test.")]
Power = Annotated[float, typer.Option("--power", help="Probability to find the difference.")]


def power(
    *,
    difference_cm: Difference,
    sd_cm: Spread = None,
    from_: From = None,
    column: ColumnName = None,
    by: By = None,
    paired: Correlation = None,
    cluster: Cluster = 1,
    icc: Icc = 0.0,
    alpha: Alpha = 0.05,
    power: Power = 0.80,
    as_json: AsJson = False,
) -> None:
    """Say how many people it takes to find a difference in distance, by a two-sided t-test.

    Example: comity study power --difference-cm 20 --sd-cm 35
    """
    from comity.answers.study import StudyPowerAnswer
    from comity.report.text import show
    from comity.study.power import PowerQuestion, people_needed

    measured = _measured(sd_cm, from_, column, by)
    question = PowerQuestion(
        difference_cm=difference_cm,
        sd_cm=sd_cm if sd_cm is not None else measured.sd_cm if measured else 0.0,
        correlation=paired,
        cluster=cluster,
        icc=icc,
        alpha=alpha,
        power=power,
    )
    needed = people_needed(question)
    answer = StudyPowerAnswer(
        difference_cm=difference_cm,
        sd_cm=question.sd_cm,
        measured=measured.people if measured else None,
        correlation=paired,
        cluster=cluster,
        icc=icc,
        alpha=alpha,
        power=power,
        per_group=needed.per_group,
        people=needed.per_group * (1 if paired is not None else 2),
        clusters_per_group=needed.clusters_per_group,
        design_effect=question.design_effect,
        power_reached=needed.power_reached,
    )
    if as_json:
        print_json(answer)
    else:
        show(*_told(answer))


def _measured(
    sd_cm: float | None, file: Path | None, column: str | None, by: str | None
) -> MeasuredSpread | None:
    """The spread that a table has, where none is stated."""
    from comity.study.measured_spread import measured_spread
    from comity_fis import InputError, Where

    if (sd_cm is None) == (file is None):
        raise InputError(
            expected="the spread between people, stated or measured",
            got="neither" if file is None else "both",
            remedy="Write --sd-cm 35, or --from FILE.csv --column NAME.",
            where=Where("--sd-cm"),
        )
    if file is None:
        return None
    if column is None:
        raise InputError(
            expected="a column of the table",
            got="none",
            remedy="Add --column, such as --column distance_m.",
            where=Where("--column"),
        )
    return measured_spread(file, column, by)


def _told(answer: StudyPowerAnswer) -> Iterator[str]:
    spread = f"{answer.sd_cm:.1f} cm"
    source = "stated" if answer.measured is None else f"measured with {answer.measured} people"
    if answer.correlation is None:
        yield f"{answer.per_group} people a group, {answer.people} in all"
    else:
        yield f"{answer.people} people, each of whom meets both conditions"
    if answer.clusters_per_group is not None:
        of = "" if answer.correlation is not None else " a group"
        yield (
            f"  {answer.clusters_per_group} clusters of {answer.cluster}{of}; "
            f"they count for less by the design effect {answer.design_effect:.2f}"
        )
    yield f"  A difference of {answer.difference_cm:g} cm at a spread of {spread} ({source})"
    if answer.correlation is not None:
        yield f"  One person's two values correlate by {answer.correlation:g}"
    yield (
        f"  Two-sided t-test at {answer.alpha:g}: the difference is found with probability "
        f"{answer.power_reached:.3f}"
    )
