"""The command line: which commands there are, and what an error looks like there."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

import comity.system.garbage
import comity.system.threads  # noqa: F401  (before numpy is imported)
from comity.commands import (
    audit,
    convert,
    draw,
    evaluate,
    explain,
    figures,
    fit,
    infer,
    learn,
    lists,
    metrics,
    paper,
    plan,
    profile,
    profile_ask,
    profile_consent,
    profile_observe,
    profile_show,
    replay,
    run,
    schema,
    share,
    study,
    study_clips,
    study_collect,
    study_fields,
    study_power,
    study_report,
    study_score,
    study_sessions,
    test,
    trace,
    visits,
)
from comity.commands.blank import Command
from comity.system.streams import drop, is_full, take_any_text
from comity_fis.errors import ComityError, InputError

Run = Callable[..., None]


def _written(command: Run) -> Run:
    """The command, with what it printed written before it ends: where there is no room, that is told."""

    @wraps(command)
    def write(*words: Any, **options: Any) -> None:
        try:
            command(*words, **options)
        finally:
            sys.stdout.flush()

    return write


def _tell_version(asked: bool) -> None:
    from importlib.metadata import version

    if asked:
        print(f"comity {version('comity')}")
        raise typer.Exit()


WIDEST = 120
"""Columns of the help on a terminal that has as many: no summary of a command is cut there."""

app = typer.Typer(
    name="comity",
    help="Culture-aware behaviour for social robots, explained to the centimetre.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"max_content_width": WIDEST, "help_option_names": ["-h", "--help"]},
    rich_markup_mode=None,
    epilog="Start with `comity run`. Exit codes: 0 done, 1 something was not reached, 2 bad input.",
)


@app.callback()
def _comity(
    *,
    version: Annotated[
        bool,
        typer.Option("--version", help="Say which version this is.", callback=_tell_version, is_eager=True),
    ] = False,
) -> None:
    pass


for command in (
    run.run,
    infer.infer,
    explain.explain,
    plan.plan,
    trace.trace,
    replay.replay,
    share.share,
    metrics.metrics,
    lists.profiles,
    lists.rulebooks,
    lists.scenarios,
    lists.maps,
    draw.draw,
    convert.convert,
    schema.schema,
    fit.fit,
    figures.figures,
    paper.paper,
    evaluate.evaluate,
    learn.learn,
    audit.audit,
    visits.visits,
    test.test,
):
    app.command(cls=Command)(_written(command))
kept = typer.Typer(
    name="profile",
    help="Keep what people declare and ask for, on this machine only; show, change and delete it.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
about_people: tuple[Run, ...] = (
    profile_show.show,
    profile_consent.consent,
    profile.set_,
    profile_ask.ask,
    profile_observe.observe,
    profile.reset,
    profile.export,
    profile.delete,
)
for about_person in about_people:
    kept.command(about_person.__name__.rstrip("_"), cls=Command)(_written(about_person))
app.add_typer(kept)
studies = typer.Typer(
    name="study",
    help="Run the same visits for many people, rulebooks and settings, as one table.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
of_studies: tuple[Run, ...] = (
    study.plan,
    study.run,
    study_report.report,
    study_report.compare,
    study_report.show,
    study_power.power,
    study_sessions.sessions,
    study_clips.clips,
    study_collect.collect,
    study_score.questionnaire,
    study_score.score,
    study_fields.fields,
)
for of_study in of_studies:
    studies.command(of_study.__name__, cls=Command)(_written(of_study))
app.add_typer(studies)


def main() -> None:
    """Run the command line; bad input ends with 2, whatever else went wrong on purpose with 1."""
    take_any_text()
    try:
        _written(app)()
    except ComityError as error:
        _end(str(error), 2 if isinstance(error, InputError) else 1)
    except OSError as error:
        if not _is_somewhere():
            _end("expected a current folder, got one that was removed. Change to another.", 2)
        if error.filename is not None:
            # A path that the system itself refuses, such as one that is too long.
            path = str(error.filename)[:80]
            _end(f"{path}: expected a usable path, got {error.strerror}. Check the path.", 2)
        if not is_full(error):
            raise
        _end(
            f"the output could not be written: expected room for it, got {error.strerror}. "
            "Make room, or have it written elsewhere.",
            2,
        )


def _end(message: str, code: int) -> NoReturn:
    """Say why on standard error, if it takes that, and end."""
    try:
        print(f"comity: {message}", file=sys.stderr)
    except OSError:
        drop(sys.stderr)
    sys.exit(code)


def _is_somewhere() -> bool:
    """Whether the current folder is still there."""
    try:
        Path.cwd()
    except FileNotFoundError:
        return False
    return True
