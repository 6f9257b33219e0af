"""`comity profile observe`: what an observer saw and heard at real meetings."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, At, day, pairs, print_json
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from collections.abc import Mapping

    from comity.adaptation.observing import ObservedSignal
    from comity.people.learnt_file import Observation
    from comity_fis import ParameterValue, Rulebook


def observe(
    name: Annotated[str | None, typer.Argument(help="Of somebody who is kept here and agreed to it.")] = None,
    *,
    signal: Annotated[
        str | None,
        typer.Option(
            help="Seen: stepped_back, turned_away, leaned_in, showed_nothing; "
            "said: asked_farther, asked_closer."
        ),
    ] = None,
    distance: Annotated[
        str | None,
        typer.Option(metavar="METRES", help="Where the robot stood, between the bodies: 0.8 or '80 cm'."),
    ] = None,
    situation: Annotated[
        list[str] | None,
        typer.Option(
            metavar="VARIABLE=VALUE", help="What held then; without it the person's usual situation."
        ),
    ] = None,
    table: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.csv", help="Many: columns name, signal, distance_m, date, posture and so on."
        ),
    ] = None,
    undo: Annotated[bool, typer.Option("--undo", help="Forget what was written down last of NAME.")] = False,
    at: At = None,
    rulebook: Annotated[
        str, typer.Option(metavar="R", help="It says what culture and situation alone gave.")
    ] = "evidence",
    as_json: AsJson = False,
) -> None:
    """Write down how people took a robot's coming at real meetings; needs their consent to learn.

    It is weighed as what a robot notices itself. A table is written down whole or not at all. --undo takes
    back what the last such command wrote down of NAME, and again what the one before did.

    For example: comity profile observe amal --signal stepped_back --distance 0.8 --situation posture=seated
    """
    from comity.adaptation.observations_table import read_sights
    from comity.adaptation.observers_words import situation_told
    from comity.adaptation.observing import observe as write_down
    from comity.people.remembered import undo as take_back
    from comity.people.store import Store
    from comity.report.people.observing import observe_answer, observe_text
    from comity.report.text import show
    from comity_fis import load_rulebook

    book = load_rulebook(rulebook)
    _check(name, signal, distance, table, undo=undo)
    observed: list[tuple[str, Observation]] = []
    undone: list[tuple[str, Observation]] = []
    if undo and name is not None:
        Store().require(name)
        undone = [(name, one) for one in take_back(name)]
        if not undone:
            raise _nothing_left(name)
    else:
        if table is not None:
            sights = read_sights(table, book, name=name, day=day(at))
        else:
            told = pairs(situation or [], "--situation", "posture=seated")
            held = situation_told(told, book, Where("--situation"))
            sights = (_sight(name or "", signal or "", distance, held, at),)
        names = [sight.name for sight in sights]
        observed = list(zip(names, write_down(sights, book), strict=True))
    answer = observe_answer(observed, undone, _values([*observed, *undone], book))
    if as_json:
        print_json(answer)
    else:
        show(*observe_text(answer))


def _sight(
    name: str, signal: str, distance: str | None, situation: Mapping[str, float | str], at: str | None
) -> ObservedSignal:
    from comity.adaptation.observers_words import distance as metres
    from comity.adaptation.observers_words import signal_in_words
    from comity.adaptation.observing import ObservedSignal

    return ObservedSignal(
        name=name,
        signal=signal_in_words(signal, Where("--signal")),
        distance_m=metres(distance, Where("--distance")),
        day=day(at),
        situation=situation,
    )


def _values(rows: list[tuple[str, Observation]], book: Rulebook) -> dict[str, ParameterValue]:
    """How near each of these people is met from now on, in the situation of their last row."""
    from datetime import date

    from comity.parameters.acquaintance import met_at
    from comity.people.profile import load_profile

    return {
        name: met_at(load_profile(name), book, seen.situation, date.today())
        for name, seen in dict(rows).items()
    }


def _check(
    name: str | None, signal: str | None, distance: str | None, table: Path | None, *, undo: bool
) -> None:
    """Refuse words that do not belong together."""
    one = signal is not None or distance is not None
    if (undo or one or table is None) and name is None:
        raise _refusal("NAME", "none", "Name the person, or a table with --table.")
    if undo and (one or table is not None):
        raise _refusal("--undo alone", "something to write down beside it", "Give one of the two.")
    if table is not None and one:
        raise _refusal("--table alone", "--signal or --distance beside it", "Give one of the two.")
    if not undo and table is None and (signal is None or distance is None):
        missing = "--signal" if signal is None else "--distance"
        raise _refusal("--signal and --distance", f"no {missing}", "Say what was seen, and where.")


def _refusal(expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy, where=Where("profile observe"))


def _nothing_left(name: str) -> InputError:
    return InputError(
        expected=f"something that was written down of {name}",
        got="nothing",
        remedy=f"What runs saw, `comity profile reset {name} distance` forgets.",
        where=Where("--undo"),
    )
