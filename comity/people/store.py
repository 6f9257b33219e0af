"""The store of profiles and learnt data: on this machine only, as readable files.

    $COMITY_HOME/people/<name>/profile.yaml     what the person declared and asked for
    $COMITY_HOME/people/<name>/learnt.yaml      what meetings with them taught
    $COMITY_HOME/people/<name>/consent.yaml     what they agreed to

`COMITY_HOME` defaults to the platform's folder for user data. Only the user may read the files, and deleting
a person deletes everything about them.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from comity.system import library
from comity.system.private_files import alone_in, permitted, replace_whole
from comity_fis import InputError, closest
from comity_fis.validation.yaml_file import YamlFile, dump_yaml, read_yaml

PROFILE, LEARNT, CONSENT = "profile.yaml", "learnt.yaml", "consent.yaml"
EXPORTED = "# Exported by Comity: everything that is kept of a person, but for the note `about`."
"""First line of an export."""
EXPORT_MARK = "# Exported by Comity: everything that is kept of a person"
"""Beginning of any version's export, which marks a file as safe to overwrite."""
NOTE_STAYS = "The note `about` stays in the store: `comity profile show` shows it there."
_FOLDER_VARIABLES = ("XDG_DATA_HOME", "HOME", "USERPROFILE", "LOCALAPPDATA", "WIN_PD_OVERRIDE_LOCAL_APPDATA")
"""Environment variables on which the platform's folder may depend."""
Document = Mapping[str, Any]
"""Content of a YAML file."""
NAME = re.compile(r"\w[\w-]{0,63}")
"""Letters of any script, digits, `_` and `-`: a valid folder name on every platform, and never a path."""


def default_home() -> Path:
    """Folder of the store: `COMITY_HOME`, or the platform's folder for user data."""
    if home := os.environ.get("COMITY_HOME"):
        return Path(home)
    return _users_folder(*map(os.environ.get, _FOLDER_VARIABLES))


@lru_cache(maxsize=1)
def _users_folder(*variables: str | None) -> Path:
    """The platform's folder for user data, cached while these variables do not change."""
    from platformdirs import user_data_path

    return user_data_path("comity", appauthor=False)


