"""Scheduled events of an episode, whatever the robot does: changes and faults.

A happening has a time and says what happens from then on, one tick after the other. The schedule lets all
that is due happen before the tree is ticked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from comity.answers.run import Disturbance, DisturbanceKind

if TYPE_CHECKING:
    from comity_executor import FaultError
    from comity_fis import Inference
    from comity_sim2d import World


class Listener(Protocol):
    """Who plans."""

    def tell(self, person: str, values: Inference, text: str) -> None:
        """A person's parameters are others from now on, and why."""
        ...

    def note(self, about: str, text: str, fault: str | None) -> None:
        """Something happens, or does not, that is to be told; and the fault that is behind it, if one is."""
        ...

    def break_down(self, error: FaultError, calls: int) -> None:
        """Raise an exception in the next calls."""
        ...


class RunningTree(Protocol):
    """What is carried out."""

    def raise_in(self, leaf: str, error: FaultError, *, times: int = 1) -> None:
        """Have a leaf raise an exception when it is ticked next."""
        ...


@dataclass(frozen=True, slots=True)
class Stage:
    """All that a happening may touch."""

    world: World
    planner: Listener
    tree: RunningTree


class Happening(Protocol):
    """Something that happens from a time on, in one tick or in many; it keeps no state of its own."""

    @property
    def at_s(self) -> float:
        """When it begins [s]."""
        ...

    def happen(self, stage: Stage) -> Iterator[None]:
        """What happens, tick by tick: each `yield` is the end of one, the end of the iterator that of all."""
        ...


@dataclass(frozen=True, slots=True)
class Announced:
    """A happening that trace, page and summary tell as a disturbance."""

    happening: Happening
    kind: DisturbanceKind
    about: str
    text: str

    @property
    def at_s(self) -> float:
        """When it begins [s]."""
        return self.happening.at_s

    def happen(self, stage: Stage) -> Iterator[None]:
        """As the happening does."""
        return self.happening.happen(stage)


class Schedule:
    """Happenings in the order of their times; those of one time in the order in which they are given."""

    def __init__(self, happenings: Iterable[Happening]) -> None:
        self._waiting = sorted(happenings, key=lambda happening: happening.at_s)
        self._under_way: list[tuple[Iterator[None], int | None]] = []
        """Each with the place of its disturbance, if it is announced."""
        self._disturbances: list[Disturbance] = []

    @property
    def disturbances(self) -> tuple[Disturbance, ...]:
        """What happened so far and is announced, in the order of its beginnings."""
        return tuple(self._disturbances)

    def step(self, stage: Stage) -> None:
        """Let a tick pass."""
        now_s = stage.world.time_s
        while self._waiting and self._waiting[0].at_s <= now_s + 1e-9:
            happening = self._waiting.pop(0)
            self._under_way.append((happening.happen(stage), self._begin(happening, now_s)))
        goes_on = []
        for steps, place in self._under_way:
            if next(steps, _OVER) is not _OVER:
                goes_on.append((steps, place))
            elif place is not None:
                self._disturbances[place] = replace(self._disturbances[place], end_s=now_s)
        self._under_way = goes_on

    def record(self, disturbance: Disturbance) -> None:
        """Write down what came from elsewhere."""
        self._disturbances.append(disturbance)

    def _begin(self, happening: Happening, now_s: float) -> int | None:
        """The place of its disturbance; None where it is not announced."""
        if not isinstance(happening, Announced):
            return None
        self.record(Disturbance(now_s, None, happening.kind, happening.about, happening.text))
        return len(self._disturbances) - 1


_OVER = object()
