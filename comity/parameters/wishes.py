"""What a person asked for, of which a rulebook may know only some: nobody is refused for the rest."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from comity.parameters.consent import TOUCH, Wishes, asks_for_no_touch
from comity_fis import load_rulebook, shipped_rulebooks

if TYPE_CHECKING:
    from comity_fis import Rulebook


def decided_here(wishes: Wishes, rulebook: Rulebook) -> tuple[dict[str, float | str], tuple[str, ...]]:
    """The wishes that a rulebook judges, and a note for each that only another shipped one could grant.

    That a person asked for no touch has its effect everywhere, and needs no note. A name
    that no shipped rulebook knows is most likely a slip, and stays for the rulebook to refuse.

    Args:
        wishes: As declared.
        rulebook: The rules.
    """
    strange = [name for name in wishes if name not in rulebook.parameters]
    elsewhere = [name for name in strange if name in _shipped_parameters()]
    notes = tuple(
        f"{name} {wishes[name]}: the rules of {rulebook.name} decide nothing about it, so that the wish "
        "has no effect here."
        for name in elsewhere
        if name != TOUCH or not asks_for_no_touch(wishes, rulebook)
    )
    return {name: wish for name, wish in wishes.items() if name not in elsewhere}, notes


@cache
def _shipped_parameters() -> frozenset[str]:
    return frozenset(name for book in map(load_rulebook, shipped_rulebooks()) for name in book.parameters)
