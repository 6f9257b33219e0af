"""Options that several commands share, and how their words are read."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from comity.sharing.extra import Extra
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from datetime import date
    from pathlib import Path

    from comity_fis.record import Record


def _scenarios(begun: str) -> list[str]:
    from comity.system.library import shipped

    return [name for name in shipped("scenario") if name.startswith(begun)]


def _profiles(begun: str) -> list[str]:
    from comity.people.store import Store
    from comity.system.library import shipped

    return [name for name in (*shipped("profile"), *Store().names) if name.startswith(begun)]


def _rulebooks(begun: str) -> list[str]:
    from comity_fis import shipped_rulebooks

    return [name for name in shipped_rulebooks() if name.startswith(begun)]


AsJson = Annotated[bool, typer.Option("--json", help="Print exactly one JSON object.")]
RulebookName = Annotated[
    str,
    typer.Option("--rulebook", metavar="R", help="A shipped rulebook or a file.", autocompletion=_rulebooks),
]
PersonsRulebookName = Annotated[
    str | None,
    typer.Option(
        "--rulebook",
        metavar="R",
        help="A shipped one or a file; without it evidence for a stored profile, else bruno2017.",
        autocompletion=_rulebooks,
    ),
]
OptionalRulebookName = Annotated[
    str | None,
    typer.Option(
        "--rulebook", metavar="R", help="Another rulebook than the scenario's.", autocompletion=_rulebooks
    ),
]
JudgingRulebookName = Annotated[
    str | None, typer.Option("--rulebook", metavar="R", help="Judge facts and wishes by this one.")
]
KeptName = Annotated[str, typer.Argument(help="Of somebody who is kept here.")]
EngineName = Annotated[
    str,
    typer.Option("--engine", metavar="NAME", help="Who plans: comity, or an engine of unified-planning."),
]
ScenarioName = Annotated[str, typer.Argument(help="A shipped scenario or a file.", autocompletion=_scenarios)]
OptionalScenarioName = Annotated[
    str | None, typer.Argument(help="A shipped scenario or a file.", autocompletion=_scenarios)
]
OptionalProfileName = Annotated[
    str | None, typer.Argument(help="A shipped or stored profile, or a file.", autocompletion=_profiles)
]
As = Annotated[
    list[str],
    typer.Option("--as", metavar="PERSON=PROFILE", help="Give a person of the scenario another profile."),
]
Seed = Annotated[
    int, typer.Option(min=0, help="For random places and the noise of sensors, where there are any.")
]
At = Annotated[
    str | None,
    typer.Option(
        "--at",
        metavar="DATE",
        help="Take dated facts as of this day (YYYY-MM-DD, or a year); today without it.",
    ),
]
With = Annotated[
    list[Extra],
    typer.Option("--with", help="Pass this on, too; more than once for both. Only where the people agreed."),
]
Set = Annotated[
    list[str], typer.Option("--set", metavar="VARIABLE=VALUE", help="State a fact; `unknown` takes one back.")
]


def day(words: str | None) -> date | None:
    """The day of `--at`.

    Raises:
        InputError: if it is none.
    """
    from comity.people.dated import day_in_words

    return None if words is None else day_in_words(words, Where("--at"))


def pairs(words: Iterable[str], option: str, example: str) -> dict[str, str]:
    """`NAME=VALUE` words as a mapping.

    Raises:
        InputError: for a word without `=`, without a name or a value, or a name given twice.
    """
    found: dict[str, str] = {}
    for word in words:
        name, equals, value = (part.strip() for part in word.partition("="))
        if not (name and equals and value):
            raise InputError(
                expected=f"{option} NAME=VALUE",
                got=repr(word),
                remedy=f"Write for example {option} {example}.",
                where=Where(option),
            )
        if name in found:
            raise InputError(
                expected="each name once",
                got=f"{name!r} twice",
                remedy="Keep one of them.",
                where=Where(option),
            )
        found[name] = value
    return found


def require_terminal(command: str, option: str) -> None:
    """Refuse to wait for an answer where nobody can give one.

    Args:
        command: That wants to ask.
        option: That brings the answer along.

    Raises:
        InputError: where there is no terminal.
    """
    if not sys.stdin.isatty():
        raise InputError(
            expected="somebody at a terminal to answer",
            got="none",
            remedy=f"Add {option}.",
            where=Where(command),
        )


def print_json(answer: Record | dict[str, Any]) -> None:
    """The one JSON object of a `--json` answer; escaped where standard output cannot write all of it."""
    import json

    from comity_fis.record import plain

    content = plain(answer)
    text = json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False)
    try:
        text.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        text = json.dumps(content, indent=2, allow_nan=False)
    print(text)


def open_page(page: Path) -> None:
    """Show a page in the browser."""
    import webbrowser

    webbrowser.open(page.resolve().as_uri())
