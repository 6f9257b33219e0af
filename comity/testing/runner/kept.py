"""Values kept from one test run to the next, each a file by the digest of all that it follows from.

A file of its own for each, written whole, so that test processes at the same time do no harm to each other.
It begins with the digest of what follows: a file that anything has happened to is as if it were not there.
"""

from __future__ import annotations

import hashlib
import os
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import mkstemp
from typing import Generic, TypeVar

from pydantic import TypeAdapter, ValidationError

from comity.system.own_files import read_regular

T = TypeVar("T")


def cache_folder() -> Path:
    """The user's cache folder, or where `COMITY_CACHE` says."""
    from platformdirs import user_cache_path

    return Path(os.environ.get("COMITY_CACHE") or user_cache_path("comity"))


@dataclass(frozen=True, slots=True)
class KeptValues(Generic[T]):
    """A folder of values of one form.

    Args:
        folder: Where they are. What cannot be read or written is as if it were not there.
        form: What a value looks like.
    """

    folder: Path
    form: TypeAdapter[T]

    def recall(self, key: str) -> T | None:
        """The value that was kept; None where none was, or not as it was written."""
        try:
            digest, _, content = read_regular(self.folder / key).partition(b"\n")
            return self.form.validate_json(content) if digest == _digest(content) else None
        except (OSError, ValidationError):
            return None

    def keep(self, key: str, value: T) -> None:
        """Keep a value for the next time."""
        content = self.form.dump_json(value)
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True)
            handle, part = mkstemp(dir=self.folder, prefix=".")
            try:
                with os.fdopen(handle, "wb") as file:
                    file.write(_digest(content) + b"\n" + content)
                Path(part).replace(self.folder / key)
            finally:
                Path(part).unlink(missing_ok=True)  # it is another name by now, unless something went wrong


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()
