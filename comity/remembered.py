"""What meetings with the people who are kept on this machine taught: out of the store and back into it."""

from __future__ import annotations

from collections.abc import Iterable

from comity.learnt_file import LearntFile, Observation
from comity.store import Store
from comity_fis import InputError, Where


def remembered(name: str) -> LearntFile | None:
    """What meetings with a person taught; None where there were none.

    Raises:
        InputError: if the file in the store was damaged, with its line.
    """
    file = Store().learnt_file(name)
    return file.check(LearntFile) if file else None


def require_kept(name: str | None) -> str:
    """The name of somebody who is kept on this machine.

    Raises:
        InputError: if it is none.
    """
    if name is not None:
        return name
    raise InputError(
        expected="a profile that is kept on this machine",
        got="one that ships with Comity, or a file",
        remedy="Leave --keep out, or name somebody whom `comity profile set NAME ...` keeps.",
        where=Where("--keep"),
    )


def remember(name: str, seen: Iterable[Observation]) -> bool:
    """Add observations of a person to the store.

    Returns:
        Whether the person is still kept there; if not, nothing is written.

    Raises:
        InputError: if the store cannot be read or written.
    """
    known = remembered(name) or LearntFile(person=name)
    return Store().remember_learnt(name, known.also(seen).model_dump(mode="json")) is not None
