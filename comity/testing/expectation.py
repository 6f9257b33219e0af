"""What an expectation is: one sentence of a scenario, which can be compared with what happened."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.measuring.compared_profiles import ComparedProfiles
    from comity_fis import Where


@dataclass(frozen=True, slots=True)
class Finding:
    """Something that is not as expected."""

    expected: str
    got: str
    because: Sequence[str] = ()
    """From the near cause to the far one, a line each."""
    also: Sequence[str] = ()
    """What else differs, a line each; no causes."""


class Sentence(ABC):
    """One kind of expectation: how it is written, and which people it names."""

    __slots__ = ()

    RULE: ClassVar[str]
    """What it looks like, in lark's notation."""
    EXAMPLE: ClassVar[str]
    """One sentence of the kind."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From what the grammar found: names, bounds, counts, or None for what was left out."""
        return cls(*parts)

    @property
    def people(self) -> Sequence[str]:
        """The people of the scenario that it names: its `person`, where it has one."""
        person: str | None = getattr(self, "person", None)
        return (person,) if person else ()


class Expectation(Sentence):
    """What is compared with every case by itself."""

    __slots__ = ()

    @abstractmethod
    def judge(self, episode: Episode) -> Iterator[Finding]:
        """What is not as expected; nothing where all of it is."""


class ProfileComparison(Sentence):
    """What is compared across all profiles, once."""

    __slots__ = ()

    @property
    def profiles(self) -> Sequence[str]:
        """The profiles that it names."""
        return ()

    @abstractmethod
    def compare(self, compared: ComparedProfiles) -> Iterator[Finding]:
        """What is not as expected; nothing where all of it is."""


@dataclass(frozen=True, slots=True)
class Written:
    """An expectation in its place."""

    text: str
    where: Where
    meaning: Expectation | ProfileComparison
    profiles: tuple[str, ...]
    """The profiles for which it holds; empty for all."""

    def concerns(self, profile: str) -> bool:
        """Whether it holds for the cases of a profile."""
        return not self.profiles or profile in self.profiles
