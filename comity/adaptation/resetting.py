"""Resets a person to the rules: deletes their settings and what was learnt about them."""

from __future__ import annotations

from collections.abc import Mapping

from comity.adaptation.editing import FRIENDLY, Document, kept_document
from comity.people.store import Store
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, Where, closest
from comity_fis.validation.yaml_file import read_yaml

LEARNT = "what was learnt"


def reset(name: str, parameter: str | None = None) -> tuple[str, ...]:
    """Delete a person's settings and what was learnt about them; facts are kept.

    Damaged files of learnt data are deleted, too.

    Args:
        name: Name of a stored person.
        parameter: Only this parameter, by its name or everyday name; None: all.

    Returns:
        What was deleted, in words.

    Raises:
        InputError: No person of that name is stored, their profile is damaged, or there is nothing to delete.
    """
    store = Store()
    store.require(name)
    wanted = FRIENDLY.get(parameter, parameter) if parameter else None
    path = store.path(name)
    wishes = _wishes(kept_document(name, read_yaml(path))) if path else {}
    learnt = wanted in (None, DISTANCE) and store.forget_learnt(name)
    forgotten = [key for key in wishes if wanted in (None, key)]
    if wanted is not None and not forgotten and not learnt:
        raise InputError(
            expected=f"something that {name} asked for, or that was learnt",
            got=repr(parameter),
            remedy=closest(wanted, wishes) if wishes else "There is nothing to forget.",
            where=Where("profile reset"),
        )
    if forgotten:
        store.change_profile(name, lambda file: _without(kept_document(name, file), wanted))
    return (*forgotten, *([LEARNT] if learnt else []))


def _wishes(document: Mapping[str, object]) -> Document:
    wishes = document.get("settings")
    return dict(wishes) if isinstance(wishes, Mapping) else {}


def _without(document: Document, wanted: str | None) -> Document:
    """The document without one setting, or without any (None)."""
    kept = {key: wish for key, wish in _wishes(document).items() if wanted not in (None, key)}
    rest = {key: value for key, value in document.items() if key != "settings"}
    return {**rest, "settings": kept} if kept else rest
