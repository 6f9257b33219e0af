"""`comity profile set | reset | export | delete`: what is kept of people on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from comity.commands.options import (
    AsJson,
    JudgingRulebookName,
    KeptName,
    pairs,
    print_json,
    require_terminal,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from comity.people.profile import Profile
    from comity_fis import Rulebook


def set_(
    name: Annotated[str, typer.Argument(help="Whom to keep, or to change.")],
    words: Annotated[
        list[str], typer.Argument(metavar="KEY=VALUE ...", help="Facts and wishes; `unknown` takes one back.")
    ],
    rulebook: JudgingRulebookName = None,
) -> None:
    """Keep facts and wishes of a person; whatever cannot be granted is refused, and nothing is changed.

    What the rules make nothing of, such as a country without a score, is kept and gets a note.

    For example: comity profile set amal culture='{Egypt: 1, SWE: 2}' birth_year=1954 distance=0.9
    """
    from comity.adaptation.editing import books, keep_edited
    from comity.people.store import Store, refuse_name
    from comity.report.text import show

    refuse_name(name)
    judges = books(rulebook)
    profile = keep_edited(name, pairs(words, "profile set", "age=71"), judges)
    print(f"{name} is kept in {Store().path(name)}")
    show(*(f"Note: {note}" for note in _notes(profile, judges.first)))


def reset(
    name: KeptName,
    parameter: Annotated[
        str | None, typer.Argument(help="Only this one; everything asked for and learnt without it.")
    ] = None,
) -> None:
    """Forget what a person asked for and what was learnt with them: back to what the rules say."""
    from comity.adaptation.resetting import reset as back_to_the_rules

    forgotten = back_to_the_rules(name, parameter)
    print(f"Forgotten: {', '.join(forgotten) or 'nothing, there was nothing'}.")


def export(
    name: KeptName,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write it there; what is not ours stays.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Hand out what is kept of a person, as a profile file with what was learnt as comments.

    Only the note `about` never leaves the store; `comity profile show` shows it.
    """
    from comity.people.store import EXPORT_MARK, Store
    from comity.system.own_files import refuse_foreign, write_whole

    store = Store()
    text = store.exported(name)
    if out is not None:
        refuse_foreign({out: EXPORT_MARK.encode()})
        write_whole(out, text.encode(), private=True)
    if as_json:
        print_json({"name": name, "profile": _kept(name), "learnt": store.learnt(name)})
    elif out is None:
        print(text, end="")
    else:
        print(f"What is kept of {name} stands in {out}, but for the note `about`")


def delete(
    name: KeptName,
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask.")] = False,
) -> None:
    """Delete everything that is kept of a person."""
    from comity.people.store import Store

    store = Store()
    folder = store.require(name)
    if not yes:
        require_terminal("profile delete", "--yes")
        if not typer.confirm(f"Delete {folder} and everything in it?"):
            print("Nothing is deleted.")
            return
    store.delete(name)
    print(
        f"Nothing of {name} is kept any more. Run folders hold the profiles they ran with: those are yours "
        "to delete."
    )


def _notes(profile: Profile, rulebook: Rulebook) -> tuple[str, ...]:
    """What the rules make nothing of, each once."""
    from comity.parameters.values import cases_of
    from comity.people.profile import Declared, day_for

    cases = cases_of(Declared(profile, None), rulebook, at=day_for(None, profile))
    return tuple(dict.fromkeys(note for case in cases for note in case.notes))


def _kept(name: str) -> Mapping[str, Any] | None:
    """The document of somebody who is kept, without the note; None where only something learnt is."""
    from comity.adaptation.editing import kept_document
    from comity.people.store import Store, without_note

    file = Store().declared(name)
    return None if file is None else without_note(kept_document(name, file))
