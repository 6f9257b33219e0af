"""What an expectation is: one sentence of a scenario, which can be held against what happened."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, Self, TypeGuard, runtime_checkable

if TYPE_CHECKING:
    from comity.testing.judging.among import Among
    from comity.testing.trials.trial import Trial
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


class Kind(Protocol):
    """One kind of expectation: how it is written, and whom it names."""

    RULE: ClassVar[str]
    """What it looks like, in lark's notation."""
    EXAMPLE: ClassVar[str]
    """How somebody writes it."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From what the grammar found: names, amounts, times, or None for what was left out."""
        ...

    @property
    def people(self) -> Sequence[str]:
        """The people of the scenario whom it names."""
        ...


@runtime_checkable
class Expectation(Kind, Protocol):
    """What is held against every case by itself."""

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """What is not as expected; nothing where all of it is."""
        ...


@runtime_checkable
class Comparison(Kind, Protocol):
    """What is held against all profiles together, once."""

    @property
    def profiles(self) -> Sequence[str]:
        """The profiles that it names."""
        ...

    def compare(self, among: Among) -> Iterator[Finding]:
        """What is not as expected; nothing where all of it is."""
        ...


def compares(meaning: Expectation | Comparison) -> TypeGuard[Comparison]:
    """Whether it is held against all profiles together; `isinstance` takes its time with protocols."""
    return hasattr(meaning, "compare")


def judges(meaning: Expectation | Comparison) -> TypeGuard[Expectation]:
    """Whether it is held against one case; as above."""
    return hasattr(meaning, "judge")


@dataclass(frozen=True, slots=True)
class Written:
    """An expectation in its place."""

    text: str
    where: Where
    meaning: Expectation | Comparison
    profiles: tuple[str, ...]
    """For whom it holds; empty for everybody."""

    def concerns(self, profile: str) -> bool:
        """Whether it holds for the cases of a profile."""
        return not self.profiles or profile in self.profiles
