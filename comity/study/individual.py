"""One person of a population: the same individual meets every condition of a study."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from comity.scenario import ComfortSpec

WHOLE = frozenset({"birth_year", "education"})
"""Facts that are whole numbers in a profile."""


@dataclass(frozen=True, slots=True)
class Individual:
    """An individual's declared facts, and comfort distances unknown to the robot."""

    name: str
    """A pseudonym, unique in the population."""
    group: str
    """Name of the group; empty without one."""
    profile: Mapping[str, Any]
    """Content of a profile file."""
    comfort: ComfortSpec | None
    line: int | None = None
    """Line in the table; None if drawn."""

    def as_plain(self) -> dict[str, Any]:
        """Plain values, for a digest or another process."""
        comfort = self.comfort and self.comfort.model_dump(mode="json")
        return {"name": self.name, "group": self.group, "profile": dict(self.profile), "comfort": comfort}


def plain_fact(key: str, fact: float | str) -> float | int | str:
    """A fact in a profile's type: an integer if its key requires one and the value is whole."""
    if key in WHOLE and isinstance(fact, float) and fact.is_integer():
        return int(fact)
    return fact
