"""From what a person declared to the parameters of the robot's actions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from comity_fis import InputError, Interval, closest, score

if TYPE_CHECKING:
    from comity.profile import Profile
    from comity_fis import Inference, Rulebook

Fact = float | str | Interval | None
"""None where it is not disclosed."""

Facts = Mapping[str, Fact]
"""By variable."""


def infer_for(
    profile: Profile, rulebook: Rulebook, *, situation: Facts | None = None, mode: str = "exact"
) -> Inference:
    """One person's parameters in one situation.

    Args:
        profile: What the person declared.
        rulebook: The rules.
        situation: What holds here and now, by variable; it goes before the profile.
        mode: How the centre of area is computed: exact, matlab or skfuzzy.

    Raises:
        InputError: for a fact outside its variable's domain, or a setting that cannot be granted.
    """
    known: dict[str, Fact] = {**profile.facts(), **(situation or {})}
    refuse_unknown(profile.other, rulebook, f"`other` of the profile {profile.name}")
    return rulebook.infer(_inputs(known, rulebook), settings=profile.settings, mode=mode)


def refuse_unknown(facts: Facts, rulebook: Rulebook, place: str) -> None:
    """Refuse a fact that no variable of the rulebook is named after: it is most likely a slip of the pen."""
    for name in facts:
        if name not in rulebook.variables:
            raise InputError(
                expected=f"a variable of the rulebook {rulebook.name} in {place}",
                got=repr(name),
                remedy=closest(name, rulebook.variables),
            )


def _inputs(known: Facts, rulebook: Rulebook) -> dict[str, Fact]:
    """The rulebook's variables as far as they are known; facts that it never reads stay aside."""
    inputs: dict[str, Fact] = {}
    for variable in rulebook.variables.values():
        if variable.name in known:
            inputs[variable.name] = known[variable.name]
        elif variable.derived_from is not None and variable.derived_from.fact in known:
            inputs[variable.name] = score(str(known[variable.derived_from.fact]), variable.derived_from.table)
    return inputs
