"""Orders of visits that were found before, kept by what they depend on.

After a rule was edited, whatever does not hang on it is planned already. A file of its own for each order,
written whole, so that test processes at the same time do no harm to each other.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from tempfile import NamedTemporaryFile

from comity_domain import Order
from comity_domain.tour import Stop

MOST = 20_000
"""Files kept; beyond it the folder is emptied: an order is found again in a tenth of a second."""


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
        from platformdirs import user_cache_path

        root = os.environ.get("COMITY_CACHE") or user_cache_path("comity")
        return cls(Path(root) / "orders" / _planner())

    def recall(self, key: str) -> Order | None:
        """The order that was kept; None where none was."""
        try:
            found = json.loads((self.folder / key).read_text(encoding="utf-8"))
            stops = tuple(Stop(**stop) for stop in found.pop("stops"))
            return Order(stops=stops, **found)
        except (OSError, ValueError, TypeError, KeyError, AttributeError):
            return None

    def keep(self, key: str, order: Order) -> None:
        """Keep an order for the next time."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._make_room()
            with NamedTemporaryFile("w", dir=self.folder, prefix=".", delete=False, encoding="utf-8") as part:
                json.dump(asdict(order), part)
            Path(part.name).replace(self.folder / key)
        except OSError:
            return

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
    for path in sorted(Path(comity_domain.__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
