"""An intervention: one node's result in one tick, held at another value while everything else goes on.

It tests a claimed cause. Repeat the episode with the same seed, holding the leaf blamed for a switch, and its
reading, at their previous values: if the switch then does not happen, the claim was right (Pearl, Causality,
2nd edition 2009, chapter 7: an intervention sets a variable and cuts it off from its usual causes).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.robots.senses import Senses

Result = Literal["running", "success", "failure"]
INSTANT_S = 1e-6
"""Times are rounded to a millionth."""

_STATUS: Mapping[Result, Status] = {
    "running": Status.RUNNING,
    "success": Status.SUCCESS,
    "failure": Status.FAILURE,
}


@dataclass(frozen=True, slots=True)
class Intervention:
    """What to hold; the node is not evaluated in this tick."""

    path: int
    """The place of a leaf or decorator in the tree, in pre-order."""
    t: float
    """The time of the tick [s]."""
    result: Result
    reading_of: str | None = None
    """Person whose reading is held: leaves see the reading of the previous tick."""


@contextmanager
def held(
    interventions: Iterable[Intervention], nodes: tuple[Behaviour, ...], senses: Senses
) -> Iterator[None]:
    """Apply the interventions of a tick that has begun.

    Args:
        interventions: Those of the whole execution.
        nodes: The tree, in pre-order.
        senses: What the tree reads, and the time.
    """
    now = [each for each in interventions if abs(each.t - senses.now_s()) < INSTANT_S]
    for each in now:
        _hold(nodes[each.path], _STATUS[each.result])
        if each.reading_of is not None:
            senses.hold(each.reading_of)
    try:
        yield
    finally:
        for each in now:
            del vars(nodes[each.path])["update"]


def _hold(node: Behaviour, status: Status) -> None:
    vars(node)["update"] = lambda: status
