"""`comity study fields`: what a report of a study should say, as far as it is known here."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json
from comity.commands.study_report import StudySource, loaded_study

if TYPE_CHECKING:
    from comity.study.fields.reported_field import ReportedField

FieldsSource = Annotated[
    Path,
    typer.Argument(
        metavar="COLLECTION.yaml|DIR", help="What people were asked, or what `comity study run` wrote."
    ),
]
FieldsSessions = Annotated[
    Path | None,
    typer.Argument(metavar="SESSIONS", help="What `comity study sessions` wrote, beside a COLLECTION."),
]
Answers = Annotated[
    Path | None,
    typer.Option("--collected", metavar="DIR", help="The answers; `collected` in SESSIONS without it."),
]
ShownClips = Annotated[
    Path | None, typer.Option("--clips", metavar="DIR", help="Films that were shown: lists their confounds.")
]
FieldsOut = Annotated[
    Path | None, typer.Option("--out", metavar="FILE.md", help="Write a new file instead of printing.")
]


def fields(
    source: FieldsSource,
    sessions: FieldsSessions = None,
    *,
    collected: Answers = None,
    clips: ShownClips = None,
    study: StudySource = None,
    out: FieldsOut = None,
    as_json: AsJson = False,
) -> None:
    """List the fields to report of a study: known ones filled in, the others marked for the lab.

    Of a study with people name COLLECTION and SESSIONS, of simulated visits the folder of the study. The file
    is yours to complete: one that is there is never written again.

    Example: comity study fields calm.collection.yaml sessions --out reporting.md
    """
    from comity.report.text import show, unbroken
    from comity.study.fields.telling import fields_answer, fields_markdown
    from comity.system.own_files import write_whole
    from comity_fis import InputError, Where

    if out is not None and out.exists():
        raise InputError(
            expected="a new file for the fields",
            got="one that is there",
            remedy="Name another: what you filled in stays.",
            where=Where(str(out)),
        )
    if source.is_dir():
        _require_alone(source, sessions=sessions, collected=collected, clips=clips)
        name, found = _of_visits(source, study)
    else:
        name, found = _of_people(source, sessions, collected, clips)
    text = fields_markdown(name, found)
    if out is not None:
        write_whole(out, text.encode(), private=True)
    answer = fields_answer(name, found, str(out) if out else None)
    if as_json:
        print_json(answer)
    elif out is None:
        print(text, end="")
    else:
        without = f", {answer.inapplicable} do not apply" if answer.inapplicable else ""
        told = f"{name}: {answer.filled} fields known, {answer.blank} for the lab{without}"
        show(told, unbroken(f"Fields  {out}"))


def _of_people(
    collection: Path, sessions: Path | None, collected: Path | None, clips: Path | None
) -> tuple[str, Sequence[ReportedField]]:
    """The name of a study with people, and its fields."""
    from comity.study.collecting.allocation_table import read_allocation
    from comity.study.collecting.collected import Collected
    from comity.study.collecting.collection_file import load_collection
    from comity.study.fields.known import KnownStudy, fields_of
    from comity_fis import InputError, Where

    asked = load_collection(collection)
    if sessions is None:
        raise InputError(
            expected="the folder of the sessions beside the collection",
            got="none",
            remedy="`comity study sessions` writes one: name it second.",
            where=Where("SESSIONS"),
        )
    folder = collected or sessions / "collected"
    known = KnownStudy(asked, read_allocation(sessions), folder, Collected.read(folder, asked.written), clips)
    return asked.written.name, fields_of(known)


def _of_visits(folder: Path, file: Path | None) -> tuple[str, Sequence[ReportedField]]:
    """The name of a study of simulated visits, and its fields."""
    from comity.study.fields.simulated import SimulatedStudy, simulated_fields
    from comity.study.report.replaying import file_of

    found = loaded_study(folder)
    simulated = SimulatedStudy.read(found, file or file_of(found))
    return simulated.plan.written.name, simulated_fields(simulated)


def _require_alone(folder: Path, **of_people: Path | None) -> None:
    """Refuse what belongs to a study with people beside the folder of simulated visits."""
    from comity_fis import InputError, Where

    for name, path in of_people.items():
        if path is not None:
            raise InputError(
                expected=f"{folder} alone, the folder of a study of simulated visits",
                got=f"{path} for {name}",
                remedy="Of a study with people name its COLLECTION.yaml first.",
                where=Where(str(folder)),
            )
