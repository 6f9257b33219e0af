"""What meetings with the people who are kept on this machine taught: out of the store and back into it."""

from __future__ import annotations

from collections.abc import Iterable

from comity.learnt_file import LearntFile, Observation
from comity.store import Store


def remembered(name: str) -> LearntFile | None:
    """What meetings with a person taught; None where there were none.

    Raises:
        InputError: if the file in the store was damaged, with its line.
    """
    file = Store().learnt_file(name)
    return file.check(LearntFile) if file else None


def remember(name: str, seen: Iterable[Observation]) -> bool:
    """Add observations of a person to the store.

    Returns:
        Whether the person is still kept there; if not, nothing is written.

    Raises:
        InputError: if the store cannot be read or written.
    """
    known = remembered(name) or LearntFile(person=name)
    return Store().remember_learnt(name, known.also(seen).model_dump(mode="json")) is not None
