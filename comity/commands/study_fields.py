"""`comity study fields`: what a report of a study with people should say, as far as it is known here."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json
from comity.commands.study_collect import CollectionName, SessionsFolder

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
    collection: CollectionName,
    sessions: SessionsFolder,
    *,
    collected: Answers = None,
    clips: ShownClips = None,
    out: FieldsOut = None,
    as_json: AsJson = False,
) -> None:
    """List the fields to report of a study with people: known ones filled in, the others marked for the lab.

    The file is yours to complete: one that is there is never written again.

    Example: comity study fields calm.collection.yaml sessions --out reporting.md
    """
    from comity.report.text import show, unbroken
    from comity.study.collecting.allocation_table import read_allocation
    from comity.study.collecting.collected import Collected
    from comity.study.collecting.collection_file import load_collection
    from comity.study.fields.known import KnownStudy, fields_of
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
    asked = load_collection(collection)
    folder = collected or sessions / "collected"
    known = KnownStudy(asked, read_allocation(sessions), folder, Collected.read(folder, asked.written), clips)
    found, name = fields_of(known), asked.written.name
    text = fields_markdown(name, found)
    if out is not None:
        write_whole(out, text.encode(), private=True)
    answer = fields_answer(name, found, str(out) if out else None)
    if as_json:
        print_json(answer)
    elif out is None:
        print(text, end="")
    else:
        show(f"{name}: {answer.filled} fields known, {answer.blank} for the lab", unbroken(f"Fields  {out}"))
