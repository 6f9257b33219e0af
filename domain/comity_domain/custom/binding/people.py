"""Whose parameters there are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_fis import Inference, Rulebook


@dataclass(frozen=True, slots=True)
class BoundPeople:
    """The people of a problem, as one rulebook sees them; of those who are not named nothing is known."""

    known: Mapping[str, Inference]
    """By the object's name, as the files have it, in any case."""
    rulebook: Rulebook
    anybody: Inference = field(init=False, repr=False)
    """A person without a profile."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "anybody", self.rulebook.infer({}))

    def __getitem__(self, written: str) -> Inference:
        wanted = written.lower()
        return next((one for name, one in self.known.items() if name.lower() == wanted), self.anybody)
