"""One person of a population: the same individual meets every condition of a study."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from comity.scenario import ComfortSpec

WHOLE = frozenset({"birth_year", "education"})
"""Facts that a profile has as whole numbers."""


@dataclass(frozen=True, slots=True)
class Individual:
    """What an individual declares, and the comfort that the robot is not told."""

    name: str
    """A pseudonym, which no other individual of the population has."""
    group: str
    """Empty where it belongs to none."""
    profile: Mapping[str, Any]
    """As in a profile's file."""
    comfort: ComfortSpec | None
    line: int | None = None
    """Of its row in a table; None where it was drawn."""

    def as_plain(self) -> dict[str, Any]:
        """The same as plain values, for a digest or another process."""
        comfort = self.comfort and self.comfort.model_dump(mode="json")
        return {"name": self.name, "group": self.group, "profile": dict(self.profile), "comfort": comfort}


def plain_fact(key: str, fact: float | str) -> float | int | str:
    """A fact as a profile takes it: whole where its key asks for that and it is."""
    if key in WHOLE and isinstance(fact, float) and fact.is_integer():
        return int(fact)
    return fact
