"""`comity profile consent`: what a person agreed to, and what goes when they take it back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, day, print_json
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from comity.people.consents import Scope


def consent(
    name: Annotated[str, typer.Argument(help="Of the person.")],
    scopes: Annotated[
        list[str] | None,
        typer.Argument(metavar="SCOPE ...", help="remember, learn, record or touch; none shows all."),
    ] = None,
    *,
    by: Annotated[str | None, typer.Option("--by", metavar="WHO", help="Who records it.")] = None,
    at: Annotated[
        str | None, typer.Option(metavar="DATE", help="When they said so; today without it.")
    ] = None,
    until: Annotated[
        str | None, typer.Option(metavar="DATE", help="The first day on which it holds no more.")
    ] = None,
    withdraw: Annotated[
        bool, typer.Option("--withdraw", help="They agree no more: delete what it covered.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Record what a person agreed to, or that they take it back; without it nothing of them is kept.

    remember: their profile. learn: what they show and say at meetings. record: runs with them. touch: that
    the profile says so; a robot still asks at the meeting. Taking back remember, or everything, forgets the
    person.

    For example: comity profile consent amal remember learn --by Kim --until 2027-12-01
    """
    from comity.people.consents import consents_of, give, lapse
    from comity.people.consents import withdraw as take_back
    from comity.people.dated import day_in_words
    from comity.people.store import Store

    asked = _scopes(scopes or [])
    _check(asked, by, until, withdraw=withdraw)
    deleted: tuple[str, ...] = ()
    if withdraw:
        deleted = take_back(name, asked, day(at))
    elif asked and by is not None:
        end = None if until is None else day_in_words(until, Where("--until"))
        give(name, asked, by=by, day=day(at), until=end)
    else:
        deleted = lapse(name)
        Store().require(name)
    known = consents_of(name)
    if as_json:
        rows = known.model_dump(mode="json")["consents"] if known else []
        print_json({"name": name, "consents": rows, "deleted": deleted})
    else:
        _show(name, deleted)
        if withdraw and (not asked or {"remember", "record"} & set(asked)):
            print(f"Runs that hold them are yours to delete: `comity profile delete {name}` finds them.")
            if Store().keeps(name):
                print(f"It asks first: answer no, and delete the runs it names; yes forgets {name}, too.")


def _show(name: str, deleted: tuple[str, ...]) -> None:
    from datetime import date

    from comity.people.consents import consents_of
    from comity.people.store import Store
    from comity.report.text import show, table

    if deleted:
        print(f"Deleted: {', '.join(deleted)}.")
    known = consents_of(name)
    if known is not None:
        show(f"{name} agreed to", table([(one.scope, one.in_words(date.today())) for one in known.consents]))
    elif Store().keeps(name):
        print(f"{name} is kept, and no consent is recorded.")


def _scopes(words: list[str]) -> list[Scope]:
    from comity.people.consents import SCOPES
    from comity_fis import unknown_word

    for word in words:
        if word not in SCOPES:
            raise unknown_word(
                f"{', '.join(SCOPES[:-1])} or {SCOPES[-1]}", word, SCOPES, where=Where("profile consent")
            )
    return [scope for scope in SCOPES if scope in words]


def _check(scopes: list[Scope], by: str | None, until: str | None, *, withdraw: bool) -> None:
    """Refuse words that do not belong together."""
    if withdraw and (by is not None or until is not None):
        raise InputError(
            expected="--withdraw alone, with --at",
            got="--by or --until beside it",
            remedy="Leave these out.",
            where=Where("profile consent"),
        )
    if not withdraw and scopes and by is None:
        raise InputError(
            expected="who records it",
            got="nobody",
            remedy="Add --by and the name of whoever asked the person.",
            where=Where("profile consent"),
        )
    if not scopes and (by is not None or until is not None):
        raise InputError(
            expected="what they agreed to",
            got="nothing",
            remedy="Name at least one of remember, learn, record and touch.",
            where=Where("profile consent"),
        )
