"""`comity learn`: rules, or a prior, from a table of examples."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from comity.commands.evaluate import Radius
from comity.commands.options import AsJson, RulebookName, print_json
from comity_fis.listing import listed

Table = Annotated[str, typer.Argument(metavar="TABLE.csv", help="Rows as `comity evaluate` reads them.")]
ParameterName = Annotated[
    str, typer.Option("--parameter", metavar="P", help="To learn about; of rows that name none, too.")
]
InputNames = Annotated[
    list[str],
    typer.Option("--inputs", metavar="VARIABLE[,...]", help="That rules may read; what tells of a person."),
]
LeftOutName = Annotated[
    Literal["participant", "study"] | None,
    typer.Option(help="What is left out as one; a participant, else a study, else a row."),
]
Out = Annotated[Path | None, typer.Option(metavar="FILE.yaml", help="Write a rulebook there, if any stands.")]
Write = Annotated[
    Literal["rules", "prior"] | None,
    typer.Option(help="Write this one, even where what is simpler predicts as well."),
]


def learn(
    table: Table,
    *,
    parameter: ParameterName,
    inputs: InputNames = [],  # noqa: B006 - typer copies it
    rulebook: RulebookName = "evidence",
    leave_out: LeftOutName = None,
    out: Out = None,
    write: Write = None,
    robot_radius: Radius = 0.25,
    person_radius: Radius = 0.20,
    as_json: AsJson = False,
) -> None:
    """Propose rules, and a prior where rows name their participants, and judge both.

    Rules use the terms that the rulebook has. Each proposal predicts participants, or studies, that it has
    not seen, beside a constant, the rulebook `evidence`, a straight line, and asking the person once.

    Exit code 1: what is simpler predicts as well, and nothing is written unless `--write` asks for it. For
    example `comity learn people.csv --parameter conversational_distance --out learnt.yaml`.
    """
    from comity.output.learnt_rulebook import MARK, write_learnt
    from comity.report.rulebooks.learning import learn_answer, learn_text
    from comity.report.text import show, unbroken
    from comity.system.own_files import refuse_foreign
    from comity.tables.evaluation import Radii
    from comity.tables.lesson import learn as taught
    from comity_fis import InputError, Where, load_rulebook

    if write is not None and out is None:
        raise InputError(
            expected="a file to write to",
            got="none",
            remedy="Add --out FILE.yaml.",
            where=Where("--write"),
        )
    if out is not None:
        refuse_foreign({out: MARK})
    lesson = taught(
        table,
        parameter,
        load_rulebook(rulebook),
        inputs=[name.strip() for words in inputs for name in words.split(",")],
        left_out=leave_out,
        radii=Radii(robot_radius, person_radius),
    )
    if write is not None and write not in lesson.proposals:
        raise InputError(
            expected=listed(lesson.proposals, "or") or "nothing, as the table proposes nothing",
            got=write,
            remedy="A prior needs a column `participant`, a rule three rows of one kind.",
            where=Where("--write"),
        )
    kind = (write or lesson.standing) if out is not None else None
    if kind is not None and out is not None:
        write_learnt(lesson, kind, out)
    if as_json:
        print_json(learn_answer(lesson, kind, (str(out),) if kind else ()))
    else:
        show(*learn_text(lesson), *([unbroken(f"\nWrote {out}: the {kind}")] if kind else []))
    raise typer.Exit(0 if kind or lesson.standing else 1)
