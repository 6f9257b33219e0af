"""From what a person declared to the parameters of the robot's actions."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from typing import TYPE_CHECKING

from comity_domain import refuse_gesture_in_words
from comity_fis import InputError, Interval, closest, score

if TYPE_CHECKING:
    from comity.profile import Declared, Profile
    from comity_fis import Inference, Rulebook, Variable

Fact = float | str | Interval | None
"""None where it is not disclosed."""

Facts = Mapping[str, Fact]
"""By variable."""


def infer_for(
    declared: Declared, rulebook: Rulebook, *, situation: Facts | None = None, mode: str = "exact"
) -> Inference:
    """One person's parameters in one situation.

    Args:
        declared: What the person declared.
        rulebook: The rules.
        situation: What holds here and now, by variable; it goes before the profile.
        mode: How the centre of area is computed: exact, matlab or skfuzzy.

    Raises:
        InputError: for a fact outside its variable's domain, or a setting that cannot be granted; with the
            line of the profile where it is the profile's.
    """
    _check(declared, rulebook)
    known: dict[str, Fact] = {**declared.profile.facts(), **(situation or {})}
    inputs = {
        name: value
        for name, variable in rulebook.variables.items()
        if (value := _value(variable, known)) is not None
    }
    rulebook.checked_inputs(inputs)  # before the wishes, whose place in the file is another
    with _placing(declared, "settings"):
        return rulebook.infer(inputs, settings=declared.profile.settings, mode=mode)


def refuse_unknown(facts: Facts, rulebook: Rulebook, place: str) -> None:
    """Refuse a fact that no variable of the rulebook is named after: it is most likely a slip of the pen."""
    for name in facts:
        if name not in rulebook.variables:
            raise InputError(
                expected=f"a variable of the rulebook {rulebook.name} in {place}",
                got=repr(name),
                remedy=closest(name, rulebook.variables),
            )


def _check(declared: Declared, rulebook: Rulebook) -> None:
    """Look at every fact and wish by itself, so that a complaint can name its line."""
    profile = declared.profile
    for name in profile.other:
        with _placing(declared, "other", name):
            refuse_unknown({name: None}, rulebook, "`other`")
    for name, variable in rulebook.variables.items():
        with _placing(declared, *_location(variable, profile)):
            rulebook.checked_inputs({name: _value(variable, profile.facts())})
    for name, wish in profile.settings.items():
        with _placing(declared, "settings", name):
            rulebook.checked_settings({name: wish})
    with _placing(declared, "settings", "greeting_gesture"):
        refuse_gesture_in_words(profile.settings)


def _value(variable: Variable, known: Facts) -> Fact:
    """What is known of a variable: the fact of its name, or one that it is derived from."""
    if variable.name in known or variable.derived_from is None:
        return known.get(variable.name)
    fact = known.get(variable.derived_from.fact)
    table = variable.derived_from.table
    return score(str(fact), table) if table and fact is not None else fact


def _location(variable: Variable, profile: Profile) -> tuple[str, ...]:
    """Where a profile says what a variable is."""
    if variable.name in profile.other:
        return ("other", variable.name)
    derived = variable.derived_from is not None and variable.name not in profile.facts()
    return (variable.derived_from.fact,) if derived and variable.derived_from else (variable.name,)


def _placing(declared: Declared, *location: str) -> AbstractContextManager[None]:
    return declared.file.placing(*location) if declared.file else nullcontext()
