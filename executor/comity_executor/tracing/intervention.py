"""An intervention: one node's result in one tick, held at another value while everything else goes on.

It is how a claimed cause is put to the test. Run the episode again with the same seed and hold the leaf that
is blamed for a switch, and the reading that it is blamed for, at what they were before: where the switch does
not happen then, the claim was right, as the switch could not do without it (Pearl, Causality, 2nd edition
2009, chapter 7: an intervention sets a variable and cuts it off from what usually determines it).
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
"""Times are written down to a millionth."""

_STATUS: Mapping[Result, Status] = {
    "running": Status.RUNNING,
    "success": Status.SUCCESS,
    "failure": Status.FAILURE,
}


@dataclass(frozen=True, slots=True)
class Intervention:
    """What to hold; the node neither asks nor does anything in this tick."""

    path: int
    """The place of a leaf or decorator in the tree, in pre-order."""
    t: float
    """The time of the tick [s]."""
    result: Result
    reading_of: str | None = None
    """A leaf that looks at this person in this tick sees what the tree saw in the tick before."""


@contextmanager
def held(
    interventions: Iterable[Intervention], nodes: tuple[Behaviour, ...], senses: Senses
) -> Iterator[None]:
    """Hold what is to be held in a tick that has begun.

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
