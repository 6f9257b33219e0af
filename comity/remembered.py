"""Whose meetings are remembered, and where: in the store, under the name of the profile."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from pydantic import ValidationError

from comity import library
from comity.learnt_file import LearntFile, Observation
from comity.store import Store
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.profile import Profile


def remembered_as(named: str, profile: Profile) -> str | None:
    """The name in the store under which meetings are remembered; None for a shipped profile.

    A shipped profile describes nobody in particular: what one person taught is not true of another.
    """
    return None if named in library.shipped("profile") else profile.name


def remembered(name: str) -> LearntFile | None:
    """What meetings with a person taught; None where there were none.

    Raises:
        InputError: if the file in the store was damaged.
    """
    document = Store().learnt(name)
    if document is None:
        return None
    try:
        return LearntFile.model_validate(document)
    except ValidationError as refusal:
        first = refusal.errors()[0]
        raise InputError(
            expected=f"what was learnt with {name} as Comity wrote it",
            got=f"{first['msg'].lower()} at {'.'.join(map(str, first['loc']))}",
            remedy=f"Correct it, or forget it with `comity profile reset {name}`.",
            where=Where("learnt.yaml"),
        ) from None


def remember(name: str, seen: Iterable[Observation]) -> None:
    """Add observations of a person to the store."""
    known = remembered(name) or LearntFile(person=name)
    Store().remember_learnt(name, known.also(seen).model_dump(mode="json"))
