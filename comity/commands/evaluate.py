"""`comity evaluate`: a rulebook against measured tuples."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json

Radius = Annotated[float, typer.Option(min=0.01, max=2.0, metavar="M", help="Of the body, in metres.")]


def evaluate(
    rulebook: Annotated[str, typer.Argument(metavar="RULEBOOK", help="A shipped rulebook or a file.")],
    tuples: Annotated[
        str, typer.Argument(metavar="TUPLES.csv", help="Measured rows, or the shipped small-studies.")
    ] = "small-studies",
    *,
    robot_radius: Radius = 0.25,
    person_radius: Radius = 0.20,
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Draw measured and predicted values there, as a .png, .svg or .pdf file."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Evaluate a rulebook against measured (culture, parameter) tuples, study by study.

    Each row's error, each study's mean error, bias and rank correlation, beside a constant and a straight
    line that know the study's other rows; for distances, both as between surfaces and as between centres.

    Columns of the file: parameter, value, unit; study, source, measured (surface or centre), partner (robot
    or person), n, sd, note; and culture or any variable of the rulebook. For example
    `comity evaluate bruno2017 mine.csv`.
    """
    from comity.report.drawing import check_picture, write_picture
    from comity.report.rulebooks.evaluation import evaluate_answer, evaluate_text
    from comity.report.text import show, unbroken
    from comity.tables.evaluation import Radii
    from comity.tables.evaluation import evaluate as hold_against
    from comity.tables.measurements import read_measurements
    from comity_fis import load_rulebook

    check_picture(picture)
    book = load_rulebook(rulebook)
    evaluation = hold_against(book, read_measurements(tuples, book), Radii(robot_radius, person_radius))
    if picture is not None:
        from comity.report.rulebooks.evaluation_picture import evaluation_picture

        write_picture(picture, lambda: evaluation_picture(evaluation))
    if as_json:
        print_json(evaluate_answer(evaluation, (str(picture),) if picture else ()))
    else:
        show(*evaluate_text(evaluation), *([unbroken(f"\nPicture  {picture}")] if picture else []))
