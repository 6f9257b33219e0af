"""Orders of visits that were found before, kept by what they depend on.

After a rule was edited, whatever does not hang on it is planned already.
"""

from __future__ import annotations

import hashlib
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from pydantic import TypeAdapter

from comity.testing.trials.kept import KeptValues, cache_folder
from comity_domain import Order

MOST = 20_000
"""Files kept; beyond it the folder is emptied: an order is found again in a tenth of a second."""
_FORM = TypeAdapter(Order)


@dataclass(frozen=True, slots=True)
class KeptOrders:
    """Orders in a folder. What cannot be read or written is as if it were not there.

    Args:
        folder: Of this version of the planner.
    """

    folder: Path

    @classmethod
    def of_this_machine(cls) -> KeptOrders:
        """In the user's cache folder, or where `COMITY_CACHE` says."""
        return cls(cache_folder() / "orders" / _planner())

    def recall(self, key: str) -> Order | None:
        """The order that was kept; None where none was."""
        return KeptValues(self.folder, _FORM).recall(key)

    def keep(self, key: str, order: Order) -> None:
        """Keep an order for the next time."""
        with suppress(OSError):
            self._make_room()
        KeptValues(self.folder, _FORM).keep(key, order)

    def _make_room(self) -> None:
        kept = list(self.folder.iterdir())
        if len(kept) >= MOST:
            for path in kept:
                path.unlink(missing_ok=True)


@cache
def _planner() -> str:
    """A digest of the code that plans: other code may find other orders."""
    import comity_domain

    digest = hashlib.sha256(_version("up-fast-downward").encode())
    for path in sorted(Path(comity_domain.__file__).parent.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
