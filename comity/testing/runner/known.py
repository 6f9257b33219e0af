"""Tests that passed before and cannot come out otherwise now: known by all that they depend on.

An episode follows from what the case reads, the seed and the code, on one platform. After a rule was edited,
whoever's parameters are as before need not be visited again. Failures are looked at anew.
"""

from __future__ import annotations

import hashlib
import shutil
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import TypeAdapter

from comity.episode import fingerprint
from comity.system.installed_code import installed_code
from comity.system.own_files import read_regular
from comity.testing.expectation import compares
from comity.testing.golden.content import content_of, digest_of
from comity.testing.golden.place import place_of
from comity.testing.judging.among import Among
from comity.testing.judging.measured import Measured
from comity.testing.runner.kept import KeptValues, cache_folder
from comity.testing.trials.case import Across

if TYPE_CHECKING:
    from comity.testing.collection.cases import Claim
    from comity.testing.trials.case import Case

OLD_S = 30 * 86_400.0


@dataclass(frozen=True, slots=True)
class Passed:
    """A test that passed."""

    measured: Measured | None
    """None for a comparison of profiles."""


_FORM = TypeAdapter(Passed)


@dataclass(frozen=True, slots=True)
class Known:
    """Tests that passed, each by the digest of all that it depends on.

    Args:
        folder: Of this code on this platform.
    """

    folder: Path

    @classmethod
    def of_this_machine(cls) -> Known:
        """In the user's cache folder, or where `COMITY_CACHE` says."""
        return cls(cache_folder() / "passed" / _code())

    def recall(self, key: str) -> Passed | None:
        """What is known of a test that passed; None where nothing is."""
        return KeptValues(self.folder, _FORM).recall(key)

    def keep(self, key: str, measured: Measured | None) -> None:
        """Note that a test passed."""
        if not self.folder.is_dir():
            self._make_room()
        KeptValues(self.folder, _FORM).keep(key, Passed(measured))

    def _make_room(self) -> None:
        """What is of other code, and was not used for a month, goes."""
        with suppress(OSError):
            for other in self.folder.parent.iterdir():
                if time.time() - other.stat().st_mtime > OLD_S:
                    shutil.rmtree(other, ignore_errors=True)


def key_of(claim: Claim) -> str:
    """A digest of all that a test depends on, but the code.

    Raises:
        InputError: if anything that the case names cannot be used.
    """
    digest = hashlib.sha256(claim.id.encode())
    for one in claim.expectations:
        digest.update(f"{one.where} {one.text}\n".encode())
    for part in _depends_on(claim):
        digest.update(part.encode())
    return digest.hexdigest()


def _depends_on(claim: Claim) -> Iterator[str]:
    if isinstance(claim.case, Across):
        yield from map(_digest, claim.case.cases)
        among = Among(claim.case)
        for one in claim.expectations:
            if compares(one.meaning):
                yield from (digest_of(among.values(name).as_json()) for name in one.meaning.profiles)
    else:
        yield _digest(claim.case)
        yield _golden(claim.case)


@lru_cache(maxsize=256)
def _digest(case: Case) -> str:
    return digest_of([case.id, dict(content_of(case))])


def _golden(case: Case) -> str:
    """What is compared with; where it cannot be read, the test is refused and nothing is known."""
    try:
        return hashlib.sha256(read_regular(place_of(case))).hexdigest()
    except OSError as error:
        return type(error).__name__


@cache
def _code() -> str:
    return hashlib.sha256(f"{fingerprint()}{installed_code()}".encode()).hexdigest()[:16]
