"""Writes rules learnt from a table to a rulebook file, checked by reading it back."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from comity.system.own_files import write_whole
from comity.tables.contenders import CONSTANT
from comity.tables.lesson import Kind, Lesson
from comity_fis import InputError, Source, Where, load_rulebook
from comity_fis.rulebook.models import LONGEST_NAME
from comity_fis.rulebook.writer import FIRST_LINE, rulebook_yaml
from comity_fis.validation.yaml_file import parse_yaml

MARK = FIRST_LINE.encode()
"""First bytes that mark a file as safe to overwrite."""
COMMAND = "comity learn"
DIGITS = 16
"""Length of the table's digest in hexadecimal digits, enough to identify the table."""


def write_learnt(lesson: Lesson, kind: Kind, out: Path) -> None:
    """Write the rulebook with the learnt rules atomically.

    Raises:
        InputError: It could not be read from there, for example because a score table is elsewhere.
    """
    table = " ".join(Path(lesson.examples.file).name.split())
    learnt = replace(
        lesson.learnt(kind, source_of(lesson, kind)),
        name=f"{lesson.rulebook.name.removesuffix('-learnt')}-learnt",
        description=f"{lesson.rulebook.description} With {kind} about {lesson.examples.parameter.name} that "
        f"`{COMMAND}` took from {table}.",
    )
    text = rulebook_yaml(learnt, table, COMMAND)
    try:
        load_rulebook(parse_yaml(text, out, str(out)))
    except InputError as error:
        raise InputError(
            expected="a place from which the rulebook can be read",
            got=f"one where it finds no {error.expected.removeprefix('a ')}",
            remedy=f"Write it beside {lesson.rulebook.name}, which names files beside itself.",
            where=Where(str(out)),
        ) from None
    write_whole(out, text.encode())


def source_of(lesson: Lesson, kind: Kind) -> Source:
    """The table as a source, with the evaluation of the rules learnt from it."""
    found, path = lesson.examples, Path(lesson.examples.file)
    judged = lesson.judgement
    against = judged.differences[kind][CONSTANT]
    error = judged.errors[kind].mean_absolute_error
    unit = "" if found.parameter.unit == "1" else f" {found.parameter.unit}"
    interval = "" if against.low is None else f" (95 % {against.low:+.4f} to {against.high:+.4f})"
    named = f"; {'; '.join(found.sources)}" if found.sources else ""
    return Source(
        key=re.sub(r"[^\w.-]+", "-", f"{path.stem}-{found.parameter.name}")[-LONGEST_NAME:].strip("-"),
        citation=f"The table {path.name} (SHA-256 {lesson.digest[:DIGITS]}){named}",
        verified=f"Leaving one {judged.left_out} out: mean absolute error {error:.4f}{unit}, "
        f"{against.difference:+.4f}{unit} against a constant{interval}",
        found=f"{kind.capitalize()} of {found.parameter.name}",
        measured=f"{len(found.rows)} rows of {found.people} people, {found.studies} studies",
    )
