"""Where people's profiles, and what was learnt with them, are kept: on this machine only, as readable files.

    $COMITY_HOME/people/<name>/profile.yaml     what the person declared and asked for
    $COMITY_HOME/people/<name>/learnt.yaml      what meetings with them taught
    $COMITY_HOME/people/<name>/consent.yaml     what they agreed to

`COMITY_HOME` is the platform's folder for a user's data unless it is set. Only the user may read the files,
and deleting a person leaves nothing of them.
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
"""The first line of an export."""
EXPORT_MARK = "# Exported by Comity: everything that is kept of a person"
"""How each export began, by which a later one knows what it may replace."""
NOTE_STAYS = "The note `about` stays in the store: `comity profile show` shows it there."
_FOLDER_VARIABLES = ("XDG_DATA_HOME", "HOME", "USERPROFILE", "LOCALAPPDATA", "WIN_PD_OVERRIDE_LOCAL_APPDATA")
"""What the platform's folder may depend on."""
Document = Mapping[str, Any]
"""What a file holds, as YAML has it."""
NAME = re.compile(r"\w[\w-]{0,63}")
"""Letters of any script, digits, `_` and `-`: a folder's name everywhere, and never a path."""


def default_home() -> Path:
    """Where the store is: `COMITY_HOME`, or the platform's folder for a user's data."""
    if home := os.environ.get("COMITY_HOME"):
        return Path(home)
    return _users_folder(*map(os.environ.get, _FOLDER_VARIABLES))


@lru_cache(maxsize=1)
def _users_folder(*variables: str | None) -> Path:
    """The platform's folder for a user's data: asked for once, as long as these variables stay the same."""
    from platformdirs import user_data_path

    return user_data_path("comity", appauthor=False)


