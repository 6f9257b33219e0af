"""What happens to an episode while it runs, whatever the robot does: the seam for changes, and for faults.

A happening has a time and says what happens from then on, one tick after the other. The schedule lets all
that is due happen before the tree is ticked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from comity_executor import FaultError
    from comity_fis import Inference
    from comity_sim2d import World


class Listener(Protocol):
    """Who plans."""

    def tell(self, person: str, values: Inference, text: str) -> None:
        """Somebody's parameters are others from now on, and why."""
        ...

    def note(self, about: str, text: str, fault: str | None) -> None:
        """Something happens, or does not, that is to be told; and the fault that is behind it, if one is."""
        ...

    def break_down(self, error: FaultError, calls: int) -> None:
        """Raise an exception in the next calls."""
        ...


class Tree(Protocol):
    """What is carried out."""

    def raise_in(self, leaf: str, error: FaultError, *, times: int = 1) -> None:
        """Have a leaf raise an exception when it is ticked next."""
        ...


@dataclass(frozen=True, slots=True)
class Stage:
    """All that a happening may touch."""

    world: World
    planner: Listener
    tree: Tree


class Happening(Protocol):
    """Something that happens from a time on, in one tick or in many; it keeps no state of its own."""

    @property
    def at_s(self) -> float:
        """When it begins [s]."""
        ...

    def happen(self, stage: Stage) -> Iterator[None]:
        """What happens, tick by tick: each `yield` is the end of one, the end of the iterator that of all."""
        ...


class Schedule:
    """Happenings in the order of their times; those of one time in the order in which they are given."""

    def __init__(self, happenings: Iterable[Happening]) -> None:
        self._waiting = sorted(happenings, key=lambda happening: happening.at_s)
        self._under_way: list[Iterator[None]] = []

    def step(self, stage: Stage) -> None:
        """Let a tick pass."""
        while self._waiting and self._waiting[0].at_s <= stage.world.time_s + 1e-9:
            self._under_way.append(self._waiting.pop(0).happen(stage))
        self._under_way = [one for one in self._under_way if next(one, _OVER) is not _OVER]


_OVER = object()
