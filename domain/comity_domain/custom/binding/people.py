"""The people of a problem, with their inferred parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_fis import Inference, Rulebook


@dataclass(frozen=True, slots=True)
class BoundPeople:
    """The people of a problem, inferred with one rulebook; people not named have no profile."""

    known: Mapping[str, Inference]
    """Inferences by the object's name as the files write it; case-insensitive."""
    rulebook: Rulebook
    anybody: Inference = field(init=False, repr=False)
    """Inference for a person without a profile."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "anybody", self.rulebook.infer({}))

    def __getitem__(self, written: str) -> Inference:
        wanted = written.lower()
        return next((one for name, one in self.known.items() if name.lower() == wanted), self.anybody)
