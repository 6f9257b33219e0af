"""What meetings with the people who are kept on this machine taught: out of the store and back into it."""

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
    """What meetings with a person taught; None where there were none, or they agree to it no more.

    Raises:
        InputError: if the file in the store was damaged, with its line.
    """
    lapse(name)
    file = Store().learnt_file(name)
    return _checked(name, file) if file else None


def require_kept(name: str | None) -> str:
    """The name of an adult who is kept on this machine and agrees that meetings teach about them.

    Raises:
        InputError: if it is none, or they do not.
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
    """Add observations of a person to the store; two runs that learn at the same time both do.

    Returns:
        Whether the person is still kept there and agrees to it; if not, nothing is written.

    Raises:
        InputError: if the store cannot be read or written.
    """
    return is_covered(name, "learn") and _change(name, lambda known: known.also(seen))


def write_down(name: str, seen: Iterable[Observation]) -> None:
    """Add what an observer saw and heard of a person, all at once, so that it can be undone at once.

    Raises:
        InputError: if the person did not agree to it, or the store cannot be read or written.
    """
    require_consent(name, "learn")
    _change(name, lambda known: known.with_entry(seen))


def undo(name: str) -> tuple[Observation, ...]:
    """Forget what was written down last of a person.

    Returns:
        What that was; empty where nothing is left to undo.

    Raises:
        InputError: if the store cannot be read or written.
    """
    undone: list[Observation] = []

    def without(known: LearntFile) -> LearntFile:
        undone.extend(one.model_copy(update={"entry": None}) for one in known.last_entry)
        return known.without_last_entry()

    _change(name, without)
    return tuple(undone)


def remember_answer(name: str, stated: Stated) -> bool:
    """Add what a person said; on one day the newer answer takes the place of the older.

    Returns:
        Whether the person is still kept there and agrees to it; if not, nothing is written.

    Raises:
        InputError: if the store cannot be read or written.
    """
    if not is_covered(name, "learn"):
        return False
    return _change(name, lambda known: known.without_answers(stated.situation, stated.day).also([stated]))


def forget_answers(name: str, situation: Mapping[str, object]) -> bool:
    """Forget all that a person said in a situation.

    Returns:
        Whether the person is still kept there; if not, nothing is written.

    Raises:
        InputError: if the store cannot be read or written.
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
