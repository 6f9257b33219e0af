"""Who was asked to let the robot pass: once, and once more, whatever is replanned in between."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from comity_executor.memory.shared import PassageRequest, SharedMemory
from comity_executor.nodes.limits import Limits


@dataclass(frozen=True, slots=True)
class Asking:
    """All requests for passage of one execution, over all plans and ways."""

    limits: Limits
    """How often a person is asked, and after how long again."""
    memory: SharedMemory

    @property
    def people(self) -> tuple[str, ...]:
        """Who was asked, in order."""
        return tuple(dict.fromkeys(each.person for each in self.memory.asked))

    @property
    def refused(self) -> tuple[str, ...]:
        """Who was asked as often as anybody is, and in vain."""
        in_vain = self.memory.in_vain
        return tuple(name for name in self.people if name in in_vain and self._is_over(name))

    def may_ask(self, person: str, now_s: float) -> bool:
        """Whether a person was not asked too often, or only just now."""
        if self._is_over(person):
            return False
        asked = (each for each in self.memory.asked if each.person == person)
        return all(now_s - each.t >= self.limits.passing_s for each in asked)

    def may_go_round(self, way: tuple[str, ...]) -> bool:
        """Whether any way round is right by now: a person was asked on this one, or stays wherever it is."""
        return bool(self.refused) or any(each.way == way for each in self.memory.asked)

    def note(self, asked: PassageRequest) -> None:
        """A person is asked now."""
        self.memory.asked = (*self.memory.asked, asked)

    def note_in_vain(self, people: Iterable[str]) -> None:
        """Some had time to make way, and did not."""
        self.memory.in_vain = self.memory.in_vain.union(people)

    def forget(self, people: Collection[str]) -> None:
        """Some stand elsewhere by now, as if they had never been asked."""
        self.memory.asked = tuple(each for each in self.memory.asked if each.person not in people)
        self.memory.in_vain = self.memory.in_vain.difference(people)

    def _is_over(self, person: str) -> bool:
        return sum(each.person == person for each in self.memory.asked) >= self.limits.reach_attempts