@dataclass(frozen=True, slots=True)
class Store:
    """The people that this machine keeps; nothing is created before something is remembered."""

    home: Path = field(default_factory=default_home)

    @property
    def names(self) -> tuple[str, ...]:
        """Everybody of whom something is kept, in alphabetical order."""
        folders = self._people.iterdir() if self._people.is_dir() else ()
        return tuple(sorted(folder.name for folder in folders if self.keeps(folder.name)))

    def keeps(self, name: str) -> bool:
        """Whether anything is kept of a person."""
        return (
            isinstance(name, str)
            and bool(NAME.fullmatch(name))
            and any((self._folder(name) / file).is_file() for file in (PROFILE, LEARNT, CONSENT))
        )

    def path(self, name: str) -> Path | None:
        """The profile of a person who is kept; None where nobody of that name is."""
        path = self._folder(name) / PROFILE
        return path if NAME.fullmatch(name) and path.is_file() else None

    def change_profile(self, name: str, change: Callable[[YamlFile | None], Document]) -> Path:
        """Keep another profile of a person than before; nobody else changes it meanwhile.

        Args:
            name: Of the person; a new person is kept from now on.
            change: From the file as it is kept, None for a new person, to the new document.

        Raises:
            InputError: for a name that cannot be kept, if `change` refuses, in which case nothing is written,
                or if the system does not let us write.
        """
        refuse_name(name)
        with alone_in(self._people):
            path = self.path(name)
            document = change(None if path is None else read_yaml(path))
            if path is None:
                self._forget(name, LEARNT)  # what was left of another person of that name
            return self._write(name, PROFILE, document)

    def learnt(self, name: str) -> Mapping[str, Any] | None:
        """What was learnt with a person; None where nothing was.

        Raises:
            InputError: if the file is damaged.
        """
        file = self.learnt_file(name)
        return None if file is None else file.data

    def learnt_file(self, name: str) -> YamlFile | None:
        """The same as a file that still knows its lines, for checks."""
        path = self._folder(name) / LEARNT
        with advising(name):
            return read_yaml(path) if NAME.fullmatch(name) and path.is_file() else None

    def change_learnt(self, name: str, change: Callable[[YamlFile | None], Document | None]) -> bool:
        """Keep something else of what was learnt with a person; nobody else changes it meanwhile.

        Args:
            name: Of the person.
            change: From the file as it is kept, None where nothing was learnt yet, to the new document; None
                where nothing is left.

        Returns:
            Whether the person is still kept here; if not, nothing is written.

        Raises:
            InputError: for a name that cannot be kept, or if the system does not let us write.
        """
        refuse_name(name)
        with alone_in(self._people):
            if self.path(name) is None:  # a run that learns does not bring back who was deleted
                return False
            document = change(self.learnt_file(name))
            if document is not None:
                self._write(name, LEARNT, document)
            else:
                self._forget(name, LEARNT)
            return True

    def consent_file(self, name: str) -> YamlFile | None:
        """What a person agreed to, as a file that knows its lines; None where nothing was ever recorded."""
        path = self._folder(name) / CONSENT
        return read_yaml(path) if NAME.fullmatch(name) and path.is_file() else None

    def change_consent(self, name: str, change: Callable[[YamlFile | None], Document]) -> YamlFile:
        """Record something else of what a person agreed to, and keep a profile of theirs, which may be empty.

        Args:
            name: Of the person; a new person is kept from now on.
            change: From the file as it is kept, None for a new person, to the new document.

        Returns:
            The file as it is kept now.

        Raises:
            InputError: for a name that cannot be kept, if `change` refuses, in which case nothing is written,
                or if the system does not let us write.
        """
        refuse_name(name)
        with alone_in(self._people):
            document = change(self.consent_file(name))
            if self.path(name) is None:
                self._forget(name, LEARNT)  # what was left of another person of that name
                self._write(name, PROFILE, {"schema_version": 1, "name": name})
            return read_yaml(self._write(name, CONSENT, document))

    def withhold_touch(self, name: str) -> bool:
        """Write that a person does not agree to be touched where it says otherwise; whether it did."""
        with alone_in(self._people):
            path = self.path(name)
            document = dict(read_yaml(path).data) if path else {}
            if document.get("touch_consent") in (None, "withheld"):
                return False
            self._write(name, PROFILE, {**document, "touch_consent": "withheld"})
            return True

    def forget_learnt(self, name: str) -> bool:
        """Forget what was learnt with a person, damaged or not; whether there was anything."""
        path = self._folder(name) / LEARNT
        with alone_in(self._people), permitted(path):
            if not (NAME.fullmatch(name) and path.is_file()):
                return False
            path.unlink()
            return True

    def exported(self, name: str) -> str:
        """What is kept of a person but for `about`: a usable profile file, with what was learnt as comments.

        Comments that a person wrote into the files stay in the store, too.

        Raises:
            InputError: if nobody of that name is kept.
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
        """The file of what a person declared; None where only something learnt is kept.

        Raises:
            InputError: if nobody of that name is kept, or the file is no YAML.
        """
        path = self.require(name) / PROFILE
        return read_yaml(path) if path.is_file() else None

    def delete(self, name: str) -> None:
        """Forget a person altogether.

        Raises:
            InputError: if nobody of that name is kept, or the system does not let us.
        """
        with alone_in(self._people):
            self.require(name)
            self._clear(name)

    def require(self, name: str) -> Path:
        """The folder of a person of whom something has to be kept.

        Raises:
            InputError: if nothing is.
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
        """Write one file whole or not at all: a reader sees the old or the new one meanwhile."""
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
    """What a person declared, without the free words about them: those never leave the store."""
    return {key: value for key, value in document.items() if key != "about"}


def _lines(document: Document) -> list[str]:
    return dump_yaml(document, inline=True).splitlines()


@contextmanager
def advising(name: str) -> Iterator[None]:
    """Add to a complaint about what was learnt with a person how to go on without it."""
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
    """Refuse a name that no folder can have everywhere, or that ships with Comity and means another person.

    Raises:
        InputError: with what would be one.
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
