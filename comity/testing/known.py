"""Tests that passed before and cannot come out otherwise now: known by all that they depend on.

An episode follows from the scenario, the people's parameters, the seed and the code, on one platform. After a
rule was edited, whoever's parameters are as before need not be visited again. Failures are looked at anew.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import cache, lru_cache
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING, Any

from comity.cast import cast_of, rulebook_of
from comity.episode import fingerprint
from comity.testing.case import Across
from comity.testing.golden import place_of
from comity.testing.measured import Measured
from comity.testing.safety import Danger

if TYPE_CHECKING:
    from comity.testing.case import Case
    from comity.testing.cases import Claim

_PACKAGES = ("comity", "comity_domain", "comity_executor", "comity_fis", "comity_sim2d")
_NO_CODE = ("profiles", "scenarios", "rulebooks")
"""What these hold counts where a test depends on it, and only there."""

OLD_S = 30 * 86_400.0


@dataclass(frozen=True, slots=True)
class Known:
    """Tests that passed, each a file by the digest of all that it depends on.

    Args:
        folder: Of this code on this platform. What cannot be read or written is as if it were not there.
    """

    folder: Path

    @classmethod
    def of_this_machine(cls) -> Known:
        """In the user's cache folder, or where `COMITY_CACHE` says."""
        from platformdirs import user_cache_path

        root = os.environ.get("COMITY_CACHE") or user_cache_path("comity")
        return cls(Path(root) / "passed" / _code())

    def recall(self, key: str) -> tuple[bool, Measured | None]:
        """Whether the test passed, and what was measured then."""
        try:
            found = json.loads((self.folder / key).read_text(encoding="utf-8"))
            return True, _measured(found) if found else None
        except (OSError, ValueError, TypeError, KeyError):
            return False, None

    def keep(self, key: str, measured: Measured | None) -> None:
        """Note that a test passed."""
        try:
            self._make_room()
            with NamedTemporaryFile("w", dir=self.folder, prefix=".", delete=False, encoding="utf-8") as part:
                json.dump(asdict(measured) if measured else None, part)
            Path(part.name).replace(self.folder / key)
        except OSError:
            return

    def _make_room(self) -> None:
        """A folder for this code; those of other code that nobody has used for a month go."""
        if self.folder.is_dir():
            return
        self.folder.mkdir(parents=True, exist_ok=True)
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
    for case in claim.case.cases if isinstance(claim.case, Across) else (claim.case,):
        digest.update(_digest(case))
    return digest.hexdigest()


@lru_cache(maxsize=256)
def _digest(case: Case) -> bytes:
    digest = hashlib.sha256()
    for part in _depends_on(case):
        digest.update(json.dumps(part, sort_keys=True, default=str).encode())
    return digest.digest()


def _depends_on(case: Case) -> Iterator[Any]:
    yield case.id
    yield case.file.file.data
    yield {name: part for name, part in rulebook_of(case.file, case.rulebook).data.items() if name != "rules"}
    cast = cast_of(case.file, profiles=case.profiles, rulebook=case.rulebook, at=case.day)
    yield {person: inference.as_json() for person, inference in cast.values().items()}
    golden = place_of(case)
    yield golden.read_text(encoding="utf-8") if golden.is_file() else None


@cache
def _code() -> str:
    from importlib.util import find_spec

    digest = hashlib.sha256(fingerprint().encode())
    for package in _PACKAGES:
        spec = find_spec(package)
        assert spec is not None
        assert spec.origin is not None
        root = Path(spec.origin).parent
        for path in sorted(root.rglob("*")):
            inside = path.relative_to(root).parts
            if path.suffix in (".py", ".yaml", ".pddl", ".csv") and inside[0] not in _NO_CODE:
                digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _measured(found: dict[str, Any]) -> Measured:
    distances = {name: (pair[0], pair[1]) for name, pair in found.pop("distances_m").items()}
    dangers = tuple(
        Danger(danger["limit"], danger["got"], tuple(danger["because"])) for danger in found.pop("dangers")
    )
    return Measured(distances_m=distances, dangers=dangers, order=tuple(found.pop("order")), **found)
