"""Reads and writes what was learnt in encounters with people in the store."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from comity.people.adulthood import require_adult
from comity.people.consents import is_covered, lapse, require_consent
from comity.people.learnt_file import Learning, LearntFile, Observation, Stated
from comity.people.profile import load_profile
from comity.people.store import Store, advising
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity_fis.validation.yaml_file import YamlFile


def remembered(name: str) -> LearntFile | None:
    """What was learnt about a person; None without encounters or without consent.

    Raises:
        InputError: The stored file is damaged; with the line.
    """
    lapse(name)
    file = Store().learnt_file(name)
    return _checked(name, file) if file else None


def require_kept(name: str | None) -> str:
    """Name of a stored adult who consents to learning.

    Raises:
        InputError: The person is not one.
    """
    if name is not None:
        require_consent(name, "learn")
        require_adult(load_profile(name).profile)
        return name
    raise InputError(
        expected="a profile that is kept on this machine",
        got="one that ships with Comity, or a file",
        remedy="Leave --keep out, or name somebody whom `comity profile set NAME ...` keeps.",
        where=Where("--keep"),
    )


def remember(name: str, seen: Iterable[Learning]) -> bool:
    """Add observations of a person to the store; safe for concurrent runs.

    Returns:
        Whether the person is still stored and consents; if not, nothing is written.

    Raises:
        InputError: The store cannot be read or written.
    """
    return is_covered(name, "learn") and _change(name, lambda known: known.also(seen))


def write_down(name: str, seen: Iterable[Observation]) -> None:
    """Add an observer's observations of a person as one entry that can be undone.

    Raises:
        InputError: The person does not consent, or the store cannot be read or written.
    """
    require_consent(name, "learn")
    _change(name, lambda known: known.with_entry(seen))


def undo(name: str) -> tuple[Observation, ...]:
    """Remove the entry written down last for a person.

    Returns:
        Its observations; empty if nothing is left to undo.

    Raises:
        InputError: The store cannot be read or written.
    """
    undone: list[Observation] = []

    def without(known: LearntFile) -> LearntFile:
        undone.extend(one.model_copy(update={"entry": None}) for one in known.last_entry)
        return known.without_last_entry()

    _change(name, without)
    return tuple(undone)


def remember_answer(name: str, stated: Stated) -> bool:
    """Add a person's answer; it replaces an earlier answer of the same day.

    Returns:
        Whether the person is still stored and consents; if not, nothing is written.

    Raises:
        InputError: The store cannot be read or written.
    """
    if not is_covered(name, "learn"):
        return False
    return _change(name, lambda known: known.without_answers(stated.situation, stated.day).also([stated]))


def forget_answers(name: str, situation: Mapping[str, object]) -> bool:
    """Remove all answers of a person in a situation.

    Returns:
        Whether the person is still stored; if not, nothing is written.

    Raises:
        InputError: The store cannot be read or written.
    """
    return _change(name, lambda known: known.without_answers(situation))


def _change(name: str, change: Callable[[LearntFile], LearntFile]) -> bool:
    def changed(file: YamlFile | None) -> Mapping[str, object] | None:
        known = change(_checked(name, file) if file else LearntFile(person=name))
        return known.model_dump(mode="json", exclude_none=True) if known.conversational_distance else None

    return Store().change_learnt(name, changed)


def _checked(name: str, file: YamlFile) -> LearntFile:
    with advising(name):
        return file.check(LearntFile)
