"""A person's settings that a rulebook defines; settings of other rulebooks are not an error."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from comity.parameters.consent import TOUCH, Wishes, asks_for_no_touch
from comity_fis import load_rulebook, shipped_rulebooks

if TYPE_CHECKING:
    from comity_fis import Rulebook


def decided_here(wishes: Wishes, rulebook: Rulebook) -> tuple[dict[str, float | str], tuple[str, ...]]:
    """The settings that a rulebook defines, and a note for each that only another shipped one could grant.

    A request not to be touched has its effect everywhere, and needs no note. A name that no shipped rulebook
    knows is most likely a typo, and is left for the rulebook to reject.

    Args:
        wishes: The declared settings.
        rulebook: The rulebook.
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
