"""Who was asked to let the robot pass: once, and once more, whatever is planned anew in between."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from comity_executor.nodes.limits import Limits


@dataclass(frozen=True, slots=True)
class Asked:
    """Somebody in the way was asked to let the robot pass."""

    t: float
    person: str
    way: str
    """Where to, in the words that nodes have in brackets."""


class Asking:
    """All that were asked in one execution, over all plans and ways; written by the leaves of `passing`.

    Args:
        limits: How often somebody is asked, and after how long again.
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._asked: list[Asked] = []
        self._in_vain: set[str] = set()

    @property
    def people(self) -> tuple[str, ...]:
        """Who was asked, in order."""
        return tuple(dict.fromkeys(each.person for each in self._asked))

    @property
    def refused(self) -> tuple[str, ...]:
        """Who was asked as often as anybody is, and in vain."""
        return tuple(name for name in self.people if name in self._in_vain and self._is_over(name))

    def may_ask(self, person: str, now_s: float) -> bool:
        """Whether somebody was not asked too often, or only just now."""
        if self._is_over(person):
            return False
        return all(now_s - each.t >= self._limits.passing_s for each in self._asked if each.person == person)

    def may_go_round(self, way: str) -> bool:
        """Whether any way round is right by now: somebody was asked on this one, or stays wherever it is."""
        return bool(self.refused) or any(each.way == way for each in self._asked)

    def note(self, asked: Asked) -> None:
        """Somebody is asked now."""
        self._asked.append(asked)

    def note_in_vain(self, people: Iterable[str]) -> None:
        """Some had time to make way, and did not."""
        self._in_vain.update(people)

    def forget(self, people: Collection[str]) -> None:
        """Some stand elsewhere by now, as if they had never been asked."""
        self._asked = [each for each in self._asked if each.person not in people]
        self._in_vain.difference_update(people)

    def _is_over(self, person: str) -> bool:
        return sum(each.person == person for each in self._asked) >= self._limits.reach_attempts
