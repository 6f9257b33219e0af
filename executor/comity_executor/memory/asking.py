"""Requests for passage: each person is asked once, and once more, regardless of replanning."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from comity_executor.memory.shared import PassageRequest, SharedMemory
from comity_executor.nodes.limits import Limits


@dataclass(frozen=True, slots=True)
class Asking:
    """All requests for passage of one execution, over all plans and ways."""

    limits: Limits
    """The maximum number of requests per person, and the pause between them."""
    memory: SharedMemory

    @property
    def people(self) -> tuple[str, ...]:
        """People who were asked, in order."""
        return tuple(dict.fromkeys(each.person for each in self.memory.asked))

    @property
    def refused(self) -> tuple[str, ...]:
        """People who were asked the maximum number of times without success."""
        in_vain = self.memory.in_vain
        return tuple(name for name in self.people if name in in_vain and self._is_over(name))

    def may_ask(self, person: str, now_s: float) -> bool:
        """Whether a person may be asked: not too often, and not just now."""
        if self._is_over(person):
            return False
        asked = (each for each in self.memory.asked if each.person == person)
        return all(now_s - each.t >= self.limits.passing_s for each in asked)

    def may_go_round(self, way: tuple[str, ...]) -> bool:
        """Whether any detour is acceptable: a person was asked on this path, or stays wherever it leads."""
        return bool(self.refused) or any(each.way == way for each in self.memory.asked)

    def note(self, asked: PassageRequest) -> None:
        """Record a request."""
        self.memory.asked = (*self.memory.asked, asked)

    def take_back(self, asked: PassageRequest) -> None:
        """Remove a request that was not said to its end."""
        self.memory.asked = tuple(each for each in self.memory.asked if each != asked)

    def note_in_vain(self, people: Iterable[str]) -> None:
        """Record people who had time to make way, and did not."""
        self.memory.in_vain = self.memory.in_vain.union(people)

    def forget(self, people: Collection[str]) -> None:
        """Forget people who have moved, as if they had never been asked."""
        self.memory.asked = tuple(each for each in self.memory.asked if each.person not in people)
        self.memory.in_vain = self.memory.in_vain.difference(people)

    def _is_over(self, person: str) -> bool:
        return sum(each.person == person for each in self.memory.asked) >= self.limits.reach_attempts
