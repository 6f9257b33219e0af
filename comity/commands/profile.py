"""`comity profile set | reset | export | delete`: what is kept of people on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from comity.commands.options import (
    AsJson,
    JudgingRulebookName,
    KeptName,
    With,
    pairs,
    print_json,
    require_terminal,
)
from comity_fis.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from comity.people.profile import Profile
    from comity.sharing.export import Export
    from comity.sharing.extra import Extra
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
    pseudonym: Annotated[
        str | None,
        typer.Option(metavar="WORD", help="Under this name; age bands, days since the first, no free text."),
    ] = None,
    with_: With = [],  # noqa: B006  (Typer copies it)
    as_json: AsJson = False,
) -> None:
    """Hand out what is kept of a person, as a profile file with what was learnt as comments.

    Only the note `about` never leaves the store; `comity profile show` shows it. With --pseudonym the file
    can be passed on as a run of `comity share` can, culture and gender only where --with asks for them.
    """
    from comity.people.consents import consents_of, lapse
    from comity.people.store import EXPORT_MARK, Store
    from comity.system.own_files import refuse_foreign, write_whole

    if pseudonym is None and with_:
        raise _with_alone()
    lapse(name)
    store = Store()
    under = None if pseudonym is None else _under(pseudonym, name, with_)
    text = store.exported(name) if under is None else under.text
    if out is not None:
        refuse_foreign({out: EXPORT_MARK.encode()})
        write_whole(out, text.encode(), private=True)
    if as_json:
        agreed = consents_of(name)
        kept = {
            "name": name,
            "profile": _kept(name),
            "learnt": store.learnt(name),
            "consents": agreed.model_dump(mode="json")["consents"] if agreed else [],
        }
        print_json(kept if under is None else under.as_json())
    elif out is None:
        print(text, end="")
    else:
        what = "but for the note `about`" if under is None else f"under the name {pseudonym}"
        print(f"What is kept of {name} stands in {out}, {what}")


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


def _with_alone() -> InputError:
    return InputError(
        expected="--pseudonym WORD",
        got="--with without it",
        remedy="Leave --with out: without a pseudonym all is handed out.",
    )


def _under(pseudonym: str, name: str, extras: Collection[Extra]) -> Export:
    """What is kept of somebody, as it may be passed on."""
    from comity.people.profile import day_for, load_profile
    from comity.people.remembered import remembered
    from comity.people.store import Store
    from comity.sharing.export import Export
    from comity.sharing.person import Filter, plain_words
    from comity_fis import load_rulebook, shipped_rulebooks

    Store().require(name)
    words = plain_words(*map(load_rulebook, shipped_rulebooks()))
    profile = load_profile(name).profile
    learnt = remembered(name)
    return Export.of(
        Filter(frozenset(extras), words),
        pseudonym,
        profile,
        day_for(None, profile),
        learnt.conversational_distance if learnt else (),
    )


def _kept(name: str) -> Mapping[str, Any] | None:
    """The document of somebody who is kept, without the note; None where only something learnt is."""
    from comity.adaptation.editing import kept_document
    from comity.people.store import Store, without_note

    file = Store().declared(name)
    return None if file is None else without_note(kept_document(name, file))
