"""The profiles that a scenario is tested with: those of its matrix, or replacements."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity.people.profile import load_profile
from comity.people.store import Store
from comity.specification.matrix import PAPER
from comity.system.library import shipped
from comity.testing.trials.case import beside
from comity_fis import InputError, Where, unknown_word
from comity_fis.validation.name_or_path import looks_like_a_file

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile


@dataclass(frozen=True, slots=True)
class Tried:
    """One profile, or the scenario's own profiles."""

    load: str | None
    """A shipped or stored name, or a path relative to the current folder; None for the scenario's own."""
    called: str
    """Name that does not depend on the current folder: a shipped or stored person's name, even if given as a
    path, and otherwise the name that the file gives."""
    named: str | None
    """The profile as the user wrote it."""


def profiles_of(file: ScenarioFile, others: Sequence[str] = ()) -> tuple[Tried, ...]:
    """The profiles of a scenario's matrix, or `others` if it has a matrix of profiles.

    Raises:
        InputError: with the line, if a profile cannot be used or shares its name with another.
    """
    written = file.scenario.matrix.profiles
    if not written:
        return (Tried(None, _written(file)[1], None),)
    if others:
        return instead(others)
    names = tuple(shipped("profile")) if written == "all" else PAPER if written == "paper" else written
    places = (file.where("matrix", "profiles", i) for i in range(len(names)))
    return _apart((_load(file, name), name, where) for name, where in zip(names, places, strict=True))


def instead(names: Sequence[str]) -> tuple[Tried, ...]:
    """Profiles of the command line without duplicates; paths are relative to the current folder.

    Args:
        names: Names and paths; `paper` are the paper's four, `all` are those that ship.

    Raises:
        InputError: if a profile cannot be used or shares its name with another.
    """
    groups = {"paper": PAPER, "all": tuple(shipped("profile"))}
    each = [name for word in names for name in groups.get(word, (word,))]
    once = {_file(name): name for name in reversed(each)}
    return _apart((name, name, Where("--profile")) for name in reversed(once.values()))


def named(file: ScenarioFile, name: str, where: Where | None = None) -> str | None:
    """The profile that a sentence names: by its name in a test, or one outside the matrix.

    Args:
        file: The scenario.
        name: The word of the sentence.
        where: Position of the sentence.

    Returns:
        What to load; None for the scenario's own profiles.

    Raises:
        InputError: with the closest known name, if there is no such profile.
    """
    tried = {one.called: one.load for one in profiles_of(file)}
    if name in tried:
        return tried[name]
    if not _is_name(name) and not looks_like_a_file(name, file.folder / name):
        raise unknown_word(
            "a profile as the tests' names have it, another shipped or stored one, or a file",
            name,
            [*tried, *shipped("profile"), *Store().names],
            where=where,
        )
    load = _load(file, name)
    load_profile(load, where=where)
    return load


def different(file: ScenarioFile, names: Sequence[str], where: Where) -> None:
    """Refuse unknown profiles in a sentence, and two names of the same profile.

    Args:
        file: The scenario.
        names: The words of the sentence.
        where: Position of the sentence.

    Raises:
        InputError: with the closest known name, or with both names of the same profile.
    """
    found: dict[Path | None, str] = {}
    for name in names:
        load = named(file, name, where) or _written(file)[0]
        place = None if load is None else _file(load)
        if place in found:
            raise InputError(
                expected="two profiles",
                got=f"{name!r}, which is {found[place]!r} by another name",
                remedy="Name another one.",
                where=where,
            )
        found[place] = name


def _load(file: ScenarioFile, name: str) -> str:
    """A name unchanged, even if a file next to the scenario has the same name."""
    return name if _is_name(name) else beside(file, name)


def _apart(written: Iterable[tuple[str, str, Where]]) -> tuple[Tried, ...]:
    """Profiles without duplicates, whose names are distinct so that their tests can be told apart."""
    found: dict[str, Tried] = {}
    for load, named, where in written:
        called = _called(load, where)
        if called in found:
            raise InputError(
                expected="profiles with names of their own",
                got=f"{called!r} of {named} beside that of {found[called].named}",
                remedy="Leave one of them out, or change `name` in a file.",
                where=where,
            )
        found[called] = Tried(load, called, named)
    return tuple(found.values())


def _called(load: str, where: Where) -> str:
    profile = load_profile(load, where=where).profile
    if _is_name(load):
        return load
    known = {_file(name): name for name in (*Store().names, *shipped("profile"))}
    return known.get(_file(load), profile.name)


def _file(load: str) -> Path:
    """Canonical path of a profile's file."""
    path = shipped("profile").get(load) or Store().path(load) or load
    return Path(os.path.realpath(path))  # `Path.resolve` raises another exception for circular links


def _is_name(name: str) -> bool:
    """Whether a name is a shipped or stored person; everything else is a file."""
    return name in shipped("profile") or Store().path(name) is not None


def _written(file: ScenarioFile) -> tuple[str | None, str]:
    """Profile and name of the first person with the matrix's profiles; None if written in the scenario."""
    name = (file.scenario.matrix.people or (file.scenario.goals[0].person,))[0]
    profile = file.scenario.people[name].profile
    if not isinstance(profile, str):
        return None, profile.name
    load = _load(file, profile)
    return load, _called(load, file.where("people", name, "profile"))
