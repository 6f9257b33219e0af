"""Parses an observer's notes of an encounter: a signal, a distance, a situation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from comity.adaptation.editing import metres
from comity.parameters.own_words import in_the_rulebooks_case
from comity.people.dated import UNKNOWN
from comity_fis import InputError, NominalVariable, Where, closest
from comity_fis.learning.signals import SIGNALS, Signal

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity_fis import Rulebook

PAST: Mapping[str, Signal] = {
    "stepped_back": "step_back",
    "asked_farther": "ask_farther",
    "turned_away": "turn_away",
    "leaned_in": "lean_in",
    "asked_closer": "ask_closer",
    "showed_nothing": "nothing",
}
"""Past-tense names of signals in an observer's notes; the names of `learnt.yaml` are accepted, too."""
FARTHEST_M = 20.0


def signal_in_words(words: str, where: Where | None = None) -> Signal:
    """Parse a signal.

    Raises:
        InputError: The words name no signal.
    """
    if isinstance(words, str):
        plain = words.strip().casefold().replace(" ", "_")
        if plain in PAST:
            return PAST[plain]
        for signal in SIGNALS:
            if plain == signal:
                return signal
    raise InputError(
        expected=f"a signal: {', '.join(PAST)}",
        got=repr(words),
        remedy=closest(str(words), PAST),
        where=where or Where("signal"),
    )


def distance(given: object, where: Where | None = None) -> float:
    """Parse a distance: 0.8, `0.8 m` or `80 cm`.

    Raises:
        InputError: It is not a distance, or one too far for an encounter.
    """
    found = metres(given.strip() if isinstance(given, str) else given)
    try:
        number = float("" if isinstance(found, bool) else found)
    except (TypeError, ValueError):
        number = -1.0
    if 0.0 <= number <= FARTHEST_M:
        return number
    raise InputError(
        expected=f"where the robot stood, between the bodies: 0 to {FARTHEST_M:g} m",
        got=repr(given),
        remedy="Write for example 0.8, or '80 cm'.",
        where=where or Where("distance"),
    )


def situation_told(
    words: Mapping[str, object], rulebook: Rulebook, where: Where | None = None
) -> dict[str, Fact]:
    """Convert a situation to variables and categories of the rulebook.

    Raises:
        InputError: A variable is not a situation variable, or a value is invalid for it.
    """
    told: dict[str, Fact] = {}
    if not isinstance(words, Mapping):
        raise InputError(
            expected="a situation as variables with their values",
            got=repr(words),
            remedy="Write for example {'posture': 'seated'}.",
            where=where or Where("situation"),
        )
    for name, fact in words.items():
        if fact == UNKNOWN:
            continue
        variable = rulebook.variables.get(name)
        if variable is None or variable.kind != "situation":
            known = [key for key, one in rulebook.variables.items() if one.kind == "situation"]
            raise InputError(
                expected="something that describes the situation",
                got=repr(name),
                remedy=f"{closest(name, known)} What a person declares is stored by `comity profile set`.",
                where=where or Where("situation"),
            )
        try:
            is_text = isinstance(fact, str) and not isinstance(variable, NominalVariable)
            value = float(str(fact)) if is_text else fact  # cells and options are text
            told[name] = variable.check(in_the_rulebooks_case(value, name, rulebook))
        except ValueError:
            raise InputError(
                expected=f"a number for {name}",
                got=repr(fact),
                remedy="Write for example 38.",
                where=where or Where("situation"),
            ) from None
        except InputError as error:
            raise error.at(where or Where("situation")) from None
    return told
