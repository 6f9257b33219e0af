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
    from collections.abc import Collection, Iterable, Mapping

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
    in_: Annotated[
        list[Path] | None,
        typer.Option("--in", metavar="DIR", help="Search here for runs and tables; runs without it."),
    ] = None,
    with_runs: Annotated[
        bool,
        typer.Option("--with-runs", help="Delete the runs that hold them, too, with all that is in these."),
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask.")] = False,
) -> None:
    """Delete everything that is kept of a person, and say which runs and tables hold them.

    Files beside runs, such as tables of a study, are named and never deleted. Runs with pseudonyms hold no
    name by which they could be found.

    For example: comity profile delete amal --in runs --in ../study
    """
    from comity.output.holding import search
    from comity.people.store import Store
    from comity.report.people.holding import holding_text
    from comity.report.text import show

    store = Store()
    default = [Path("runs")] if Path("runs").is_dir() else []
    searched = search(default if in_ is None else in_, _names_of(name))
    found = [one for each in searched for one in each.found]
    if not found or store.keeps(name):
        store.require(name)
    runs = [one.path for one in found if one.run] if with_runs else []
    if not yes:
        require_terminal("profile delete", "--yes")
        show(*holding_text(name, searched))
        what = [*([str(store.require(name))] if store.keeps(name) else []), *map(str, runs)]
        if not what or not typer.confirm(f"Delete {', '.join(what)} and everything in it?"):
            print("Nothing is deleted.")
            return
    _delete(name, runs)
    print(
        f"Nothing of {name} is kept any more."
        if not runs
        else f"Nothing of {name} is kept any more, and "
        f"{len(runs)} run{'s are' if len(runs) > 1 else ' is'} deleted."
    )
    if yes:
        show(*holding_text(name, searched, deleted=runs))


def _delete(name: str, runs: Iterable[Path]) -> None:
    from comity.output.run_folder import remove
    from comity.people.store import Store

    if Store().keeps(name):
        Store().delete(name)
    for run in runs:
        remove(run)


def _names_of(name: str) -> set[str]:
    """What a person may be called in a run: as they are kept, or as their profile says."""
    from comity.people.store import Store

    try:
        file = Store().declared(name) if Store().keeps(name) else None
    except InputError:  # a damaged profile is deleted all the same
        file = None
    said = file.data.get("name") if file is not None and isinstance(file.data, dict) else None
    return {name, said} if isinstance(said, str) and said else {name}


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
    """What is kept of a person, as it may be passed on."""
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
    """The document of a person who is kept, without the note; None where only something learnt is."""
    from comity.adaptation.editing import kept_document
    from comity.people.store import Store, without_note

    file = Store().declared(name)
    return None if file is None else without_note(kept_document(name, file))
