"""Expectations: sentences of a scenario that are compared with what happened."""

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
    """A mismatch between an expectation and what happened."""

    expected: str
    got: str
    because: Sequence[str] = ()
    """Causes, a line each, from the nearest to the farthest."""
    also: Sequence[str] = ()
    """Other differences, a line each; no causes."""


class Sentence(ABC):
    """One kind of expectation: its grammar, and the people it names."""

    __slots__ = ()

    RULE: ClassVar[str]
    """Its grammar rule, in lark's notation."""
    EXAMPLE: ClassVar[str]
    """An example sentence."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from the parsed parts: names, bounds, counts; None for omitted parts."""
        return cls(*parts)

    @property
    def people(self) -> Sequence[str]:
        """The people of the scenario that it names: its `person`, if it has one."""
        person: str | None = getattr(self, "person", None)
        return (person,) if person else ()


class Expectation(Sentence):
    """An expectation of each single case."""

    __slots__ = ()

    @abstractmethod
    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Mismatches; none if the expectation holds."""


class ProfileComparison(Sentence):
    """An expectation that compares all profiles, once."""

    __slots__ = ()

    @property
    def profiles(self) -> Sequence[str]:
        """The profiles that it names."""
        return ()

    @abstractmethod
    def compare(self, compared: ComparedProfiles) -> Iterator[Finding]:
        """Mismatches; none if the expectation holds."""


@dataclass(frozen=True, slots=True)
class Written:
    """An expectation with its place in the file."""

    text: str
    where: Where
    meaning: Expectation | ProfileComparison
    profiles: tuple[str, ...]
    """Profiles to which it applies; empty for all."""

    def concerns(self, profile: str) -> bool:
        """Whether it applies to the cases of a profile."""
        return not self.profiles or profile in self.profiles