@dataclass(frozen=True, slots=True)
class Store:
    """The people stored on this machine; nothing is created before something is stored."""

    home: Path = field(default_factory=default_home)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all stored people, in alphabetical order."""
        folders = self._people.iterdir() if self._people.is_dir() else ()
        return tuple(sorted(folder.name for folder in folders if self.keeps(folder.name)))

    def keeps(self, name: str) -> bool:
        """Whether anything is stored about a person."""
        return (
            isinstance(name, str)
            and bool(NAME.fullmatch(name))
            and any((self._folder(name) / file).is_file() for file in (PROFILE, LEARNT, CONSENT))
        )

    def path(self, name: str) -> Path | None:
        """Path of a stored person's profile; None if there is no such person."""
        path = self._folder(name) / PROFILE
        return path if NAME.fullmatch(name) and path.is_file() else None

    def change_profile(self, name: str, change: Callable[[YamlFile | None], Document]) -> Path:
        """Change the stored profile of a person, under a lock.

        Args:
            name: Name of the person; a new person is stored from now on.
            change: Maps the stored file (None for a new person) to the new document.

        Raises:
            InputError: The name cannot be stored, `change` refuses (then nothing is written), or the system
                prevents writing.
        """
        refuse_name(name)
        with alone_in(self._people):
            path = self.path(name)
            document = change(None if path is None else read_yaml(path))
            if path is None:
                self._forget(name, LEARNT)  # left over from another person of that name
            return self._write(name, PROFILE, document)

    def learnt(self, name: str) -> Mapping[str, Any] | None:
        """What was learnt about a person; None if nothing was.

        Raises:
            InputError: The file is damaged.
        """
        file = self.learnt_file(name)
        return None if file is None else file.data

    def learnt_file(self, name: str) -> YamlFile | None:
        """The same as a file with line numbers, for validation."""
        path = self._folder(name) / LEARNT
        with advising(name):
            return read_yaml(path) if NAME.fullmatch(name) and path.is_file() else None

    def change_learnt(self, name: str, change: Callable[[YamlFile | None], Document | None]) -> bool:
        """Change what was learnt about a person, under a lock.

        Args:
            name: Name of the person.
            change: Maps the stored file (None if nothing was learnt yet) to the new document, or None if
                nothing is left.

        Returns:
            Whether the person is still stored; if not, nothing is written.

        Raises:
            InputError: The name cannot be stored, or the system prevents writing.
        """
        refuse_name(name)
        with alone_in(self._people):
            if self.path(name) is None:  # a run that learns must not restore a deleted person
                return False
            document = change(self.learnt_file(name))
            if document is not None:
                self._write(name, LEARNT, document)
            else:
                self._forget(name, LEARNT)
            return True

    def consent_file(self, name: str) -> YamlFile | None:
        """A person's consents as a file with line numbers; None if none were ever recorded."""
        path = self._folder(name) / CONSENT
        return read_yaml(path) if NAME.fullmatch(name) and path.is_file() else None

    def change_consent(self, name: str, change: Callable[[YamlFile | None], Document]) -> YamlFile:
        """Change a person's consents under a lock, and store a profile for them, possibly an empty one.

        Args:
            name: Name of the person; a new person is stored from now on.
            change: Maps the stored file (None for a new person) to the new document.

        Returns:
            The file as stored now.

        Raises:
            InputError: The name cannot be stored, `change` refuses (then nothing is written), or the system
                prevents writing.
        """
        refuse_name(name)
        with alone_in(self._people):
            document = change(self.consent_file(name))
            if self.path(name) is None:
                self._forget(name, LEARNT)  # left over from another person of that name
                self._write(name, PROFILE, {"schema_version": 1, "name": name})
            return read_yaml(self._write(name, CONSENT, document))

    def withhold_touch(self, name: str) -> bool:
        """Record that a person does not consent to touch; returns whether this changed the profile."""
        with alone_in(self._people):
            path = self.path(name)
            document = dict(read_yaml(path).data) if path else {}
            if document.get("touch_consent") in (None, "withheld"):
                return False
            self._write(name, PROFILE, {**document, "touch_consent": "withheld"})
            return True

    def forget_learnt(self, name: str) -> bool:
        """Delete what was learnt about a person, even if damaged; returns whether there was anything."""
        path = self._folder(name) / LEARNT
        with alone_in(self._people), permitted(path):
            if not (NAME.fullmatch(name) and path.is_file()):
                return False
            path.unlink()
            return True

    def exported(self, name: str) -> str:
        """A stored person's data without `about`: a usable profile file, with learnt data as comments.

        Comments that a person wrote into the files are not exported either.

        Raises:
            InputError: No person of that name is stored.
        """
        declared = self.declared(name)
        profile = dump_yaml(without_note(declared.data), inline=True) if declared else ""
        learnt, consents = self.learnt(name), self.consent_file(name)
        lines = [
            *(["", NOTE_STAYS] if declared and "about" in declared.data else []),
            *(["", "What was learnt with them:", *_lines(learnt)] if learnt is not None else []),
            *(["", "What they agreed to:", *_lines(consents.data)] if consents else []),
        ]
        comments = "".join(f"# {line}".rstrip() + "\n" for line in lines)
        return f"{EXPORTED}\n{profile}{comments}"

    def declared(self, name: str) -> YamlFile | None:
        """The file of a person's declared profile; None if only learnt data are stored.

        Raises:
            InputError: No person of that name is stored, or the file is not YAML.
        """
        path = self.require(name) / PROFILE
        return read_yaml(path) if path.is_file() else None

    def delete(self, name: str) -> None:
        """Delete a person's data completely.

        Raises:
            InputError: No person of that name is stored, or the system prevents deletion.
        """
        with alone_in(self._people):
            self.require(name)
            self._clear(name)

    def require(self, name: str) -> Path:
        """The folder of a stored person.

        Raises:
            InputError: Nothing is stored about them.
        """
        if not self.keeps(name):
            kept = f" {closest(str(name), self.names)}" if self.names else ""
            called = name if isinstance(name, str) and NAME.fullmatch(name) else "NAME"
            raise InputError(
                expected="the name of somebody who is kept here",
                got=repr(name),
                remedy=f"`comity profile set {called} ...` keeps them.{kept}",
            )
        return self._folder(name)

    def _folder(self, name: str) -> Path:
        return self._people / name

    @property
    def _people(self) -> Path:
        return self.home / "people"

    def _forget(self, name: str, file: str) -> None:
        with permitted(self._folder(name)):
            (self._folder(name) / file).unlink(missing_ok=True)

    def _clear(self, name: str) -> None:
        with permitted(self._folder(name)):
            if self._folder(name).is_dir():
                shutil.rmtree(self._folder(name))

    def _write(self, name: str, file: str, document: Mapping[str, Any]) -> Path:
        """Write a file atomically: concurrent readers see the old or the new one."""
        folder = self._folder(name)
        with permitted(folder / file):
            new = not folder.exists()
            for place in (self._people, folder):
                place.mkdir(parents=True, exist_ok=True, mode=0o700)
            try:
                replace_whole(folder / file, dump_yaml(document, inline=True))
            except BaseException:
                if new:
                    shutil.rmtree(folder, ignore_errors=True)
                raise
        return folder / file


def without_note(document: Document) -> Document:
    """A profile's document without the note `about`, which never leaves the store."""
    return {key: value for key, value in document.items() if key != "about"}


def _lines(document: Document) -> list[str]:
    return dump_yaml(document, inline=True).splitlines()


@contextmanager
def advising(name: str) -> Iterator[None]:
    """Add advice to an error about damaged learnt data: how to continue without them."""
    try:
        yield
    except InputError as error:
        raise InputError(
            expected=error.expected,
            got=error.got,
            remedy=f"{error.remedy} Or let `comity profile reset {name} distance` forget what was learnt.",
            where=error.where,
        ) from None


def refuse_name(name: str) -> None:
    """Reject a name that is not a valid folder name everywhere, or that ships with Comity.

    Raises:
        InputError: With an example of a valid name.
    """
    if not NAME.fullmatch(name):
        raise InputError(
            expected="a name of up to 64 letters, digits, `_` and `-`",
            got=repr(name),
            remedy="Choose another; what the person is called in full can stand in `about`.",
        )
    if name in library.shipped("profile"):
        raise InputError(
            expected="a name of its own for somebody who is kept here",
            got=f"{name!r}, a profile that ships with Comity and stays as it is",
            remedy=f"Choose another, for example my_{name}.",
        )
